#include "spring_workbench/live/view.h"

#include <utility>

namespace spring_workbench::live {

spring_workbench::scene::Scene View::present_scene() const {
  auto present = *scene;
  auto object = objects.begin();
  for (auto& body : present.bodies) {
    if (!body.movable) continue;
    body.X_WO = object->X_WO;
    ++object;
  }
  return present;
}

View view_of(const simulation::Simulation& simulation, std::shared_ptr<const scene::Scene> scene,
             SharedStates& objects) {
  objects.update_from(simulation);
  View view{std::move(scene),     simulation.settings(), simulation.time(), simulation.world_time(), objects, {},
            simulation.contacts()};
  for (std::size_t hand = 0; hand < simulation.hands(); ++hand) view.tools.push_back(simulation.tool(hand));
  return view;
}

}  // namespace spring_workbench::live
