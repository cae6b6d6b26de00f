#include "spring_workbench/rod/static_deformation.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "constants.h"
#include "spring_workbench/math/spatial.h"
#include "spring_workbench/math/symmetric_modes.h"

namespace spring_workbench::rod {
/// Derivative in coordinates scaled by the springs, x = √K q, so that the matrix is near the identity for small loads.
struct StaticDeformation::Slope {
  StrainMatrix A;      ///< derivative of the scaled force with respect to the scaled coordinates
  StrainVector scale;  ///< 1 / √K
  StrainVector moves;  ///< displacement of the tip per unit of q; 0 for the stretch, which is linear
  math::SymmetricModes modes;

  bool is_stable() const { return modes.values.minCoeff() > flat * largest(); }
  double largest() const { return modes.values.cwiseAbs().maxCoeff(); }
  /// Inverse with the absolute values of the eigenvalues, so that it gives a descent direction at a maximum or saddle,
  /// too.
  StrainMatrix inverse() const {
    const StrainVector d = modes.values.cwiseAbs().cwiseMax(flat * largest()).cwiseInverse();
    return modes.vectors * d.asDiagonal() * modes.vectors.transpose();
  }
  StrainVector change(const StrainVector& imbalance) const {
    const StrainVector force = scale.cwiseProduct(imbalance);
    const StrainVector x = is_stable() ? StrainVector(A.partialPivLu().solve(force)) : inverse() * force;
    return -scale.cwiseProduct(x);
  }
};

StaticDeformation::Block StaticDeformation::block(bool torsion) const {
  Block b;
  for (int i = 0; i < shape_.size(); ++i) {
    const bool sought = active_[static_cast<std::size_t>(i)] && K_[i] > 0.0;
    if (sought && (i == shape_.torsion().begin) == torsion) b.index[b.count++] = i;
  }
  return b;
}

StrainVector StaticDeformation::force(const StrainVector& q, const Vector6d& load_H) const {
  return force(tip_at(q), load_H);
}

TipKinematics StaticDeformation::tip_at(const StrainVector& q) const {
  TipKinematics tip;
  shape_.tip(q, StrainVector::Zero(q.size()), tip);
  return tip;
}

StrainVector StaticDeformation::force(const TipKinematics& tip, const Vector6d& load_H) const {
  const Vector3d force = load_H.head<3>(), moment = load_H.tail<3>() + (tip.R_HE * p_EO_).cross(force);
  return tip.linear.transpose() * force + tip.angular.transpose() * moment;
}

StaticDeformation::Forces StaticDeformation::forces(const math::Pack* q) const {
  const math::Pack none{}, at_rest[max_strain_coordinates]{};
  const auto in_lanes = [&](const Vector3d& v) {
    return math::Vec3<math::Pack>{v.x() + none, v.y() + none, v.z() + none};
  };
  TipOf<math::Pack> tip;  // NOLINT(cppcoreguidelines-pro-type-member-init): tip() sets all of it
  shape_.tip(q, at_rest, tip);
  const math::Vec3<math::Pack> force = in_lanes(load_H_.force),
                               moment = in_lanes(load_H_.moment) + cross(tip.R_HE * in_lanes(p_EO_), force);
  Forces f{};
  for (int c = 0; c < shape_.size(); ++c) {
    f[static_cast<std::size_t>(c)] = dot(tip.linear[c], force) + dot(tip.angular[c], moment);
  }
  return f;
}

StrainVector StaticDeformation::imbalance(const StrainVector& q, const TipKinematics& tip) const {
  return K_.cwiseProduct(q) - force(tip, to_vector(load_H_));
}

StaticDeformation::Slope StaticDeformation::slope(const StrainVector& q, const TipKinematics& tip,
                                                  const Block& b) const {
  const StrainVector here = force(tip, to_vector(load_H_));
  const double length = shape_.length();
  Slope s;
  s.A.resize(b.count, b.count);
  s.scale.resize(b.count);
  s.moves.resize(b.count);
  for (int j = 0; j < b.count; ++j) s.scale[j] = 1.0 / std::sqrt(K_[b.index[j]]);
  for (int first = 0; first < b.count; first += math::pack_size) {  // one coordinate in each lane
    const int count = std::min(math::pack_size, b.count - first);
    math::Pack ahead[max_strain_coordinates];
    for (int c = 0; c < shape_.size(); ++c) ahead[c] = q[c] + math::Pack{};
    for (int k = 0; k < count; ++k) {
      const int j = first + k, c = b.index[j];
      const double moved = tip.linear.col(c).norm() / length + tip.angular.col(c).norm();
      ahead[c][k] += tip_difference / std::max(moved, least_leverage * length) + strain_digits * std::abs(q[c]);
      s.moves[j] = c == shape_.stretch().begin ? 0.0 : moved;
    }
    const Forces there = forces(ahead);
    // Only the load's part: that of the springs is exactly 1, so it causes no cancellation, stiff or soft.
    for (int k = 0; k < count; ++k) {
      const int j = first + k, c = b.index[j];
      const double step = ahead[c][k] - q[c];
      for (int i = 0; i < b.count; ++i) {
        const double rise = here[b.index[i]] - there[static_cast<std::size_t>(b.index[i])][k];
        s.A(i, j) = s.scale[i] * s.scale[j] * rise / step + (i == j);
      }
    }
  }
  s.modes = math::symmetric_modes(0.5 * (s.A + s.A.transpose()));
  return s;
}

bool StaticDeformation::stop(const StrainVector& change, Block& b, StrainVector& q) const {
  Block free;
  for (int i = 0; i < b.count; ++i) {
    const auto moved = [&](double share) {
      StrainVector tried = q;
      tried[b.index[i]] += share * change[i];
      return tried;
    };
    if (shape_.admissible(moved(1.0))) {
      free.index[free.count++] = b.index[i];
      continue;
    }
    double least = 0.0, most = 1.0;
    for (int k = 0; k < halvings_to_stop; ++k) {
      const double middle = 0.5 * (least + most);
      (shape_.admissible(moved(middle)) ? least : most) = middle;
    }
    q = moved(least);
  }
  const bool stopped = free.count < b.count;
  b = free;
  return stopped;
}

StaticDeformation::Block StaticDeformation::find(Block b, StrainVector& q) const {
  double reach = first_reach;
  TipKinematics tip = tip_at(q);
  for (int n = 0; n < max_changes && b.count > 0; ++n) {
    const StrainVector unbalanced = imbalance(q, tip);
    const Slope s = slope(q, tip, b);
    const auto of_block = [&](const StrainVector& all) {
      StrainVector v(b.count);
      for (int i = 0; i < b.count; ++i) v[i] = all[b.index[i]];
      return v;
    };
    const StrainVector r = of_block(unbalanced);
    StrainVector change = s.change(r);
    const double moved = s.moves.dot(change.cwiseAbs());
    const double whole = std::min(moved, reach);
    if (moved > reach) change *= reach / moved;
    if (stop(change, b, q)) {
      tip = tip_at(q);
      continue;
    }
    bool went = false;
    // Accept the change if the force along it has decreased at its end and has not overshot.
    for (int halving = 0; halving < max_search_halvings; ++halving, change *= 0.5) {
      StrainVector tried = q;
      for (int i = 0; i < b.count; ++i) tried[b.index[i]] += change[i];
      if (!shape_.admissible(tried)) continue;
      const TipKinematics there = tip_at(tried);
      if (!(of_block(imbalance(tried, there)).dot(change) <= overshoot * std::abs(r.dot(change)))) continue;
      q = tried;
      tip = there;
      went = true;
      break;
    }
    if (!went || moved < settled * (1.0 + s.moves.dot(of_block(q).cwiseAbs()))) break;
    const double gone = s.moves.dot(change.cwiseAbs());
    reach = gone < nearly_whole * whole ? gone : moved > reach ? reach_growth * reach : reach;
  }
  return b;
}

EquilibriumStrain StaticDeformation::under_load(const StrainVector& from) const {
  EquilibriumStrain rest;
  rest.q = from;
  for (int i = 0; i < shape_.size(); ++i) {
    if (active_[static_cast<std::size_t>(i)] && !(K_[i] > 0.0)) rest.q[i] = 0.0;
  }
  Block free = find(block(false), rest.q);
  const Block free_torsion = find(block(true), rest.q);
  rest.compliance.setZero(shape_.size(), shape_.size());
  for (int i = 0; i < free_torsion.count; ++i) free.index[free.count++] = free_torsion.index[i];
  rest.imbalance.setZero(shape_.size());
  if (free.count == 0) return rest;
  const TipKinematics tip = tip_at(rest.q);
  const StrainVector unbalanced = imbalance(rest.q, tip);
  const Slope s = slope(rest.q, tip, free);
  const StrainMatrix inverse = s.inverse();
  for (int j = 0; j < free.count; ++j) {
    rest.imbalance[free.index[j]] = unbalanced[free.index[j]];
    for (int i = 0; i < free.count; ++i) {
      rest.compliance(free.index[i], free.index[j]) = s.scale[i] * s.scale[j] * inverse(i, j);
    }
  }
  return rest;
}

}  // namespace spring_workbench::rod
