#pragma once

#include <memory>
#include <vector>

#include "spring_workbench/live/shared_states.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::live {

/// Snapshot of the visible state of a simulation: a value that another thread can read while the simulation continues.
struct View {
  std::shared_ptr<const scene::Scene> scene;  ///< shared between views until it changes
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
  /// The scene with its objects where they are now, instead of at their start poses.
  spring_workbench::scene::Scene present_scene() const;
};

/// Makes a view. `scene`: the simulation's current scene; `objects`: those of the previous view, which are updated.
View view_of(const simulation::Simulation& simulation, std::shared_ptr<const scene::Scene> scene,
             SharedStates& objects);

}  // namespace spring_workbench::live
