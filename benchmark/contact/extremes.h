#pragma once

#include <string>
#include <vector>

#include "spring_workbench/scene/scene.h"

namespace spring_workbench::benchmark {

/// What is extreme about a scene of boxes: the hand presses the held one against others, shifts it along them, and
/// rests.
enum class ContactExtreme {
  stack_of_ten,          ///< 1 kg each; the held one is put on the other nine
  light_on_heavy,        ///< 1 g, held, on 1 kg
  heavy_on_light,        ///< 1 kg, held, on 1 g
  light_at_wall,         ///< 1e-6 kg, on the bench, pressed against a wall
  heavy_at_wall,         ///< 1e6 kg likewise
  massless_at_wall,      ///< likewise
  grasped_touching,      ///< between bench, wall and a neighbour; pressed at the wall, shifted along it and lifted
  grasped_under_another  ///< likewise, with a fourth on top
};
const std::vector<ContactExtreme>& contact_extremes();
std::string name_of(ContactExtreme extreme);

/// One run, through Simulation, as a user would: samples in, poses out.
struct ExtremeCell {
  ContactExtreme extreme = ContactExtreme::stack_of_ten;
  scene::ContactMode contact = scene::ContactMode::stop;
  double stiffness = 1e3;  ///< of stretch and bend [N/m]; of torsion a hundredth of it [N·m/rad]
  double step = 0.02;      ///< [s]; the hand is sampled at 50 Hz, or at the step where that is longer
  unsigned seed = 0;       ///< up to 5 mm and 0.05 rad of where the hand goes
};

/// What came of it, looked at with every sample of the hand.
struct ExtremeOutcome {
  bool finite = true;        ///< poses and twists of all objects
  bool bounded = true;       ///< none of them more than 0.5 m from where it began; the hand goes 0.1 m
  double penetration = 0.0;  ///< the deepest of an object in another or the bench [m]
  /// Largest growth of the energy of all objects and the fork while the hand rests, beyond the work of a handle that
  /// was held back and comes back to it, over the weights and the largest sum of contact forces: a depth that is worth
  /// as much [m].
  double energy_gained = 0.0;
  double pushed = 0.0;    ///< the longest way of what is not held, from where it began [m]
  int refused = 0;        ///< steps that would not have been finite or possible
  int steps_blocked = 0;  ///< steps in which contact left the held one no way
  bool stays_out() const { return penetration <= 1e-4; }
  bool gains_nothing() const { return energy_gained <= 3e-6; }
  bool held() const {
    return finite && bounded && stays_out() && gains_nothing() && refused == 0 && steps_blocked == 0;
  }
};
ExtremeOutcome run(const ExtremeCell& cell);

}  // namespace spring_workbench::benchmark
