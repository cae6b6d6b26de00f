#include "joint_solution.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "constants.h"

namespace spring_workbench::friction {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Anderson's acceleration of a fixed-point iteration: goes where the last steps together would come to rest [WN11].
class Acceleration {
 public:
  void forget() {
    count_ = 0;
    any_ = false;
  }
  /// The next point after `point`, from which the iteration itself would go by `step`.
  VectorXd next(const VectorXd& point, const VectorXd& step) {
    if (any_) {
      if (count_ == 0) {
        points_.resize(point.size(), anderson_depth);
        steps_.resize(point.size(), anderson_depth);
      }
      points_.col(count_ % anderson_depth) = point - point_;
      steps_.col(count_ % anderson_depth) = step - step_;
      ++count_;
    }
    any_ = true;
    point_ = point;
    step_ = step;
    if (count_ == 0) return point + step;
    const auto known = std::min<Index>(count_, anderson_depth);
    const auto S = steps_.leftCols(known);
    MatrixXd gram = S.transpose() * S;
    gram.diagonal().array() += 1e-12 * gram.trace();
    const VectorXd share = gram.ldlt().solve(S.transpose() * step);
    return point + step - (points_.leftCols(known) + S) * share;
  }

 private:
  MatrixXd points_, steps_;  ///< differences
  VectorXd point_, step_;
  int count_ = 0;
  bool any_ = false;
};

/// The load of a contact by Coulomb's law: presses only, and across at most friction times the normal load. `slope`:
/// its derivative by x, which is not symmetric.
Vector3d project_by_coulomb(const Vector3d& x, double friction, Matrix3d* slope) {
  if (slope != nullptr) slope->setZero();
  if (!(x[0] > 0.0)) return Vector3d::Zero();
  const double across = x.tail<2>().norm();
  if (across <= friction * x[0]) {
    if (slope != nullptr) slope->setIdentity();
    return x;
  }
  const Eigen::Vector2d towards = x.tail<2>() / across;
  if (slope != nullptr) {
    (*slope)(0, 0) = 1.0;
    slope->bottomLeftCorner<2, 1>() = friction * towards;
    slope->bottomRightCorner<2, 2>() =
        friction * x[0] / across * (Eigen::Matrix2d::Identity() - towards * towards.transpose());
  }
  return {x[0], friction * x[0] * towards[0], friction * x[0] * towards[1]};
}

}  // namespace

template <typename Function>
void JointSolution::each(const Function& function) const {
  for (std::size_t k = 0; k < active_.size(); ++k)
    function(contacts_->contacts()[active_[k]], static_cast<Index>(3 * k));
}

bool JointSolution::activate() {
  const std::vector<std::size_t> before = std::exchange(active_, {});
  for (std::size_t i = 0; i < contacts_->contacts().size(); ++i) {
    const auto& c = contacts_->contacts()[i];
    if (!(c.scale > 0.0)) continue;
    if (std::binary_search(before.begin(), before.end(), i) ||
        !is_open(c, contacts_->motion(c, contacts_->reduced()))) {
      active_.push_back(i);
    }
  }
  return active_.size() > before.size();
}

VectorXd JointSolution::loads() const {
  VectorXd loads(static_cast<Index>(3 * active_.size()));
  each([&](const auto& c, Index i) { loads.segment<3>(i) = c.load; });
  return loads;
}

void JointSolution::set_loads(const VectorXd& loads) {
  VectorXd all = VectorXd::Zero(static_cast<Index>(3 * contacts_->contacts().size()));
  for (std::size_t k = 0; k < active_.size(); ++k)
    all.segment<3>(static_cast<Index>(3 * active_[k])) = loads.segment<3>(static_cast<Index>(3 * k));
  contacts_->set_loads(all);
}

double JointSolution::offer(const VectorXd& loads) {
  set_loads(loads);
  double residual = 0.0;
  each([&](const auto& c, Index) {
    const double off = residual_at(c, contacts_->motion(c, contacts_->reduced()));
    if (!(off <= residual)) residual = off;  // one that is no number, too
  });
  const double most = residual <= enough_ ? 1.0 : worthwhile_reduction;
  if (residual < most * result_->residual) {
    result_->residual = residual;
    best_ = loads;
  }
  return residual;
}

void JointSolution::improve(ReducedContacts& contacts, double wanted, double enough, ContactProblem::Result& result) {
  contacts_ = &contacts;
  result_ = &result;
  wanted_ = wanted;
  enough_ = enough;
  active_.clear();
  VectorXd best = contacts.loads();
  double least = result.residual;
  while (result.residual > wanted && activate()) {
    best_ = loads();
    factor_.set_pattern(contacts, active_);
    alternate();
    if (result.residual > enough) linearise();
    set_loads(best_);
    result.residual = contacts.residual();
    if (!(result.residual < least)) continue;
    least = result.residual;
    best = contacts.loads();
  }
  result.residual = least;
  contacts.set_loads(best);
}

double JointSolution::target_residual(int alternation) const {
  return alternation < max_fine_alternations ? wanted_ : enough_;
}

bool JointSolution::factorize(double penalty) {
  ++result_->factors;
  return factor_.factorize(*contacts_, std::vector<Matrix3d>(active_.size(), penalty * Matrix3d::Identity()));
}

// --- Alternating directions: motions z in the dual cones on one side, u by the bodies on the other. The iteration is
// on w = z − λ / penalty, of which z and λ are the parts in the dual cone and in the cone.

struct JointSolution::Alternation {
  double penalty = 1.0;
  VectorXd w, z, load;  ///< load: by the penalty
};

VectorXd JointSolution::direction(const Alternation& at, VectorXd& reduced) const {
  VectorXd right_side = VectorXd::Zero(contacts_->size());
  each([&](const auto& c, Index i) {
    Vector3d target = at.z.template segment<3>(i) + at.load.template segment<3>(i) - c.motion;
    target[0] -= shift(at.z.template segment<3>(i), c.friction);
    contacts_->apply(c, at.penalty * target, right_side);
  });
  reduced = factor_.solve(right_side);
  VectorXd step = VectorXd::Zero(at.w.size());
  each([&](const auto& c, Index i) {
    Vector3d u = contacts_->motion(c, reduced);
    u[0] += shift(u, c.friction);
    step.segment<3>(i) = u - at.z.template segment<3>(i);
  });
  return step;
}

bool JointSolution::adapt_penalty(Alternation& at, const VectorXd& last_motion, const VectorXd& lacking) {
  VectorXd moved = VectorXd::Zero(contacts_->size());
  each([&](const auto& c, Index i) {
    contacts_->apply(c, at.penalty * Vector3d(at.z.template segment<3>(i) - last_motion.segment<3>(i)), moved);
  });
  const double ratio = std::sqrt(lacking.norm() / std::max(moved.norm(), std::numeric_limits<double>::min()));
  if (ratio < penalty_imbalance && ratio > 1.0 / penalty_imbalance) return false;
  const double factor = std::clamp(ratio, 0.01, 100.0);
  each([&](const auto& c, Index i) {
    const Vector3d w = at.w.segment<3>(i), load = into_cone(-w, c.friction);
    at.w.segment<3>(i) = w + load - load / factor;
  });
  at.penalty *= factor;
  return true;
}

void JointSolution::alternate() {
  Alternation at;
  at.w.setZero(best_.size());
  at.z = at.load = at.w;
  each([&](const auto& c, Index i) {
    Vector3d u = contacts_->motion(c, contacts_->reduced());
    u[0] += shift(u, c.friction);
    at.w.segment<3>(i) = u + into_cone(-u, c.friction) - c.load / at.penalty;
  });
  if (!factorize(at.penalty)) return;
  Acceleration acceleration;
  VectorXd plain, last_motion = at.z, reduced;
  double last = infinity;
  for (int k = 0; k < max_alternations && result_->residual > target_residual(k); ++k) {
    ++result_->iterations;
    each([&](const auto& c, Index i) {
      at.load.segment<3>(i) = into_cone(-at.w.segment<3>(i), c.friction);
      at.z.segment<3>(i) = at.w.segment<3>(i) + at.load.segment<3>(i);
    });
    const VectorXd step = direction(at, reduced);
    const double size = step.norm();
    if (!(size < infinity)) return;
    if (size > divergence_ratio * last) {
      at.w = plain;
      acceleration.forget();
      last = infinity;
      continue;
    }
    last = size;
    plain = at.w + step;
    if (k % check_every == check_every - 1) {
      VectorXd loads = VectorXd::Zero(plain.size());
      each([&](const auto& c, Index i) {
        loads.segment<3>(i) = at.penalty * into_cone(-plain.segment<3>(i), c.friction);
      });
      offer(loads);
    }
    at.w.swap(plain);
    const bool adapts = k % penalty_every == penalty_every - 1;
    if (adapts && adapt_penalty(at, last_motion, step)) {
      if (!factorize(at.penalty)) return;
      acceleration.forget();
      last = infinity;
    } else {
      at.w.swap(plain);
      at.w = acceleration.next(at.w, step);
    }
    last_motion = at.z;
  }
}

// --- Newton's method on v = Jᵀ λ(v), where λ is by Coulomb's law of loads_ − penalty · u(v) [AC91].

VectorXd JointSolution::newton_residual(const VectorXd& reduced, VectorXd& loads, std::vector<Matrix3d>* slopes) const {
  VectorXd missing = reduced;
  each([&](const auto& c, Index i) {
    const Vector3d x = loads_.segment<3>(i) - penalty_ * contacts_->motion(c, reduced);
    Matrix3d* slope = slopes == nullptr ? nullptr : &(*slopes)[static_cast<std::size_t>(i / 3)];
    loads.segment<3>(i) = project_by_coulomb(x, c.friction, slope);
    contacts_->apply(c, -loads.segment<3>(i), missing);
    if (slope != nullptr) *slope *= penalty_;
  });
  return missing;
}

bool JointSolution::iterate_newton(VectorXd& reduced, VectorXd& loads) {
  std::vector<Matrix3d> slopes(active_.size(), Matrix3d::Zero());
  double smallest = infinity;
  for (int k = 0; k < max_newton_iterations; ++k) {
    const VectorXd rest = newton_residual(reduced, loads, &slopes);
    const double size = rest.norm();
    if (!(size < infinity)) return false;
    if (size <= 1e-13 * std::max(reduced.norm(), loads.norm())) return true;  // the rest is rounding
    const bool converges = size <= (1.0 - sufficient_decrease) * smallest;
    if (converges) {
      smallest = size;
      k = 0;
    }
    ++result_->factors;
    if (!factor_.factorize_nonsymmetric(*contacts_, slopes)) return false;
    const VectorXd step = factor_.solve_nonsymmetric(rest);
    VectorXd nearest = reduced - step;
    double min_size = newton_residual(nearest, loads, nullptr).norm(), share = 1.0;
    for (int half = 0; half < max_halvings && !(min_size <= (1.0 - sufficient_decrease * share) * size); ++half) {
      share *= 0.5;
      const VectorXd tried = reduced - share * step;
      const double size_tried = newton_residual(tried, loads, nullptr).norm();
      if (!(size_tried < min_size)) continue;
      min_size = size_tried;
      nearest = tried;
    }
    reduced = nearest;
  }
  newton_residual(reduced, loads, nullptr);
  return true;
}

void JointSolution::linearise() {
  loads_ = best_;
  penalty_ = initial_penalty;
  double smallest = result_->residual;
  int stalled = 0;
  for (int k = 0; k < max_rounds && stalled < max_stalled_rounds && smallest > enough_; ++k) {
    set_loads(loads_);
    VectorXd reduced = contacts_->reduced(), loads = VectorXd::Zero(loads_.size());
    if (!iterate_newton(reduced, loads)) return;
    const double residual = offer(loads);
    stalled = residual <= stalled_ratio * smallest ? 0 : stalled + 1;
    smallest = std::min(smallest, residual);
    if (residual <= 2.0 * smallest) {
      loads_ = loads;
      penalty_ = std::min(penalty_growth * penalty_, max_penalty);
    } else {
      penalty_ /= penalty_growth;
    }
  }
}

}  // namespace spring_workbench::friction
