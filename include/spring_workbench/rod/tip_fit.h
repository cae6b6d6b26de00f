#pragma once

#include "spring_workbench/math/square_system.h"
#include "spring_workbench/rod/shape_model.h"

namespace spring_workbench::rod {

/// Inverse kinematics of a shape of six coordinates: the strain, and its rate, with which the tip E moves as it is
/// told. For one motion (`S` double) or several. Where the rod cannot (the end of its range, or of the poses that it
/// reaches) it is the strain that comes nearest to the pose, on the way from the one before: its tip stays behind, and
/// rates and wrenches are finite.
template <typename S>
struct TipFit {
  S q[max_strain_coordinates], q_dot[max_strain_coordinates];
  TipOf<S> tip;  ///< of `q`: what it reaches of the pose

  /// `R_HE`, `p_HE`: the pose; velocities in the axes of H. Goes from the strain `start` on, by Newton's method; if the
  /// solutions that lead on from it end, from the straight rod. A `bushing` has a closed form. Keeps a reference to
  /// `shape`.
  TipFit(const ShapeModel& shape, const math::ThreeByThree<S>& R_HE, const math::Three<S>& p_HE,
         const math::Three<S>& v_HE, const math::Three<S>& w_HE, const S* start);

  /// Force and moment at the tip, axes of H, with which `Jᵀ (force, moment) = generalised`, the coordinates' forces.
  void wrench(const S (&generalised)[max_strain_coordinates], math::Three<S>& force, math::Three<S>& moment) const;

 private:
  void find_strain(const math::ThreeByThree<S>& R_HE, const math::Three<S>& p_HE, const S* start);
  /// Newton's method from `q` on. Returns whether it went as the slope foretold, in the rod's range.
  bool follow_slope(const math::ThreeByThree<S>& R_HE, const math::Three<S>& p_HE);

  const ShapeModel& shape_;
  math::SquareSystem<max_strain_coordinates, S> exact_;  ///< the tip's Jacobian, velocities over the rod's length
  bool at_its_end_[math::lanes<S>];                      ///< it is all but singular: the tip can hardly move somewhere
};

extern template struct TipFit<double>;
extern template struct TipFit<math::Pack>;

}  // namespace spring_workbench::rod
