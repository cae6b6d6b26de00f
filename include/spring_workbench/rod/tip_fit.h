#pragma once

#include "spring_workbench/rod/shape_model.h"

namespace spring_workbench::rod {

/// Inverse kinematics of a shape of six coordinates: the strain, and its rate, with which the tip E moves as it is
/// told. For one motion (`S` double) or several.
template <typename S>
struct TipFit {
  S q[max_strain_coordinates], q_dot[max_strain_coordinates];

  /// `R_HE`, `p_HE`: the pose; velocities in the axes of H. Goes from the strain `start` on, by Newton's method; a
  /// `bushing` has a closed form. Not finite where no strain was found.
  TipFit(const ShapeModel& shape, const math::ThreeByThree<S>& R_HE, const math::Three<S>& p_HE,
         const math::Three<S>& v_HE, const math::Three<S>& w_HE, const S* start);

  /// Force and moment at the tip, axes of H, with which `Jᵀ (force, moment) = generalised`, the coordinates' forces.
  void wrench(const S (&generalised)[max_strain_coordinates], math::Three<S>& force, math::Three<S>& moment) const;

 private:
  void find_strain(const ShapeModel& shape, const math::ThreeByThree<S>& R_HE, const math::Three<S>& p_HE);

  double length_;
  TipOf<S> tip_;
};

extern template struct TipFit<double>;
extern template struct TipFit<math::Pack>;

}  // namespace spring_workbench::rod
