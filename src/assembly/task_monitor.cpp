#include "spring_workbench/assembly/task_monitor.h"

#include <algorithm>
#include <iterator>
#include <utility>

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
  broken_.clear();
  hands_.clear();
  carried_.clear();
  released_height_.clear();
}

void TaskMonitor::observe(const simulation::Simulation& simulation) {
  if (watched_.empty()) return;
  const std::vector<bodies::BodyState>& objects = simulation.objects();
  const double t = simulation.time();
  if (!started_) begin_ = t;
  started_ = true;
  hands_.resize(simulation.hands());
  note_holds(simulation);
  note_drops(objects);
  if (!score_.complete()) {
    add_path_lengths(simulation);
    note_contacts(t, simulation.contacts());
    score_.time = t - begin_;
  }
  judge(objects);
  for (const bodies::BodyState& o : objects) {
    if (const auto c = carried_.find(o.name); c != carried_.end()) c->second.p = o.X_WO.translation();
  }
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
    placements_[i].broken = broken_.count(w.body.name) > 0;
    placements_[i].in_place = placements_[i].in_place && !placements_[i].broken;
    score_.placed += placements_[i].in_place ? 1 : 0;
    score_.position_error += placements_[i].position_error / static_cast<double>(watched_.size());
    if (!angle_matters(w.target)) continue;
    score_.angle_error += placements_[i].angle_error;
    ++angles;
  }
  if (angles > 0) score_.angle_error /= angles;
}

void TaskMonitor::note_holds(const simulation::Simulation& simulation) {
  std::set<std::string> held;
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    const std::string name = simulation.tool(i).held_object;
    const std::string before = std::exchange(hands_[i].held, name);
    if (name.empty()) continue;
    held.insert(name);
    if (name == before) continue;
    ++score_.grasps;
    released_height_.erase(name);
  }
  for (auto c = carried_.begin(); c != carried_.end();) {
    if (held.count(c->first) == 0) released_height_[c->first] = c->second.p.z();
    c = held.count(c->first) == 0 ? carried_.erase(c) : std::next(c);
  }
  for (const bodies::BodyState& o : simulation.objects()) {
    if (held.count(o.name) != 0) carried_.insert({o.name, {o.X_WO.translation(), simulation.time(), {}}});
  }
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

void TaskMonitor::add_path_lengths(const simulation::Simulation& simulation) {
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    const tools::ToolState tool = simulation.tool(i);
    if (!tool.present) continue;
    const Vector3d p = tool.X_WS.translation();
    score_.hand_path += (p - hands_[i].p.value_or(p)).norm();
    hands_[i].p = p;
  }
  for (const bodies::BodyState& o : simulation.objects()) {
    const auto c = carried_.find(o.name);
    if (c != carried_.end()) score_.object_path += (o.X_WO.translation() - c->second.p).norm();
  }
}

void TaskMonitor::note_contacts(double t, const std::vector<contact::ContactState>& contacts) {
  std::map<std::pair<std::string, std::string>, double> forces;
  for (const contact::ContactState& c : contacts) {
    double& force = forces[{c.object, c.other}];
    force += c.force;
    score_.largest_force = std::max(score_.largest_force, force);
    note_force(c.object, force);
    note_force(c.other, force);
    if (c.phase == contact::ContactPhase::ended) continue;
    const auto held = carried_.find(c.object);
    if (held == carried_.end()) continue;
    const auto touch = held->second.last_touch.find(c.other);
    const bool carried = c.n_W.z() > from_below && is_fixed(c.other);
    const double last = touch == held->second.last_touch.end() ? held->second.since : touch->second;
    if (t > last + same_contact && !carried) ++score_.collisions;
    held->second.last_touch[c.other] = t;
  }
}

void TaskMonitor::note_force(const std::string& object, double force) {
  for (const Watched& w : watched_) {
    if (w.body.name == object && force > w.target.max_force) broken_.insert(object);
  }
  score_.broken = static_cast<int>(broken_.size());
}

bool TaskMonitor::is_fixed(const std::string& name) const {
  return std::find(movable_.begin(), movable_.end(), name) == movable_.end();
}

}  // namespace spring_workbench::assembly
