#pragma once

#include "spring_workbench/dynamics/integrator.h"

namespace spring_workbench::stepping {

/// How a held body answers, to first order, to a change of the constant load of a step, where contact decides what the
/// load is. A stop at the end of the rod's range that a correction meets holds until the next step.
class LoadResponse {
 public:
  /// Begins a step of a body with `size` coordinates: no stop has been met.
  void begin_step(int size) { stops_.resize(size, 0); }
  /// The stops met in this step: by column, how much more of its range the rod uses, by strain.
  const rod::StrainMatrix& stops() const { return stops_; }

  /// The integrator's response or, where that is not positive definite (far from straight), that of springs, dampers
  /// and mass alone by the implicit Euler rule, so that nothing moves against its load. It does not cross stops met.
  dynamics::Integrator::Response response(dynamics::Integrator& integrator, const dynamics::HeldBody& body,
                                          const dynamics::HandleForcing& handle, double h,
                                          const dynamics::StrainState& state) const;
  /// Moves `state`, the end of a step of `h` [s] to the moment of `handle`, to where it would be under a generalised
  /// force larger by `change`, within the rod's range.
  void correct(dynamics::Integrator& integrator, const dynamics::HeldBody& body, const dynamics::HandleForcing& handle,
               double h, const rod::StrainVector& change, dynamics::StrainState& state);

 private:
  rod::StrainMatrix stops_;
};

}  // namespace spring_workbench::stepping
