// Fills a message of spring_workbench with the result of a simulation by its library.
#include <spring_workbench/ForkState.h>
#include <spring_workbench/spring_workbench.h>

#include <iostream>

using namespace spring_workbench;

int main(int, char** argv) {
  simulation::SimulationSettings settings;
  settings.contact = scene::ContactMode::none;
  settings.grasp.object = "box";
  simulation::Simulation simulation(scene::load_scene(argv[1]), settings);
  for (const double t : {0.0, 10.0}) {
    simulation.push_stylus({t, make_transform({0.0, 0.0, 0.23}, Quaterniond(0.0, 1.0, 0.0, 0.0))});
  }
  simulation.advance_to(10.0);
  ForkState message;
  message.held_object = simulation.tool().held_object;
  message.stretch = simulation.tool().stretch;
  std::cout << "held_object: " << message.held_object << "\nstretch: " << message.stretch << "\n";
}
