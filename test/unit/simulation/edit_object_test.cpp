// Objects are added, moved, removed and changed while the simulation runs.
#include <gtest/gtest.h>

#include "spring_workbench/validation/names.h"
#include "support/bench_scenes.h"
#include "support/temporary_folder.h"

namespace spring_workbench::simulation::edit_object_test {
namespace {

using Action = ObjectEdit::Action;
using scene::ContactMode;

constexpr double g = 9.81;

scene::Body cube(const std::string& name, const Vector3d& p_WO) {
  return box(name, Vector3d::Constant(0.1), 1.0, p_WO, 0.5);
}

RigidTransform at(const Vector3d& p, double turned = 0.0) {
  return make_transform(p, Quaterniond(Eigen::AngleAxisd(turned, Vector3d::UnitZ())));
}

ObjectEdit move_to(const std::string& name, const RigidTransform& X_WL) { return {Action::move, name, "", X_WL}; }
ObjectEdit removal(const std::string& name) { return {Action::remove, name, "", std::nullopt}; }
ObjectEdit new_mass(const std::string& name, double mass) { return {Action::mass, name, "", std::nullopt, mass}; }
ObjectEdit new_friction(const std::string& name, double friction) {
  return {Action::friction, name, "", std::nullopt, 0.0, friction};
}

std::string refusal(Simulation& s, const ObjectEdit& edit) {
  const SimulationState before = s.save();
  std::string message;
  try {
    s.edit(edit);
  } catch (const validation::InputError& error) {
    message = error.what();
  }
  EXPECT_EQ(s.save(), before) << message;
  return message;
}

/// A cube held by a spring fork at its centre, and others on the bench.
class Edits : public testing::TestWithParam<ContactMode> {
 protected:
  void SetUp() override {
    folder_.write("brick.urdf",
                  "<robot name='brick'><link name='brick'><inertial><origin xyz='0 0 0.02'/><mass value='2'/>"
                  "<inertia ixx='0.01' iyy='0.01' izz='0.01' ixy='0' ixz='0' iyz='0'/></inertial>"
                  "<collision><geometry><box size='0.2 0.1 0.1'/></geometry></collision></link></robot>");
  }
  scene::Scene scene() const {
    return scene_of({cube("held", Vector3d(0.0, 0.0, 0.05)), box("wall", Vector3d(0.1, 2.0, 1.0), 0.0, {2.0, 0.0, 0.5}),
                     cube("below", Vector3d(0.6, 0.0, 0.05)), cube("above", Vector3d(0.6, 0.0, 0.15))},
                    GetParam());
  }
  /// Lifted by 0.3 m until 1 s, and held there.
  Simulation lifted() const {
    Simulation s(scene(), {});
    const Vector3d start(0.0, 0.0, 0.05 + s.fork_settings().length);
    push_move(s, 0.0, 1.0, start, start + Vector3d(0.1, 0.0, 0.3));
    for (double t = 1.02; t < 6.0; t += 0.02) s.push_stylus({t, pointing_down(start + Vector3d(0.1, 0.0, 0.3))});
    s.push_button(0.0, true);
    s.advance_to(1.5);
    return s;
  }
  ObjectEdit addition(const std::string& name, const std::optional<RigidTransform>& X_WL) const {
    return {Action::add, name, folder_.path("brick.urdf"), X_WL};
  }
  test_support::TemporaryFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(Modes, Edits, testing::Values(ContactMode::none, ContactMode::stop, ContactMode::dynamic),
                         [](const auto& tested) { return validation::name_of(tested.param); });

/// With `dynamic` what is held falls asleep later where something else has been set in motion.
TEST_P(Edits, EditsOfOtherObjectsDoNotAffectTheHeldOne) {
  const std::vector<ObjectEdit> quiet = {new_mass("below", 3.0), new_friction("below", 0.1), removal("above")};
  const std::vector<ObjectEdit> moving = {addition("brick", at(Vector3d(-1.0, 0.0, 0.3))),
                                          move_to("below", at(Vector3d(1.0, 1.0, 0.05)))};
  const auto expect_same = [&](const ObjectEdit& edit, double until, double asleep_later) {
    Simulation s = lifted(), untouched = lifted();
    s.edit(edit);
    for (const double t : {1.5, 1.63, until}) {
      s.advance_to(t);
      untouched.advance_to(t);
      const bodies::BodyState a = object(s, "held"), b = object(untouched, "held");
      EXPECT_LE((a.X_WO.matrix() - b.X_WO.matrix()).norm(), asleep_later) << edit.name;
      EXPECT_LE((s.tool().strain - untouched.tool().strain).norm(), 10.0 * asleep_later) << edit.name;
    }
  };
  for (const ObjectEdit& edit : quiet) expect_same(edit, 3.0, 0.0);
  for (const ObjectEdit& edit : moving) expect_same(edit, 3.0, GetParam() == ContactMode::dynamic ? 1e-6 : 0.0);
}

TEST_P(Edits, AnAddedObjectFallsLandsAndCanBeRemoved) {
  Simulation s = lifted();
  s.edit(addition("brick", at(Vector3d(-1.0, 0.0, 0.4), 0.3)));
  EXPECT_EQ(s.objects().back().name, "brick");
  const double begin = s.time();
  s.advance_to(begin + 0.2);
  EXPECT_NEAR(object(s, "brick").X_WO.translation().z(), 0.42 - 0.5 * g * 0.04, 1e-12);
  if (GetParam() != ContactMode::none) {
    s.advance_to(3.0);
    EXPECT_NEAR(object(s, "brick").X_WO.translation().z(), 0.07, 1e-4);
    EXPECT_TRUE(object(s, "brick").asleep);
  }
  s.edit(removal("brick"));
  EXPECT_EQ(s.objects().size(), 3u);
  EXPECT_EQ(s.scene().bodies.size(), 4u);
  s.advance_to(3.5);
  EXPECT_TRUE(object(s, "held").held);
}

TEST_P(Edits, AHeldObjectWithAnotherMassHangsByItsWeightAndDoesNotJump) {
  for (const double mass : {0.4, 2.5}) {
    Simulation s = lifted();
    s.advance_to(4.0);
    const bodies::BodyState before = object(s, "held");
    const ChangeReport report = s.edit(new_mass("held", mass));
    EXPECT_LT((object(s, "held").X_WO.matrix() - before.X_WO.matrix()).norm(), 1e-12);
    EXPECT_NEAR(report.elastic_energy_after, report.elastic_energy_before, 1e-9 * report.elastic_energy_before);
    EXPECT_EQ(s.scene().bodies[*scene::find_body(s.scene(), "held")].mass_properties.mass, mass);
    s.advance_to(5.9);
    EXPECT_NEAR(s.tool().weight, mass, 1e-3 * mass);
    EXPECT_TRUE(object(s, "held").held);
  }
}

TEST_P(Edits, ARemovedObjectIsLetGoAndWhatLayOnItFalls) {
  Simulation s = lifted();
  s.edit(removal("held"));
  EXPECT_TRUE(s.tool().held_object.empty());
  s.edit(removal("below"));
  s.advance_to(s.time() + 0.1);
  if (GetParam() == ContactMode::none) {
    EXPECT_EQ(object(s, "above").X_WO.translation().z(), 0.15);
    return;
  }
  EXPECT_NEAR(object(s, "above").X_WO.translation().z(), 0.15 - 0.5 * g * 0.01, 1e-12);
  s.advance_to(3.0);
  EXPECT_NEAR(object(s, "above").X_WO.translation().z(), 0.05, 1e-4);
}

TEST_P(Edits, ABodyWithoutMassGetsItsShapesAndMassCanGo) {
  Simulation s = lifted();
  s.edit(new_mass("held", 0.0));
  s.advance_to(2.0);
  EXPECT_TRUE(object(s, "held").held);
  EXPECT_EQ(s.tool().weight, 0.0);
  s.edit(new_mass("held", 1.5));
  const Matrix3d inertia = s.scene().bodies[0].mass_properties.inertia_O;
  EXPECT_LT((inertia - 1.5 / 6.0 * 0.01 * Matrix3d::Identity()).norm(), 1e-12);
  s.advance_to(5.9);
  EXPECT_NEAR(s.tool().weight, 1.5, 2e-3);
}

TEST_P(Edits, AStateOfAnEditedSceneHasTheSameFutureInANewSimulation) {
  Simulation s = lifted();
  s.edit(addition("brick", at(Vector3d(-1.0, 0.0, 0.4), 0.3)));
  s.edit(new_mass("held", 1.3));
  s.edit(removal("below"));
  s.edit(new_friction("above", 0.2));
  s.advance_to(1.7);
  s.edit(new_mass("held", 1.7));
  s.edit(move_to("above", at(Vector3d(1.2, 0.3, 0.4))));
  const SimulationState state = parse_state(serialise(s.save()));
  Simulation other(scene(), {});
  other.restore(state);
  EXPECT_EQ(other.save(), s.save());
  for (const double t : {1.9, 2.5, 3.3}) {
    s.advance_to(t);
    other.advance_to(t);
    EXPECT_EQ(other.state_hash(), s.state_hash()) << t;
  }
  other.restore(lifted().save());  // back to the scene without edits
  EXPECT_EQ(other.save(), lifted().save());
}

TEST_P(Edits, ResetKeepsTheEditsAndPutsWhatWasMovedBack) {
  Simulation s = lifted();
  s.edit(addition("brick", at(Vector3d(-1.0, 0.0, 0.05))));
  s.edit(removal("above"));
  s.edit(move_to("below", at(Vector3d(1.0, 1.0, 0.05))));
  s.reset();
  EXPECT_EQ(s.objects().size(), 3u);
  EXPECT_EQ(object(s, "below").X_WO.translation(), Vector3d(0.6, 0.0, 0.05));
  EXPECT_EQ(object(s, "brick").X_WO.translation(), Vector3d(-1.0, 0.0, 0.07));
}

TEST_P(Edits, WhatDoesNotFitIsRefusedInOneLineAndChangesNothing) {
  Simulation s = lifted();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto expect = [&](const ObjectEdit& edit, const std::string& message) {
    const std::string told = refusal(s, edit);
    EXPECT_EQ(told.substr(0, message.size()), message) << told;
  };
  const std::string objects = "a movable object of the scene (held, below, above)";
  expect(removal("wall"), "name: invalid value 'wall': expected " + objects);
  expect(removal("none"), "name: invalid value 'none': expected " + objects);
  expect(new_mass("held", nan), "mass: invalid value 'nan': expected a number between 0 and 1e12 kg");
  expect(new_mass("held", -1.0), "mass: invalid value '-1': expected a number between 0 and 1e12 kg");
  expect(new_friction("held", -0.1), "friction: invalid value '-0.1': expected a number >= 0");
  expect(move_to("held", at(Vector3d(0.0, 1.0, 0.05))), "name: held is held or pushed; release it first");
  expect({Action::move, "below", "", std::nullopt}, "pose: expected a pose to move to (quaternion not zero)");
  expect(move_to("below", at(Vector3d(nan, 0.0, 0.0))), "pose: expected a finite pose");
  expect(addition("wall", std::nullopt), "name: invalid value 'wall': expected a name that is not in use");
  expect(
      {Action::add, "brick", folder_.path("none.urdf"), std::nullopt},
      "urdf: invalid value '" + folder_.path("none.urdf") + "': expected a readable file (No such file or directory)");
  expect({static_cast<Action>(77), "held", "", std::nullopt},
         "action: invalid value '77': expected one of add, move, remove, mass, friction");
  if (GetParam() == ContactMode::none) return;
  expect(move_to("below", at(Vector3d(2.0, 0.0, 0.3))), "pose: below would overlap wall by more than 0.1 mm");
  expect(addition("brick", at(Vector3d(-1.0, 0.0, 0.049))),
         "pose: brick would overlap the workbench by more than 0.1 mm");
  expect(addition("brick", object(s, "held").X_WO), "pose: brick would overlap ");
}

/// The triangles of what is in the scene count; see LoadScene.TheMeshesOfAddedObjectsCountInTheScenesBudget.
TEST_P(Edits, AnObjectWhoseMeshIsTooMuchForTheSceneFitsWhenAnotherIsRemoved) {
  folder_.write("wedge.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  folder_.write(
      "wedge.urdf",
      "<robot name='wedge'><link name='wedge'><inertial><mass value='2'/>"
      "<inertia ixx='0.01' iyy='0.01' izz='0.01' ixy='0' ixz='0' iyz='0'/></inertial>"
      "<visual><geometry><mesh filename='wedge.obj' scale='0.1 0.1 0.1'/></geometry></visual></link></robot>");
  geometry::TriangleMesh mesh;
  mesh.vertices = {Vector3d::Zero(), Vector3d::UnitX(), Vector3d::UnitY()};
  mesh.triangles.assign(1999998, Eigen::Vector3i(0, 1, 2));
  scene::Scene full = scene();
  full.bodies.back().visual = {{std::make_shared<const geometry::TriangleMesh>(mesh)}};
  Simulation s(full, {});
  const ObjectEdit wedge = {Action::add, "wedge", folder_.path("wedge.urdf"), at(Vector3d(0.0, 0.0, 3.0))};
  EXPECT_NE(refusal(s, wedge).find("triangles of the scene: expected at most 2000000, got 2000002"), std::string::npos);
  s.edit(removal("above"));
  EXPECT_NO_THROW(s.edit(wedge));
}

TEST(EditedFriction, DecidesHowFarABoxSlides) {
  for (const double mu : {0.1, 0.4}) {
    SimulationSettings set;
    set.fork.dofs = {false, false, false};
    Simulation s(scene_of({cube("held", Vector3d(0.0, 0.0, 0.05 + 1e-6))}, ContactMode::stop), set);
    for (double t = 0.0; t < 3.0; t += 0.02) {
      s.push_stylus({t, pointing_down(Vector3d(std::min(t, 0.2), 0.0, 0.05 + set.fork.length))});
    }
    s.push_button(0.0, true);
    s.push_button(0.18, false);
    s.advance_to(0.1);
    s.edit(new_friction("held", mu * mu / 0.5));  // with the bench's 0.5: mu
    s.advance_to(0.18);
    const bodies::BodyState start = s.objects()[0];
    ASSERT_GT(start.V_WO_W.linear.x(), 0.5);
    s.advance_to(2.9);
    const double path = start.V_WO_W.linear.squaredNorm() / (2.0 * mu * g);
    EXPECT_NEAR((s.objects()[0].X_WO.translation() - start.X_WO.translation()).x(), path, 0.01 * path) << mu;
  }
}

}  // namespace
}  // namespace spring_workbench::simulation::edit_object_test
