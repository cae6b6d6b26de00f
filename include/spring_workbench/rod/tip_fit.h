#pragma once

#include "spring_workbench/math/square_system.h"
#include "spring_workbench/rod/shape_model.h"

namespace spring_workbench::rod {

/// Inverse kinematics of a shape model of six coordinates: strain and strain rate for a prescribed motion of the tip E,
/// for one motion (`S` double) or several. If the rod cannot reach the pose (at the end of its range, or of its
/// workspace), it is the strain on the path from the last one that comes nearest: the tip stays behind, and rates and
/// wrenches are finite.
template <typename S>
struct TipFit {
  S q[max_strain_coordinates], q_dot[max_strain_coordinates];
  TipOf<S> tip;  ///< of `q`: what it reaches of the pose

  /// `R_HE`, `p_HE`: the pose; velocities in the axes of H. Newton's method, starting at the strain `start` or, if the
  /// branch of solutions from there ends, at the straight rod. A `bushing` has a closed form. Keeps a reference to
  /// `shape`.
  TipFit(const ShapeModel& shape, const math::ThreeByThree<S>& R_HE, const math::Three<S>& p_HE,
         const math::Three<S>& v_HE, const math::Three<S>& w_HE, const S* start);

  /// Force and moment at the tip, axes of H, with which `Jᵀ (force, moment) = generalised`, the coordinates' forces.
  void wrench(const S (&generalised)[max_strain_coordinates], math::Three<S>& force, math::Three<S>& moment) const;

 private:
  void find_strain(const math::ThreeByThree<S>& R_HE, const math::Three<S>& p_HE, const S* start);
  /// Newton's method from `q` on. Returns whether its steps did what the slope predicted, inside the rod's range.
  bool follow_slope(const math::ThreeByThree<S>& R_HE, const math::Three<S>& p_HE);

  const ShapeModel& shape_;
  math::SquareSystem<max_strain_coordinates, S> exact_;  ///< the tip's Jacobian, velocities over the rod's length
  bool near_singular_[math::lanes<S>] = {};              ///< the Jacobian: the tip can hardly move in some direction
};

extern template struct TipFit<double>;
extern template struct TipFit<math::Pack>;

}  // namespace spring_workbench::rod
