#include "benchmark/rod_case.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <random>
#include <sstream>
#include <tuple>

#include "spring_workbench/math/so3.h"
#include "spring_workbench/validation/names.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double kFineInterval = 5e-4;  // s
constexpr double kTwoPi = 6.283185307179586476925286766559;

/// Random numbers that depend only on the seed, on every machine.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_()) + 0.5) / 4294967296.0;
  }

 private:
  std::mt19937 engine_;
};

struct Sine {
  double amplitude, frequency, phase;
  double at(double t) const { return amplitude * std::sin(kTwoPi * frequency * t + phase); }
};

/// Three slow sines and a tremor.
std::array<Sine, 4> one_coordinate(double amplitude, double tremor, Random& random) {
  std::array<Sine, 4> sines;
  for (std::size_t i = 0; i < 3; ++i) {
    const double frequency = random.between(0.2, 0.8) * static_cast<double>(i + 1);
    sines[i] = {random.between(0.5, 1.0) * amplitude / static_cast<double>((i + 1) * (i + 1)), frequency,
                random.between(0.0, kTwoPi)};
  }
  sines[3] = {tremor, random.between(8.0, 12.0), random.between(0.0, kTwoPi)};
  return sines;
}

double sum(const std::array<Sine, 4>& sines, double t) {
  double value = 0.0;
  for (const Sine& sine : sines) value += sine.at(t);
  return value;
}

RodCase rod(const std::string& name, double length, const rod::PerDof& stiffness) {
  RodCase one;
  one.name = name;
  one.fork.length = length;
  one.fork.stiffness = stiffness;
  return one;
}

RodCase with_dofs(RodCase one, const std::string& name, const rod::ForkDofs& dofs) {
  one.name = name;
  one.fork.dofs = dofs;
  return one;
}

/// The cases without hands, common to the synthetic and the recorded ones.
std::vector<RodCase> bodies_and_forks() {
  const RodCase soft = rod("soft_6dof", 0.2, {2000.0, 500.0, 5.0});
  RodCase underdamped = soft;
  underdamped.name = "underdamped";
  underdamped.fork.damping_ratio = {0.1, 0.1, 0.1};
  RodCase stiff = rod("stiff_6dof", 0.15, {2e5, 5e4, 200.0});
  stiff.stiffness_factor = 100.0;
  stiff.mass = 0.3;
  stiff.inertia = Vector3d(2e-4, 3e-4, 4e-4);
  stiff.p_OE = Vector3d(0.01, 0.01, -0.03);
  RodCase heavy = rod("heavy_large_bend", 0.2, {1500.0, 150.0, 3.0});
  heavy.mass = 3.0;
  heavy.inertia = Vector3d(0.02, 0.03, 0.025);
  heavy.p_OE = Vector3d(0.02, 0.0, -0.06);
  return {soft,
          underdamped,
          stiff,
          heavy,
          with_dofs(soft, "bend_only", {false, true, false}),
          with_dofs(soft, "torsion_only", {false, false, true}),
          with_dofs(soft, "stretch_only", {true, false, false})};
}

/// The default fork with a light body and with about the heaviest one that it can carry, and stiffer forks. A light
/// body on a fork a thousand times as stiff deflects by less than 100 nm, the limit of the digits; a tonne has one on
/// which it moves like 33 g on the default fork, between soft and stiff. The motion depends on stiffness over mass
/// only.
std::vector<RodCase> soft_and_stiff() {
  std::vector<RodCase> cases;
  for (const auto& [name, factor, mass] : {std::tuple{"soft_light", 1.0, 1e-3},
                                           {"soft_heavy", 1.0, 1.0},
                                           {"stiff_light", 1e3, 1e-3},
                                           {"stiff_heavy", 3e4, 1e3},
                                           {"stiff", 3e4, 1.0}}) {
    RodCase one;
    one.name = name;
    one.stiffness_factor = factor;
    one.mass = mass;
    one.inertia *= mass;
    one.fork.stiffness = {2000.0 * factor, 500.0 * factor, 5.0 * factor};
    one.shapes = {validation::name_of(one.fork.shape)};
    cases.push_back(one);
  }
  return cases;
}

}  // namespace

std::vector<motion::PoseSample> read_motion(const std::string& path) {
  std::ifstream file(path);
  std::vector<motion::PoseSample> samples;
  for (std::string line; std::getline(file, line);) {
    std::istringstream in(line);
    double t, x, y, z, qx, qy, qz, qw;
    if (in >> t >> x >> y >> z >> qx >> qy >> qz >> qw) {
      samples.push_back({t, make_transform({x, y, z}, Quaterniond(qw, qx, qy, qz).normalized())});
    }
  }
  return samples;
}

std::vector<motion::PoseSample> synthetic_hand(unsigned seed, double duration, double interval) {
  Random random(seed);
  std::array<std::array<Sine, 4>, 3> place, turn;
  for (auto& coordinate : place) coordinate = one_coordinate(0.1, 1e-4, random);
  for (auto& coordinate : turn) coordinate = one_coordinate(0.4, 2e-3, random);
  const Matrix3d forward_and_up = math::exp_so3(Vector3d(0.0, 1.0, 0.0));
  std::vector<motion::PoseSample> samples;
  for (int i = 0; i * interval < duration + 0.5 * interval; ++i) {
    const double t = from_rest(i * interval, kRamp).value;
    motion::PoseSample sample{i * interval, RigidTransform::Identity()};
    Vector3d angle;
    for (int axis = 0; axis < 3; ++axis) {
      sample.X.translation()[axis] = sum(place[static_cast<std::size_t>(axis)], t);
      angle[axis] = sum(turn[static_cast<std::size_t>(axis)], t);
    }
    sample.X.linear() = math::exp_so3(angle) * forward_and_up;
    samples.push_back(sample);
  }
  return samples;
}

std::vector<RodCase> synthetic_cases(bool quick) {
  std::vector<RodCase> cases = bodies_and_forks();
  if (quick) cases = {cases[0], cases[3]};
  for (RodCase& one : cases) one.shapes = validation::names<rod::ShapeKind>();
  for (const RodCase& one : soft_and_stiff()) cases.push_back(one);
  unsigned seed = 1;
  for (RodCase& one : cases) {
    one.duration = quick ? 0.6 : 4.0;
    one.hand = synthetic_hand(seed, one.duration + 0.5);
    one.fine_hand = synthetic_hand(seed++, one.duration + 0.5, kFineInterval);
  }
  return cases;
}

std::vector<RodCase> recorded_cases(const std::string& folder) {
  std::vector<RodCase> cases = bodies_and_forks();
  cases.push_back(with_dofs(cases[0], "soft_constant_shape", {true, true, true}));
  cases.push_back(with_dofs(cases[0], "stylus", {true, true, true}));
  std::vector<RodCase> there;
  for (RodCase& one : cases) {
    const bool stiff = one.name == "stiff_6dof";
    const std::string motion = stiff ? "motion_vicon_1s" : one.name == "stylus" ? "motion_stylus" : "motion_vicon";
    one.recorded = folder + "/" + one.name + ".csv";
    one.duration = stiff ? 1.0 : one.name == "stylus" ? 7.96 : 8.0;
    one.shapes = {one.name == "soft_constant_shape" ? "constant" : "linear"};
    one.name = "recorded_" + one.name;
    one.hand = read_motion(folder + "/" + motion + ".tum");
    if (std::ifstream(one.recorded) && !one.hand.empty()) there.push_back(one);
  }
  return there;
}

RodCase rod_case(const Scenario& scene) {
  const auto per_dof = [](const Vector6d& of) { return rod::PerDof{of[2], of[0], of[5]}; };
  RodCase one;
  one.name = scene.name;
  one.mass = scene.mass;
  one.inertia = scene.inertia;
  one.p_OE = -scene.p_EO;
  one.fork.length = scene.length;
  one.fork.stiffness = per_dof(scene.stiffness);
  one.fork.damping_law = rod::DampingLaw::coefficients;
  one.fork.damping_coefficient = per_dof(scene.damping);
  if (scene.kind == SceneKind::six_dof) {
    one.fork.slope_stiffness = scene.stiffness[3];
  } else {
    one.fork.dofs = {scene.kind == SceneKind::stretch, false, scene.kind == SceneKind::torsion};
  }
  one.shapes = {"bushing"};
  if (scene.samples) one.hand = scene.samples->poses();
  one.duration = scene.duration;
  one.output_interval = scene.output_interval;
  return one;
}

dynamics::HeldBody held_body(const RodCase& one, const std::string& shape) {
  dynamics::BodyInertia inertia;
  inertia.mass = one.mass;
  inertia.inertia_O = one.inertia.asDiagonal();
  inertia.X_OE.translation() = one.p_OE;
  dynamics::HeldBody body(rod::make_shape_model(validation::named<rod::ShapeKind>(shape, "benchmark", "shape"),
                                                one.fork.length, one.fork.slope_stiffness),
                          inertia, 9.81);
  body.set_springs(one.fork);
  body.set_dofs(one.fork.dofs, 0.0, 1.0, body.zero_state());
  return body;
}

motion::PoseTrack hand_track(const RodCase& one) {
  motion::PoseTrack track;
  for (const motion::PoseSample& sample : one.hand) track.push(sample);
  return track;
}

double hand_amplitude(const RodCase& one) {
  Vector3d mean = Vector3d::Zero();
  double count = 0.0, amplitude = 0.0;
  for (const motion::PoseSample& sample : one.hand) {
    if (sample.t > one.duration) break;
    mean += sample.X.translation();
    count += 1.0;
  }
  mean /= count;
  for (const motion::PoseSample& sample : one.hand) {
    if (sample.t <= one.duration) amplitude = std::max(amplitude, (sample.X.translation() - mean).norm());
  }
  return amplitude;
}

std::vector<double> output_times(const RodCase& one) {
  std::vector<double> times;
  for (int i = 0; i <= std::lround(one.duration / one.output_interval); ++i) times.push_back(i * one.output_interval);
  return times;
}

std::vector<double> step_ends(const RodCase& one) {
  std::vector<double> ends = output_times(one);
  const double last = ends.back();
  for (const motion::PoseSample& sample : one.hand) {
    if (sample.t > 0.0 && sample.t < last) ends.push_back(sample.t);
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end(), [](double a, double b) { return b - a < kSameTime; }), ends.end());
  return ends;
}

}  // namespace spring_workbench::benchmark
