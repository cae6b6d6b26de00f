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

/// An object on several tools, or pushed, over one step: one tool leads and carries it, the others pull at it and
/// follow (doc/model.md, "Several tools on one object").
class Sharing {
 public:
  /// All tools on the object, which know their hands' motion; `make_unheld`: it as none holds it.
  Sharing(const std::vector<ToolOnObject>& tools, const std::function<std::unique_ptr<ToolHold>()>& make_unheld);

  ToolHold* body() { return leader_; }
  /// The step is done, and the object is there at time `now` [s].
  void end_step(const motion::MotionState& object, double now);

 private:
  std::unique_ptr<ToolHold> unheld_;  ///< where no tool holds it
  ToolHold* leader_ = nullptr;
  std::vector<ToolOnObject> followers_;
};

}  // namespace spring_workbench::tools
