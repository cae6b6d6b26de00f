#pragma once

#include <string>
#include <vector>

#include "spring_workbench/scene/scene.h"

namespace spring_workbench::benchmark {

/// Limit cases of contact between boxes: the hand presses the held box against others, shifts it along them, and rests.
enum class ContactLimitCase {
  stack_of_ten,          ///< 1 kg each; the held box is put on the other nine
  light_on_heavy,        ///< 1 g, held, on 1 kg
  heavy_on_light,        ///< 1 kg, held, on 1 g
  light_at_wall,         ///< 1e-6 kg, on the bench, pressed against a wall
  heavy_at_wall,         ///< the same with 1e6 kg
  massless_at_wall,      ///< the same without mass
  grasped_touching,      ///< between bench, wall and a neighbour; pressed at the wall, shifted along it and lifted
  grasped_under_another  ///< the same with a fourth box on top
};
const std::vector<ContactLimitCase>& contact_limit_cases();
std::string name_of(ContactLimitCase limit_case);

/// One run through Simulation as used by applications: samples in, poses out.
struct LimitCaseCell {
  ContactLimitCase limit_case = ContactLimitCase::stack_of_ten;
  scene::ContactMode contact = scene::ContactMode::stop;
  double stiffness = 1e3;  ///< of stretch and bend [N/m]; torsion: a hundredth of it [N·m/rad]
  double step = 0.02;      ///< [s]; the hand is sampled at 50 Hz, or once per step if that is longer
  unsigned seed = 0;       ///< of random offsets of the hand's motion, up to 5 mm and 0.05 rad
};

/// Result of a run, evaluated at every sample of the hand.
struct LimitCaseOutcome {
  bool finite = true;        ///< whether poses and twists of all objects were finite
  bool bounded = true;       ///< whether every object stayed within 0.5 m of its start; the hand moves 0.1 m
  double penetration = 0.0;  ///< largest penetration of an object into another or the bench [m]
  /// Largest growth of the energy of all objects and the fork while the hand rests, beyond the work of a proxy handle
  /// that returns to the hand, divided by the weights plus the largest sum of contact forces: the equivalent depth [m].
  double energy_gained = 0.0;
  double pushed = 0.0;     ///< largest displacement of an object that is not held [m]
  int rejected = 0;        ///< steps rejected as not finite or impossible
  int steps_blocked = 0;   ///< steps in which contact did not allow the held box to move
  int steps_unsolved = 0;  ///< substeps in which a contact among movable objects broke its law
  bool stays_out() const { return penetration <= 1e-4; }
  bool gains_nothing() const { return energy_gained <= 3e-6; }
  bool held() const {
    return finite && bounded && stays_out() && gains_nothing() && rejected + steps_blocked + steps_unsolved == 0;
  }
};
LimitCaseOutcome run(const LimitCaseCell& cell);

}  // namespace spring_workbench::benchmark
