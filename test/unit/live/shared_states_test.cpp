#include "spring_workbench/live/shared_states.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/bench_scenes.h"

namespace spring_workbench::live::shared_states_test {
namespace {

/// A row of boxes on the bench, of which the hand takes the one in the middle.
scene::Scene row(std::size_t count, scene::ContactMode mode) {
  std::vector<scene::Body> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = 0.1 * (static_cast<double>(i) - 0.5 * static_cast<double>(count));
    boxes.push_back(box("box" + std::to_string(i), Vector3d(0.04, 0.04, 0.04), 0.1, {x, 0.0, 0.02}));
  }
  return scene_of(boxes, mode);
}

bool same(const bodies::BodyState& a, const bodies::BodyState& b) {
  return a.name == b.name && a.X_WO.matrix() == b.X_WO.matrix() && a.V_WO_W.linear == b.V_WO_W.linear &&
         a.V_WO_W.angular == b.V_WO_W.angular && a.held == b.held && a.highlighted == b.highlighted &&
         a.in_contact == b.in_contact && a.asleep == b.asleep;
}

void expect_same(const SharedStates& states, const simulation::Simulation& simulation) {
  ASSERT_EQ(states.size(), simulation.objects().size());
  std::size_t i = 0;
  for (const bodies::BodyState& state : states) {
    EXPECT_TRUE(same(state, simulation.objects()[i])) << i;
    ++i;
  }
}

/// Whatever is held, dropped, edited, reset or restored, a value equals the simulation's state at that moment and
/// shares the unchanged parts. The same holds for the displayed copy.
TEST(SharedStates, AreThoseOfTheSimulationAndShareWhatStays) {
  for (const scene::ContactMode mode :
       {scene::ContactMode::none, scene::ContactMode::stop, scene::ContactMode::dynamic}) {
    const scene::Scene scene = row(100, mode);
    simulation::Simulation simulation(scene, {}), copy(scene, {});
    const simulation::SimulationState first = simulation.save();
    SharedStates states, copied;
    std::size_t shared = 0, parts = 0;
    for (int k = 0; k < 250; ++k) {
      const double t = 0.01 * k;
      const Vector3d p(0.05 * std::sin(3.0 * t), 0.0, k < 60 ? 0.22 : 0.26);
      if (k == 120) simulation.edit({simulation::ObjectEdit::Action::remove, "box10", "", std::nullopt});
      if (k == 140) simulation.reset();
      if (k == 160) simulation.restore(first);
      simulation.push_stylus({t, pointing_down(p)});
      if (k % 80 == 20 || k % 80 == 60) simulation.push_button(t, k % 80 == 20);
      simulation.advance_to(t);
      const SharedStates before = states;
      states.update_from(simulation);
      expect_same(states, simulation);
      for (std::size_t part = 0; part < states.parts().size(); ++part) shared += states.shares(part, before) ? 1 : 0;
      parts += states.parts().size();
      copy.copy_state_from(simulation);
      ASSERT_TRUE(copy.save() == simulation.save()) << k;
      copy.push_button(t, k % 7 < 3);
      copy.advance_to(t + 0.03);
      copied.update_from(copy);
      expect_same(copied, copy);
    }
    EXPECT_GT(shared, parts / 2);
    EXPECT_LT(shared, parts);
  }
}

}  // namespace
}  // namespace spring_workbench::live::shared_states_test
