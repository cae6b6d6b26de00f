#pragma once

#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::markers {

/// Calls `use(state of the object, its body in the scene)` for each object, in a single pass: objects are in the order
/// of the scene.
template <typename Use>
void for_each_object(const simulation::Simulation& simulation, Use&& use) {
  auto body = simulation.scene().bodies.begin();
  for (const bodies::BodyState& object : simulation.objects()) {
    while (body->name != object.name) ++body;
    use(object, *body++);
  }
}

}  // namespace spring_workbench::markers
