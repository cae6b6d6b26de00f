#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "spring_workbench/tools/probe.h"
#include "spring_workbench/tools/tool_hold.h"

namespace spring_workbench::tools {

/// A tool that acts on an object: it either holds it or, as a probe, pushes it.
struct ToolOnObject {
  ToolHold* hold = nullptr;
  Probe* probe = nullptr;
};

/// One step of an object that several tools hold or push: one tool leads and carries it, the others pull on it and
/// follow (doc/model.md, "Several tools on one object").
class Sharing {
 public:
  /// `tools`: all tools on the object, with their hands' motions set; `make_pushable`: makes the object as a body that
  /// no tool holds.
  Sharing(const std::vector<ToolOnObject>& tools, const std::function<std::unique_ptr<ToolHold>()>& make_pushable);

  ToolHold* body() { return leader_; }
  /// Ends the step: the followers follow to time `now` [s]; `object`: motion of the object at that time.
  void end_step(const motion::MotionState& object, double now);

 private:
  std::unique_ptr<ToolHold> unheld_;  ///< the body, if no tool holds it
  ToolHold* leader_ = nullptr;
  std::vector<ToolOnObject> followers_;
};

}  // namespace spring_workbench::tools
