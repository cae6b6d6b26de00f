#include "benchmark/step_cost.h"

#include <algorithm>
#include <limits>

#include "benchmark/least_time.h"
#include "benchmark/simulated_rod.h"
#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/validation/names.h"

namespace spring_workbench::benchmark {
namespace {

constexpr int calls = 200;
constexpr double interval = 0.02;  // s

motion::MotionSegment hand_of(const Scenario& scene, double t) {
  const auto sample = [&](double at) {
    const HandState hand = handle_state(scene, at);
    motion::PoseSample s;
    s.t = at;
    s.X.linear() = hand.R_WT;
    s.X.translation() = hand.p_WT;
    return s;
  };
  const double end = t + scene.output_interval;
  const HandState a = handle_state(scene, t), b = handle_state(scene, end);
  return motion::MotionSegment(sample(t), a.v_WT_W, a.w_WT_T, sample(end), b.v_WT_W, b.w_WT_T);
}

dynamics::HeldBody body_of(const Scenario& scene, const std::string& shape, const rod::ForkDofs& dofs) {
  dynamics::BodyInertia inertia;
  inertia.mass = scene.mass;
  inertia.inertia_O = scene.inertia.asDiagonal();
  inertia.X_OE.translation() = -scene.p_EO;
  dynamics::HeldBody body(
      rod::make_shape_model(validation::named<rod::ShapeKind>(shape, "benchmark", "shape"), scene.length), inertia,
      scene.gravity);
  body.set_springs({scene.stiffness[2], scene.stiffness[0], scene.stiffness[5]}, {1.0, 1.0, 1.0});
  const rod::StrainVector zero = rod::StrainVector::Zero(body.shape().size());
  body.set_dofs(dofs, 0.0, 1.0, {zero, zero});
  return body;
}

void add(const std::string& shape, const rod::ForkDofs& dofs, std::vector<StepCost>& costs) {
  const Scenario scene = six_dof_scene(100.0);
  dynamics::HeldBody body = body_of(scene, shape, dofs);
  const double h = scene.output_interval;
  std::vector<motion::MotionSegment> hand;
  for (int i = 0; i < calls; ++i) hand.push_back(hand_of(scene, i * h));
  const auto integrator = dynamics::make_integrator(dynamics::IntegratorKind::exponential);
  dynamics::StrainState state = body.zero_state();
  integrator->step(body, hand[0], 0.0, h, state);
  const dynamics::StrainState moving = state;
  const dynamics::StrainState full = body.full_state(h, moving);
  const dynamics::HandleState forcing = body.state_at(hand[1], h);

  volatile double sink = 0.0;  // prevents the compiler from removing the computation
  rod::TipKinematics tip;
  const auto note = [&](const char* part, auto&& call) {
    costs.push_back({shape, body.size(), part, min_nanoseconds(calls, call)});
  };
  note("hand at one moment", [&](int i) { sink = body.state_at(hand[1], h * (1.0 + 0.001 * i)).w_WH_H[0]; });
  note("tip", [&](int) {
    body.shape().tip(full.q, full.q_dot, tip);
    sink = tip.p_HE[0];
  });
  note("mass matrix", [&](int) { sink = body.mass_matrix(h, moving.q)(0, 0); });
  note("acceleration", [&](int) { sink = body.acceleration(forcing, moving.q, moving.q_dot)[0]; });
  note("object", [&](int) { sink = body.object(forcing, moving).velocity.linear[0]; });
  const auto step = [&](int i, double length) {
    if (i == 0) state = body.zero_state();
    integrator->step(body, hand[static_cast<std::size_t>(i)], i * h, length, state);
    sink = state.q[0];
  };
  note("step", [&](int i) { step(i, h); });
  note("step of a new length", [&](int i) { step(i, i % 2 == 0 ? h : 0.99 * h); });
  note("step after a change", [&](int i) {
    body.set_springs({scene.stiffness[2], scene.stiffness[0], scene.stiffness[5]}, {1.0, 1.0, 1.0});
    step(i, h);
  });
}

using Settings = simulation::SimulationSettings;

/// A simulation with all samples of a tracked hand pushed, 20 ms after the grasp (`grasped`) or before it; the bench is
/// far below.
simulation::Simulation simulation_of(const RodCase& one, const Settings& settings, bool grasped) {
  scene::Scene scene = rod_scene(one);
  scene.bench_height = -2.0;
  simulation::Simulation simulation(scene, settings);
  for (const motion::PoseSample& sample : one.hand) simulation.push_stylus(sample);
  if (grasped) simulation.advance_to(interval);
  return simulation;
}

/// Mean cost [ns] of 20 ms of Simulation after a `change`, minimum over some runs.
template <typename Change>
double advance_cost(const RodCase& one, const Settings& settings, Change&& change) {
  constexpr int runs = 5;
  double best = std::numeric_limits<double>::infinity();
  for (int run = 0; run < runs; ++run) {
    simulation::Simulation simulation = simulation_of(one, settings, true);
    const double begin = thread_nanoseconds();
    for (int i = 2; i < calls; ++i) {
      change(simulation, i % 2 == 0);
      simulation.advance_to(i * interval);
    }
    best = std::min(best, (thread_nanoseconds() - begin) / (calls - 2));
  }
  return best;
}

/// The same for the first 20 ms after a grasp.
double grasp_cost(const RodCase& one, const Settings& settings) {
  double best = std::numeric_limits<double>::infinity();
  for (int run = 0; run < calls; ++run) {
    simulation::Simulation simulation = simulation_of(one, settings, false);
    const double begin = thread_nanoseconds();
    simulation.advance_to(interval);
    best = std::min(best, thread_nanoseconds() - begin);
  }
  return best;
}

/// Cost of 20 ms for a user of Simulation with the default fork: without contact, with nothing near, with a bound of
/// the error; and of changes, without contact.
void add_advances(std::vector<StepCost>& costs) {
  RodCase one;
  one.name = "default fork";
  one.hand = synthetic_hand(1, (calls + 2) * interval);
  const auto note = [&](const char* part, double nanoseconds) { costs.push_back({"linear", 6, part, nanoseconds}); };
  const Settings settings = rod_settings(one, "linear", "exponential", interval);
  const auto nothing = [](simulation::Simulation&, bool) {};
  note("advance by 20 ms", advance_cost(one, settings, nothing));
  Settings with_contact = settings, with_bound = settings;
  with_contact.contact = scene::ContactMode::stop;
  with_bound.dynamics.error_bound = true;
  note("advance by 20 ms, contact stop", advance_cost(one, with_contact, nothing));
  note("advance by 20 ms, error bound", advance_cost(one, with_bound, nothing));
  note("advance after a change of stiffness",
       advance_cost(one, settings, [](simulation::Simulation& simulation, bool even) {
         simulation::ForkChange change;
         change.stiffness.bend = even ? 500.0 : 510.0;
         simulation.change(change);
       }));
  note("advance after a switch of DOFs", advance_cost(one, settings, [](simulation::Simulation& simulation, bool even) {
         simulation::ForkChange change;
         change.dofs = {true, true, even};
         simulation.change(change);
       }));
  note("advance after a grasp", grasp_cost(one, settings));
}

}  // namespace

std::vector<StepCost> step_costs() {
  const Scenario scene = six_dof_scene(100.0);
  std::vector<StepCost> costs;
  const HandState a = handle_state(scene, 0.0), b = handle_state(scene, scene.output_interval);
  motion::PoseSample from, to;
  from.X.linear() = a.R_WT;
  from.X.translation() = a.p_WT;
  to.t = scene.output_interval;
  to.X.linear() = b.R_WT;
  to.X.translation() = b.p_WT;
  volatile double sink = 0.0;
  costs.push_back({"", 0, "hand between two samples", min_nanoseconds(calls, [&](int) {
                     sink = motion::MotionSegment(from, a.v_WT_W, a.w_WT_T, to, b.v_WT_W, b.w_WT_T).end();
                   })});
  for (const std::string& shape : validation::names<rod::ShapeKind>()) {
    add(shape, {true, true, true}, costs);
    add(shape, {true, false, false}, costs);
  }
  add_advances(costs);
  return costs;
}

void keep_least(const std::vector<StepCost>& again, std::vector<StepCost>& costs) {
  for (std::size_t i = 0; i < std::min(again.size(), costs.size()); ++i) {
    costs[i].nanoseconds = std::min(costs[i].nanoseconds, again[i].nanoseconds);
  }
}

}  // namespace spring_workbench::benchmark
