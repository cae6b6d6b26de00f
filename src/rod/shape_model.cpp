#include "spring_workbench/rod/shape_model.h"

#include "bushing.h"
#include "spring_workbench/validation/number_rule.h"
#include "strain_rod.h"

namespace spring_workbench::rod {

void ShapeModel::tip(const StrainVector& q, const StrainVector& q_dot, TipKinematics& out) const {
  TipOf<double> tip_of{};
  tip(q.data(), q_dot.data(), tip_of);
  out.R_HE = math::matrix(tip_of.R_HE, 0);
  out.p_HE = math::vector(tip_of.p_HE);
  out.angular.resize(3, size());
  out.linear.resize(3, size());
  for (int i = 0; i < size(); ++i) {
    out.angular.col(i) = math::vector(tip_of.angular[i]);
    out.linear.col(i) = math::vector(tip_of.linear[i]);
  }
  out.angular_bias = math::vector(tip_of.angular_bias);
  out.linear_bias = math::vector(tip_of.linear_bias);
}

StrainVector ShapeModel::damping(const PerDof& c, const PerDof&) const { return stiffness(c); }

bool ShapeModel::rechart(StrainVector&, StrainVector&) const { return false; }

std::shared_ptr<const ShapeModel> make_shape_model(ShapeKind kind, double length,
                                                   std::optional<double> slope_stiffness) {
  validation::check_number("fork", "length", length, validation::positive().in("m"));
  switch (kind) {
    case ShapeKind::constant:
      return std::make_shared<StrainRod>(length, 1);
    case ShapeKind::linear:
      return std::make_shared<StrainRod>(length, 2);
    case ShapeKind::bushing:
      break;
  }
  return std::make_shared<Bushing>(length, slope_stiffness);
}

}  // namespace spring_workbench::rod
