#include "spring_workbench/tools/sharing.h"

#include <utility>

namespace spring_workbench::tools {

Sharing::Sharing(const std::vector<ToolOnObject>& tools,
                 const std::function<std::unique_ptr<ToolHold>()>& make_pushable) {
  // The tool with the fewest coordinates leads, so that its rigid directions are exactly rigid; among equals the first.
  const auto rank = [](const ToolHold& hold) { return std::make_pair(hold.coordinates(), hold.since()); };
  for (const ToolOnObject& tool : tools) {
    if (tool.hold != nullptr && (leader_ == nullptr || rank(*tool.hold) < rank(*leader_))) leader_ = tool.hold;
  }
  if (leader_ == nullptr) {
    unheld_ = make_pushable();
    leader_ = unheld_.get();
  }
  std::vector<dynamics::Attached> attached;
  for (const ToolOnObject& tool : tools) {
    if (tool.hold == leader_) continue;
    followers_.push_back(tool);
    if (tool.probe != nullptr) {
      attached.push_back({tool.probe, &tool.probe->hand()});
    } else if (tool.hold->coordinates() > 0) {
      const bool stays_behind = tool.hold->coordinates() < rod::max_strain_coordinates;
      attached.push_back({&tool.hold->coupling(), &tool.hold->hand(), stays_behind ? &leader_->hand() : nullptr});
    }
  }
  leader_->lead(attached);
}

void Sharing::end_step(const motion::MotionState& object, double now) {
  for (const ToolOnObject& tool : followers_) {
    if (tool.probe != nullptr) {
      tool.probe->follow(now, object);
    } else {
      tool.hold->follow(now, *leader_, object);
    }
  }
  leader_->stop_leading();
}

}  // namespace spring_workbench::tools
