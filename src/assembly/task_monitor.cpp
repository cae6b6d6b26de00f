#include "spring_workbench/assembly/task_monitor.h"

#include <algorithm>

#include "constants.h"

namespace spring_workbench::assembly {

TaskMonitor::TaskMonitor(const scene::Scene& scene) {
  for (const scene::Body& body : scene.bodies) {
    if (body.movable) movable_.push_back(body.name);
  }
  for (const auto& [name, target] : scene.targets)
    watched_.push_back({scene.bodies[*scene::find_body(scene, name)], target});
  reset();
}

void TaskMonitor::reset() {
  score_ = TaskScore();
  score_.targets = static_cast<int>(watched_.size());
  placements_.clear();
  for (const Watched& w : watched_) placements_.push_back(judge_placement(w.body, w.target, w.body.X_WO, false));
  started_ = false;
  last_ = Last();
  last_touch_.clear();
  released_height_.clear();
}

void TaskMonitor::observe(const simulation::Simulation& simulation) {
  if (watched_.empty()) return;
  const std::vector<bodies::BodyState>& objects = simulation.objects();
  const tools::ToolState tool = simulation.fork();
  const double t = simulation.time();
  const auto found = std::find_if(objects.begin(), objects.end(), [](const bodies::BodyState& o) { return o.held; });
  const bodies::BodyState* held = found == objects.end() ? nullptr : &*found;
  if (!started_) {
    begin_ = t;
    last_ = {t, tool.X_WS.translation(), "", Vector3d::Zero()};
    started_ = true;
  }
  note_hold(t, held);
  note_drops(objects);
  if (!score_.complete()) {
    add_ways(tool, held);
    note_contacts(t, simulation.contacts(), last_.held);
    score_.time = t - begin_;
  }
  judge(objects);
  last_.t = t;
  last_.hand = tool.X_WS.translation();
  if (held) last_.p_held = held->X_WO.translation();
}

void TaskMonitor::judge(const std::vector<bodies::BodyState>& objects) {
  score_.placed = 0;
  score_.position_error = score_.angle_error = 0.0;
  int angles = 0;
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    const Watched& w = watched_[i];
    const auto o =
        std::find_if(objects.begin(), objects.end(), [&](const bodies::BodyState& s) { return s.name == w.body.name; });
    placements_[i] = judge_placement(w.body, w.target, o->X_WO, o->held);
    score_.placed += placements_[i].in_place ? 1 : 0;
    score_.position_error += placements_[i].position_error / static_cast<double>(watched_.size());
    if (!angle_matters(w.target)) continue;
    score_.angle_error += placements_[i].angle_error;
    ++angles;
  }
  if (angles > 0) score_.angle_error /= angles;
}

void TaskMonitor::note_hold(double t, const bodies::BodyState* held) {
  const std::string name = held ? held->name : "";
  if (name == last_.held) return;
  if (!last_.held.empty()) released_height_[last_.held] = last_.p_held.z();
  if (held) {
    ++score_.grasps;
    held_since_ = t;
    last_touch_.clear();
    released_height_.erase(name);
    last_.p_held = held->X_WO.translation();
  }
  last_.held = name;
}

void TaskMonitor::note_drops(const std::vector<bodies::BodyState>& objects) {
  for (const bodies::BodyState& o : objects) {
    const auto released = released_height_.find(o.name);
    if (released == released_height_.end()) continue;
    if (released->second - o.X_WO.translation().z() > drop_height) {
      ++score_.drops;
      released_height_.erase(released);
    } else if (o.asleep) {
      released_height_.erase(released);
    }
  }
}

void TaskMonitor::add_ways(const tools::ToolState& tool, const bodies::BodyState* held) {
  score_.hand_path += (tool.X_WS.translation() - last_.hand).norm();
  if (held) score_.object_path += (held->X_WO.translation() - last_.p_held).norm();
}

void TaskMonitor::note_contacts(double t, const std::vector<contact::ContactState>& contacts, const std::string& held) {
  std::map<std::pair<std::string, std::string>, double> forces;
  for (const contact::ContactState& c : contacts) {
    if (c.phase == contact::ContactPhase::ended) continue;
    double& force = forces[{c.object, c.other}];
    force += c.force;
    score_.largest_force = std::max(score_.largest_force, force);
    if (c.object != held) continue;
    const auto touch = last_touch_.find(c.other);
    const bool carried = c.n_W.z() > from_below && is_fixed(c.other);
    const bool began = touch == last_touch_.end() ? t > held_since_ + same_contact : t > touch->second + same_contact;
    if (began && !carried) ++score_.collisions;
    last_touch_[c.other] = t;
  }
}

bool TaskMonitor::is_fixed(const std::string& name) const {
  return std::find(movable_.begin(), movable_.end(), name) == movable_.end();
}

}  // namespace spring_workbench::assembly
