#pragma once

#include "spring_workbench/dynamics/integrator.h"

namespace spring_workbench::stepping {

/// First-order response of a held body to a change of the constant load of a step, for contact, which determines that
/// load. If a correction reaches a stop at the end of the rod's range, that stop acts until the next step.
class LoadResponse {
 public:
  /// Begins a step of a body with `size` coordinates, without stops.
  void begin_step(int size) { stops_.resize(size, 0); }
  /// The stops met in this step; each column is the derivative of the used fraction of the range by the strain.
  const rod::StrainMatrix& stops() const { return stops_; }

  /// Returns the response of the integrator or, if that is not positive definite (far from straight), the response of
  /// springs, dampers and mass alone by the implicit Euler rule, so that nothing moves against its load. Stops that
  /// were met are not crossed.
  dynamics::Integrator::Response response(dynamics::Integrator& integrator, const dynamics::HeldBody& body,
                                          const dynamics::HandleState& handle, double h,
                                          const dynamics::StrainState& state) const;
  /// Corrects `state`, the result of a step of `h` [s] that ends at the time of `handle`, for a change of the
  /// generalised force by `change`, within the rod's range.
  void correct(dynamics::Integrator& integrator, const dynamics::HeldBody& body, const dynamics::HandleState& handle,
               double h, const rod::StrainVector& change, dynamics::StrainState& state);

 private:
  rod::StrainMatrix stops_;
};

}  // namespace spring_workbench::stepping
