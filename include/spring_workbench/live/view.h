#pragma once

#include <memory>
#include <vector>

#include "spring_workbench/live/shared_states.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::live {

/// What can be seen of a simulation at one moment: a value, for another thread to read while the simulation goes on.
struct View {
  std::shared_ptr<const scene::Scene> scene;  ///< shared by views between which it was not changed
  simulation::SimulationSettings settings;
  double time = 0.0, world_time = 0.0;          ///< see Simulation [s]
  SharedStates objects;                         ///< the movable objects, in the scene's order
  std::vector<tools::ToolState> tools;          ///< the tool in each hand
  std::vector<contact::ContactState> contacts;  ///< see Simulation

  /// Calls `use(state, body in the scene)` for each object.
  template <typename Use>
  void for_each_object(Use&& use) const {
    std::size_t object = 0;
    for (const scene::Body& body : scene->bodies) {
      if (body.movable) use(objects[object++], body);
    }
  }
};

/// `scene`: the simulation's present one; `objects`: of the view before, which follow.
View view_of(const simulation::Simulation& simulation, std::shared_ptr<const scene::Scene> scene,
             SharedStates& objects);

}  // namespace spring_workbench::live
