#include "benchmark/contact/trial_run.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <stdexcept>

#include "benchmark/contact/bodies.h"
#include "benchmark/contact/processor_time.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double sample_time = 0.02;  // s
constexpr double take_every = 0.14;   // s, shorter than the time after which a slow object is put to sleep

}  // namespace

bool TrialRow::holds() const {
  return measured.finite && measured.to_the_end &&
         std::all_of(bars.begin(), bars.end(), [](const Bar& bar) { return bar.holds(); });
}

Bar at_most(const std::string& what, double measured, double most, const std::string& unit) {
  return {what, unit, measured, most, false};
}
Bar at_least(const std::string& what, double measured, double least, const std::string& unit) {
  return {what, unit, measured, least, true};
}
Bar depth_bar(const Measured& m, double most) { return at_most("depth", 1e3 * m.deepest.depth, 1e3 * most, "mm"); }
Bar blocked_bar(const Measured& m) { return at_most("blocked", m.steps_blocked, 0.0); }
Bar unsolved_bar(const Measured& m) { return at_most("unsolved", m.steps_unsolved, 0.0); }
Bar rejected_bar(const Measured& m) { return at_most("rejected", m.steps_rejected, 0.0); }

RigidTransform hand_above(const Vector3d& p_WE, double length) {
  return make_transform(p_WE + length * Vector3d::UnitZ(), Quaterniond(0.0, 1.0, 0.0, 0.0));
}

double minimum_jerk(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * u * (10.0 + u * (-15.0 + 6.0 * u));
}

simulation::SimulationSettings settings_with(double stiffness, double torsion, double step,
                                             const std::string& grasped) {
  simulation::SimulationSettings settings;
  settings.fork.stiffness = {stiffness, stiffness, torsion};
  settings.dynamics.step = step;
  settings.grasp.object = grasped;
  return settings;
}

scene::Scene scene_with(const std::string& name, scene::ContactMode contact, std::vector<scene::Body> bodies,
                        double bench_friction) {
  scene::Scene scene;
  scene.name = scene.path = name;
  scene.contact = contact;
  scene.bench_material.friction = bench_friction;
  scene.bodies = std::move(bodies);
  return scene;
}

TrialRun::TrialRun(const ContactTrial& trial)
    : trial_(trial),
      simulation_(trial_.scene, trial_.settings),
      depth_(trial_.scene),
      start_(simulation_.objects()),
      interval_(std::max(trial_.settings.dynamics.step, sample_time)) {
  for (const scene::Body& body : trial_.scene.bodies) weight_ += body.mass_properties.mass * trial_.scene.gravity;
  hardest_ = weight_;
  const int samples = static_cast<int>(std::lround(trial_.duration / interval_));
  for (int i = 0; i <= samples; ++i) simulation_.push_stylus({interval_ * i, trial_.X_WH(interval_ * i)});
  for (double t = 0.0; t < trial_.woken_until; t += take_every) {
    simulation_.push_button(t, true);
    simulation_.push_button(t + sample_time, false);
  }
}

bool TrialRun::advance() {
  const double begin_time = time_, step = std::min(trial_.settings.dynamics.step, interval_);
  ++sample_;
  const int steps = std::max(1, static_cast<int>(std::lround(interval_ / step)));
  double spent = 0.0;
  for (int i = 1; i <= steps; ++i) {
    time_ = i == steps ? interval_ * sample_ : begin_time + step * i;
    const double begin = processor_time();
    const simulation::AdvanceReport report = simulation_.advance_to(time_);
    spent += processor_time() - begin;
    measured_.steps_blocked += report.steps_blocked;
    measured_.steps_unsolved += report.steps_unsolved;
    measured_.time_lost += report.time_lost;
    measured_.steps_rejected += report.steps_rejected;
    look();
    if (!measured_.finite) return false;
  }
  seconds_.push_back(spent * sample_time / interval_);
  spent_ += spent;
  measured_.simulated = time_;
  measured_.to_the_end = time_ > trial_.duration - 0.5 * interval_;
  return !measured_.to_the_end && spent_ < trial_.max_seconds;
}

std::vector<RigidTransform> TrialRun::poses() const {
  std::vector<RigidTransform> poses;
  std::size_t object = 0;
  for (const scene::Body& body : trial_.scene.bodies) {
    poses.push_back(body.movable ? simulation_.objects()[object++].X_WO : body.X_WO);
  }
  return poses;
}

const RigidTransform& TrialRun::pose(const std::string& body) const {
  for (const bodies::BodyState& object : simulation_.objects()) {
    if (object.name == body) return object.X_WO;
  }
  throw std::logic_error("no object " + body);
}

double TrialRun::energy() const {
  double sum = simulation_.tool().elastic_energy;
  std::size_t object = 0;
  for (const scene::Body& body : trial_.scene.bodies) {
    if (!body.movable) continue;
    const bodies::BodyState& o = simulation_.objects()[object++];
    const Vector3d w_O = o.X_WO.linear().transpose() * o.V_WO_W.angular;
    const scene::MassProperties& m = body.mass_properties;
    sum += m.mass * (0.5 * o.V_WO_W.linear.squaredNorm() + trial_.scene.gravity * o.X_WO.translation().z()) +
           0.5 * w_O.dot(m.inertia_O * w_O);
  }
  return sum;
}

void TrialRun::look() {
  for (const bodies::BodyState& o : simulation_.objects()) {
    measured_.finite =
        measured_.finite && o.X_WO.matrix().allFinite() && o.V_WO_W.linear.allFinite() && o.V_WO_W.angular.allFinite();
  }
  if (!measured_.finite) return;
  ++measured_.looks;
  const DeepestPair now = depth_.deepest(poses());
  if (now.depth > measured_.deepest.depth) measured_.deepest = now;
  double force = 0.0;
  for (const contact::ContactState& contact : simulation_.contacts()) force += contact.force;
  hardest_ = std::max(hardest_, weight_ + force);
  if (time_ < trial_.rests_from + 1.5 * interval_) return;
  const double e = energy();
  lowest_ = std::min(lowest_, e);
  measured_.energy_gained = std::max(measured_.energy_gained, e - lowest_);
}

Measured TrialRun::measured() const {
  Measured m = measured_;
  m.gained_height = m.energy_gained / hardest_;
  std::vector<double> sorted = seconds_;
  std::sort(sorted.begin(), sorted.end());
  if (sorted.empty()) return m;
  m.cpu_mean = std::accumulate(sorted.begin(), sorted.end(), 0.0) / static_cast<double>(sorted.size());
  m.cpu_99 = sorted[static_cast<std::size_t>(0.99 * static_cast<double>(sorted.size() - 1) + 0.5)];
  m.cpu_most = sorted.back();
  return m;
}

TrialRow TrialRun::row(std::vector<Bar> bars) const {
  return {trial_.trial, trial_.name,    name_of(trial_.scene.contact), trial_.settings.dynamics.step,
          measured(),   std::move(bars)};
}

const TrialRow& TrialSum::add(const TrialRow& row) {
  if (++count_ == 1) {
    sum_ = row;
    return row;
  }
  Measured& m = sum_.measured;
  const Measured& n = row.measured;
  m.finite = m.finite && n.finite;
  m.to_the_end = m.to_the_end && n.to_the_end;
  m.simulated = std::min(m.simulated, n.simulated);
  if (n.deepest.depth > m.deepest.depth) m.deepest = n.deepest;
  m.looks += n.looks;
  m.steps_blocked += n.steps_blocked;
  m.steps_unsolved += n.steps_unsolved;
  m.time_lost += n.time_lost;
  m.steps_rejected += n.steps_rejected;
  m.cpu_mean += (n.cpu_mean - m.cpu_mean) / count_;
  m.cpu_99 = std::max(m.cpu_99, n.cpu_99);
  m.cpu_most = std::max(m.cpu_most, n.cpu_most);
  m.energy_gained = std::max(m.energy_gained, n.energy_gained);
  m.gained_height = std::max(m.gained_height, n.gained_height);
  return row;
}

TrialRow TrialSum::row(const std::string& name, std::vector<Bar> bars) const {
  TrialRow row = sum_;
  row.trial += " in all";
  row.name = std::to_string(count_) + ' ' + name;
  row.bars = std::move(bars);
  const Measured& m = row.measured;
  for (const Bar& bar : {depth_bar(m), blocked_bar(m), unsolved_bar(m), rejected_bar(m)}) row.bars.push_back(bar);
  return row;
}

void print_trial_header(std::ostream& out) {
  out << "trial,case,contact,step_ms,depth_mm,deepest_pair,looks,steps_blocked,steps_unsolved,time_lost_s,"
         "steps_rejected,cpu_ms_mean,"
         "cpu_ms_99%,cpu_ms_most,energy_gained_uJ,energy_gained_um,result,judged\n";
}

void print(const TrialRow& row, std::ostream& out) {
  const Measured& m = row.measured;
  out << row.trial << ",\"" << row.name << "\"," << row.contact << ',' << 1e3 * row.step << ',' << 1e3 * m.deepest.depth
      << ',' << m.deepest.first << (m.deepest.first.empty() ? "" : " in ") << m.deepest.second << ',' << m.looks << ','
      << m.steps_blocked << ',' << m.steps_unsolved << ',' << m.time_lost << ',' << m.steps_rejected << ','
      << 1e3 * m.cpu_mean << ',' << 1e3 * m.cpu_99 << ',' << 1e3 * m.cpu_most << ',' << 1e6 * m.energy_gained << ','
      << 1e6 * m.gained_height << ',' << (row.holds() ? "PASS" : "FAIL") << ",\"";
  if (!m.finite) out << "not finite; ";
  if (!m.to_the_end) out << "given up after " << m.simulated << " s; ";
  for (std::size_t i = 0; i < row.bars.size(); ++i) {
    const Bar& bar = row.bars[i];
    std::ostringstream figure;
    figure.precision(3);
    figure << (i > 0 ? "; " : "") << bar.what << ' ' << bar.measured << ' '
           << (bar.at_least ? (bar.holds() ? "≥ " : "< ") : (bar.holds() ? "≤ " : "> ")) << bar.most
           << (bar.unit.empty() ? "" : " ") << bar.unit;
    out << figure.str();
  }
  out << '"' << std::endl;
}

}  // namespace spring_workbench::benchmark
