// Laws of the simulation's state as a value, over seeded sessions of everything that two hands can do.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <set>

#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/simulation/simulation.h"
#include "spring_workbench/tools/tool.h"
#include "spring_workbench/validation/input_error.h"
#include "spring_workbench/validation/names.h"
#include "support/bench_scenes.h"

namespace spring_workbench::simulation::state_test {
namespace {

using Random = std::mt19937;
using Numbers = std::vector<double>;
constexpr double slot = 0.02;  // [s] between two samples of a hand
const scene::ContactMode modes[] = {scene::ContactMode::none, scene::ContactMode::stop, scene::ContactMode::dynamic};

double uniform(Random& random, double from, double to) {
  return std::uniform_real_distribution<double>(from, to)(random);
}
bool chance(Random& random, double probability) { return uniform(random, 0.0, 1.0) < probability; }
template <typename E>
E any(Random& random) {
  return static_cast<E>(random() % validation::names<E>().size());
}

/// Boxes beside and on each other, near to a fixed one.
scene::Scene boxes(scene::ContactMode mode) {
  const Vector3d size(0.08, 0.06, 0.04);
  return scene_of({box("a", size, 1.0, Vector3d(0, 0, 0.02)), box("b", size, 0.5, Vector3d(0.09, 0, 0.02)),
                   box("c", size, 0.3, Vector3d(0.04, 0, 0.06)), box("d", size, 2.0, Vector3d(-0.1, 0.02, 0.02)),
                   box("wall", Vector3d(0.02, 0.4, 0.2), 0.0, Vector3d(0.2, 0, 0.1))},
                  mode);
}

/// Counts of events in a session, to make sure that a test covers them.
struct Seen {
  std::set<tools::Tool> tools_in_use;
  int both_hold = 0, contacts = 0, among_movable = 0;
};

/// Appends all outputs of a simulation.
void append_outputs(const Simulation& s, const AdvanceReport& report, Numbers& out) {
  const auto matrix = [&](const auto& m) { out.insert(out.end(), m.data(), m.data() + m.size()); };
  out.insert(out.end(), {s.time(), double(report.steps), report.position_error, report.angle_error,
                         report.energy_balance, report.stiffest_omega_dt, double(report.substeps), double(report.stops),
                         double(report.steps_fallback), report.energy_error, double(report.steps_blocked),
                         double(report.steps_unsolved), double(report.steps_rejected)});
  for (const bodies::BodyState& o : s.objects()) {
    matrix(o.X_WO.matrix());
    matrix(o.V_WO_W.linear);
    matrix(o.V_WO_W.angular);
    out.insert(out.end(), {double(o.held), double(o.highlighted), double(o.in_contact), double(o.asleep)});
  }
  for (std::size_t hand = 0; hand < s.hands(); ++hand) {
    const tools::ToolState f = s.tool(hand);
    matrix(f.X_WH_proxy.matrix());
    matrix(f.X_WE.matrix());
    matrix(f.strain);
    matrix(f.tip_wrench_W.force);
    matrix(f.tip_wrench_W.moment);
    out.insert(out.end(), {f.stretch, f.length, f.elastic_energy, f.kinetic_energy, f.stiffness.stretch});
  }
  for (const contact::ContactState& c : s.contacts()) {
    matrix(c.p_W);
    out.insert(out.end(), {c.depth, c.impulse, c.slip_speed, double(c.phase)});
  }
}

/// What the user does in one slot; the same for the same session and slot.
void act(Simulation& s, unsigned session, int k) {
  Random random(1000 * session + static_cast<unsigned>(k));
  for (std::size_t hand = 0; hand < s.hands(); ++hand) {
    const double t = k * slot, side = hand == 0 ? 1.0 : -1.0, phase = 0.7 * session;
    const Vector3d p(0.05 * std::sin(3.0 * t + phase) + 0.02 * side, 0.02 * std::sin(5.0 * t * side + phase),
                     0.235 + 0.03 * std::sin(4.0 * t + side));
    RigidTransform X = pointing_down(p);
    X.rotate(Eigen::AngleAxisd(0.2 * std::sin(2.0 * t + side), Vector3d::UnitY()));
    s.push_stylus({t, X}, hand);
    if (chance(random, 0.4)) s.push_button(t + uniform(random, 0.0, slot), chance(random, 0.6), hand);
    if (chance(random, 0.04)) s.push_next_tool(t, hand);
    if (chance(random, 0.06)) s.select_tool(any<tools::Tool>(random), hand);
    if (chance(random, 0.02)) s.release(hand);
  }
  if (session % 2 == 1 && k % 5 == 0) {
    const Wrench pull{{4.0 * std::sin(k), 2.0, 5.0 * std::cos(k)}, {0.0, 0.02, 0.01}};
    const auto axes = static_cast<motion::ExternalWrench::Axes>(k % 2);
    s.push_external_wrench({(k + 0.3) * slot, pull, axes}, static_cast<std::size_t>(k) % s.hands());
  }
  ForkChange fork;
  if (chance(random, 0.05)) fork.dofs = {chance(random, 0.7), chance(random, 0.7), chance(random, 0.7)};
  if (chance(random, 0.05)) fork.stiffness.stretch = uniform(random, 100.0, 5e3);
  if (chance(random, 0.05)) fork.stiffness.bend = uniform(random, 100.0, 5e3);
  if (chance(random, 0.03)) {
    fork.damping_ratio = {0.3, 0.3, 0.3};
    fork.damping_coefficient = {3.0, 2.0, 0.01};
    fork.damping_law = any<rod::DampingLaw>(random);
  }
  if (!fork.empty()) s.change(fork, {}, random() % s.hands());
  if (chance(random, 0.05)) {
    DynamicsChange dynamics;
    dynamics.integrator = any<dynamics::IntegratorKind>(random);
    dynamics.step = chance(random, 0.5) ? 0.005 : 0.02;
    dynamics.tolerance = chance(random, 0.3) ? 1e-4 : 0.0;
    s.change({}, dynamics);
  }
}

Numbers go_on(Simulation& s, unsigned session, int from, int to, Seen* seen = nullptr) {
  Numbers out;
  for (int k = from; k < to; ++k) {
    act(s, session, k);
    const AdvanceReport report = s.advance_to((k - 1) * slot);
    append_outputs(s, report, out);
    if (seen == nullptr) continue;
    for (std::size_t hand = 0; hand < s.hands(); ++hand) {
      const tools::ToolState f = s.tool(hand);
      if (!f.held_object.empty() || !f.touched.empty()) seen->tools_in_use.insert(f.tool);
    }
    seen->both_hold += !s.tool(0).held_object.empty() && !s.tool(1).held_object.empty();
    seen->contacts += static_cast<int>(s.contacts().size());
    seen->among_movable += report.steps_among_movable;
  }
  return out;
}

/// The same bits; the first place where they are not.
::testing::AssertionResult same_bits(const Numbers& a, const Numbers& b) {
  if (a.size() != b.size()) return ::testing::AssertionFailure() << a.size() << " numbers and " << b.size();
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::memcmp(&a[i], &b[i], sizeof a[i]) != 0) {
      return ::testing::AssertionFailure() << "number " << i << " of " << a.size() << ": " << a[i] << " and " << b[i];
    }
  }
  return ::testing::AssertionSuccess();
}

void apply_random_action(Simulation& s, unsigned session, int k) {
  Random random(7777 * session);
  go_on(s, session + 500, k, k + 1 + static_cast<int>(random() % 12));
  switch (random() % 4) {
    case 0:
      s.reset();
      break;
    case 1:
      s.place({{"a", make_transform(Vector3d(0.0, 0.0, 0.3), Quaterniond::Identity())}});
      break;
    case 2:
      s.change({}, {dynamics::IntegratorKind::rk4, 0.001, 0.0});
      s.advance_to(s.time() + 0.3);
      break;
    default:
      s.release();
  }
}

struct Session {
  scene::Scene scene;
  SimulationSettings settings;
  unsigned number;
};

Session make_session(scene::ContactMode mode, unsigned number) {
  Session session{boxes(mode), {}, number};
  Random random(number);
  session.settings.styluses = number % 4 == 3 ? 3 : 2;
  session.settings.tool = any<tools::Tool>(random);
  session.settings.fork.shape = any<rod::ShapeKind>(random);
  session.settings.dynamics.integrator = any<dynamics::IntegratorKind>(random);
  session.settings.dynamics.tolerance = chance(random, 0.3) ? 1e-4 : 0.0;
  if (chance(random, 0.2)) session.settings.grasp.calibrate = tools::Calibration::object;
  if (chance(random, 0.2)) session.settings.limit.force = 30.0;
  return session;
}

TEST(State, RestoredAfterAnythingGivesTheSameFuture) {
  constexpr unsigned sessions = 12;
  constexpr int after = 15;
  for (const scene::ContactMode mode : modes) {
    Seen seen;
    for (unsigned number = 0; number < sessions; ++number) {
      SCOPED_TRACE("contact mode " + std::to_string(static_cast<int>(mode)) + ", session " + std::to_string(number));
      const Session session = make_session(mode, number);
      const int saved_at = 5 + static_cast<int>(Random(number + 99)() % 25), end = saved_at + after;
      Simulation undisturbed(session.scene, session.settings), s(session.scene, session.settings);
      go_on(undisturbed, number, 0, saved_at);
      go_on(s, number, 0, saved_at, &seen);
      const SimulationState saved = s.save();
      EXPECT_EQ(saved, undisturbed.save());
      EXPECT_EQ(saved.hash(), s.state_hash());
      const Numbers future = go_on(undisturbed, number, saved_at, end);
      const std::uint64_t last = undisturbed.state_hash();
      ASSERT_TRUE(same_bits(future, go_on(s, number, saved_at, end, &seen))) << "saving";
      EXPECT_NE(last, saved.hash());

      apply_random_action(s, number, end);
      s.restore(saved);
      EXPECT_EQ(s.save(), saved);
      ASSERT_TRUE(same_bits(future, go_on(s, number, saved_at, end))) << "the same simulation";
      EXPECT_EQ(s.state_hash(), last);

      Simulation fresh(session.scene, session.settings);
      fresh.restore(parse_state(serialise(saved)));
      EXPECT_EQ(fresh.save(), saved);
      ASSERT_TRUE(same_bits(future, go_on(fresh, number, saved_at, end))) << "another simulation";
      EXPECT_EQ(fresh.state_hash(), last);
    }
    EXPECT_EQ(seen.tools_in_use.size(), validation::names<tools::Tool>().size());
    EXPECT_GE(seen.both_hold, 5);
    EXPECT_GE(seen.contacts, mode == scene::ContactMode::none ? 0 : 500);
    EXPECT_GE(seen.among_movable, mode == scene::ContactMode::dynamic ? 500 : 0);
  }
}

TEST(State, EveryBitCounts) {
  const auto hash_of = [](double x, double t, double stiffness) {
    Simulation s(boxes(scene::ContactMode::none), {});
    s.push_stylus({0.0, pointing_down(Vector3d(0, 0, 0.5))});
    s.push_stylus({t, pointing_down(Vector3d(0, 0, 0.5))});
    s.advance_to(0.01);
    s.place({{"a", make_transform(Vector3d(x, 0, 0.3), Quaterniond::Identity())}});
    ForkChange change;
    change.stiffness.stretch = stiffness;
    s.change(change);
    return s.state_hash();
  };
  const auto next = [](double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); };
  const std::uint64_t hash = hash_of(0.1, 0.5, 2000.0);
  EXPECT_EQ(hash_of(0.1, 0.5, 2000.0), hash);
  EXPECT_NE(hash_of(next(0.1), 0.5, 2000.0), hash);
  EXPECT_NE(hash_of(0.1, next(0.5), 2000.0), hash);
  EXPECT_NE(hash_of(0.1, 0.5, next(2000.0)), hash);
}

TEST(State, OfAnotherSceneIsRefused) {
  Simulation s(boxes(scene::ContactMode::stop), {});
  const std::uint64_t before = s.state_hash();
  SimulationSettings other_shape;
  other_shape.fork.shape = rod::ShapeKind::bushing;
  scene::Scene renamed = boxes(scene::ContactMode::stop), fewer = renamed;
  renamed.bodies[0].name = "z";
  fewer.bodies.pop_back();
  SimulationSettings three;
  three.styluses = 3;
  const auto refused = [&](const SimulationState& state) {
    try {
      s.restore(state);
    } catch (const validation::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const scene::Scene same = boxes(scene::ContactMode::stop);
  EXPECT_EQ(refused(Simulation(renamed, {}).save()),
            "state: saved with bodies z b c d wall, but this simulation has bodies a b c d wall");
  EXPECT_EQ(refused(Simulation(fewer, {}).save()),
            "state: saved with bodies a b c d, but this simulation has bodies a b c d wall");
  EXPECT_EQ(refused(Simulation(boxes(scene::ContactMode::none), {}).save()),
            "state: saved with contact none, but this simulation has contact stop");
  EXPECT_EQ(refused(Simulation(same, other_shape).save()),
            "state: saved with shape bushing, but this simulation has shape linear");
  EXPECT_EQ(refused(Simulation(same, three).save()),
            "state: saved with 3 styluses, but this simulation has 2 styluses");
  EXPECT_EQ(refused(SimulationState()), "state: saved with nothing, but this simulation has contact stop");
  std::string more = serialise(s.save());
  more.insert(more.find("wall\"") + 4, "\\ndoors");
  EXPECT_EQ(refused(parse_state(more)), "state: saved with doors, which this simulation does not have");
  EXPECT_EQ(s.state_hash(), before);
}

TEST(State, InvalidTextIsRefused) {
  const std::string text = serialise(Simulation(boxes(scene::ContactMode::stop), {}).save());
  EXPECT_EQ(serialise(parse_state(text)), text);
  std::string flipped = text;
  const std::size_t at = text.size() - 40;
  flipped[at] = text[at] == '0' ? '1' : '0';
  std::string cut = text;
  cut.erase(text.size() - 40, 16);
  for (const std::string& bad : {std::string(), std::string("a: [1"), std::string("format: other"), flipped, cut}) {
    EXPECT_THROW(parse_state(bad), validation::InputError) << bad.substr(0, 40);
  }
}

}  // namespace
}  // namespace spring_workbench::simulation::state_test
