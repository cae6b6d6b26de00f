#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "spring_workbench/tools/probe.h"
#include "spring_workbench/tools/tool_hold.h"

namespace spring_workbench::tools {

/// A tool on an object: it holds it, or its probe pushes it.
struct ToolOnObject {
  ToolHold* hold = nullptr;
  Probe* probe = nullptr;
};

/// An object on several tools, or pushed, over one step: one tool leads and carries it, the others pull on it and
/// follow (doc/model.md, "Several tools on one object").
class Sharing {
 public:
  /// `tools`: all on the object, with their hands' motions set; `make_unheld`: makes the object as if no tool held it.
  Sharing(const std::vector<ToolOnObject>& tools, const std::function<std::unique_ptr<ToolHold>()>& make_unheld);

  ToolHold* body() { return leader_; }
  /// Ends the step: the followers follow to time `now` [s], at which `object` is the motion of the object.
  void end_step(const motion::MotionState& object, double now);

 private:
  std::unique_ptr<ToolHold> unheld_;  ///< where no tool holds it
  ToolHold* leader_ = nullptr;
  std::vector<ToolOnObject> followers_;
};

}  // namespace spring_workbench::tools
