#pragma once

#include "spring_workbench/math/square_system.h"
#include "spring_workbench/rod/shape_model.h"

namespace spring_workbench::rod {

/// Inverse kinematics of a shape model with six coordinates: strain and strain rate for a prescribed motion of the tip
/// E, for one motion (`S` = double) or several at once. If the rod cannot reach the pose (end of its range or of its
/// workspace), the result is the nearest strain on the path from the last one: the tip lags behind, and rates and
/// wrenches stay finite.
template <typename S>
struct TipFit {
  S q[max_strain_coordinates], q_dot[max_strain_coordinates];
  TipOf<S> tip;  ///< tip for the strain `q`

  /// `R_HE`, `p_HE`: the prescribed pose; velocities in H axes. Newton's method, starting at the strain `start` or, if
  /// the branch of solutions from there ends, at the straight rod; a closed form for `bushing`. Keeps a reference to
  /// `shape`.
  TipFit(const ShapeModel& shape, const math::Mat3x3<S>& R_HE, const math::Vec3<S>& p_HE, const math::Vec3<S>& v_HE,
         const math::Vec3<S>& w_HE, const S* start);

  /// Computes force and moment at the tip, in H axes, such that `Jᵀ (force, moment) = generalised`, the generalised
  /// forces.
  void wrench(const S (&generalised)[max_strain_coordinates], math::Vec3<S>& force, math::Vec3<S>& moment) const;

 private:
  void find_strain(const math::Mat3x3<S>& R_HE, const math::Vec3<S>& p_HE, const S* start);
  /// Newton's method from the current `q`. Returns whether it converged as predicted by the derivative, inside the
  /// rod's range.
  bool follow_slope(const math::Mat3x3<S>& R_HE, const math::Vec3<S>& p_HE);

  const ShapeModel& shape_;
  math::SquareSystem<max_strain_coordinates, S>
      exact_;  ///< the tip's Jacobian; linear velocities divided by the rod's length
  bool near_singular_[math::lanes<S>] =
      {};  ///< whether the Jacobian is nearly singular: the tip can hardly move in some direction
};

extern template struct TipFit<double>;
extern template struct TipFit<math::Pack>;

}  // namespace spring_workbench::rod
