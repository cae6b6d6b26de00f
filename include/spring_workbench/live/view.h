#pragma once

#include <memory>
#include <vector>

#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::live {

/// What can be seen of a simulation at one moment: a value, for another thread to read while the simulation goes on.
struct View {
  std::shared_ptr<const scene::Scene> scene;  ///< shared by views between which it was not changed
  simulation::SimulationSettings settings;
  double time = 0.0, world_time = 0.0;          ///< see Simulation [s]
  std::vector<bodies::BodyState> objects;       ///< the movable objects, in the scene's order
  std::vector<tools::ToolState> tools;          ///< the tool in each hand
  std::vector<contact::ContactState> contacts;  ///< see Simulation

  /// Calls `use(state, body in the scene)` for each object.
  template <typename Use>
  void for_each_object(Use&& use) const {
    auto object = objects.begin();
    for (const scene::Body& body : scene->bodies) {
      if (body.movable) use(*object++, body);
    }
  }
};

/// `scene`: the simulation's present one.
View view_of(const simulation::Simulation& simulation, std::shared_ptr<const scene::Scene> scene);

}  // namespace spring_workbench::live
