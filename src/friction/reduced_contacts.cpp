#include "reduced_contacts.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "constants.h"

namespace spring_workbench::friction {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

/// Calls `function` with a size, which is a constant for rigid bodies.
template <typename Function>
void with_size(Index size, const Function& function) {
  if (size == 6) {
    function(std::integral_constant<int, 6>());
  } else {
    function(std::integral_constant<int, Eigen::Dynamic>());
  }
}

}  // namespace

Vector3d into_cone(const Vector3d& x, double friction) {
  const double across = x.tail<2>().norm();
  if (friction * across <= -x[0]) return Vector3d::Zero();  // first: without friction both hold on the axis
  if (across <= friction * x[0]) return x;
  const double normal = (x[0] + friction * across) / (1.0 + friction * friction);
  if (friction == 0.0) return {normal, 0.0, 0.0};
  return {normal, friction * normal / across * x[1], friction * normal / across * x[2]};
}

void ReducedContacts::clear() {
  bodies_.clear();
  parts_.clear();
  contacts_.clear();
  factors_.clear();
  jacobians_.clear();
  size_ = 0;
}

std::size_t ReducedContacts::add_body(const Eigen::Ref<const MatrixXd>& response) {
  const Index n = response.rows();
  Body& body = bodies_.emplace_back(Body{size_, 0, n, factors_.size()});
  factors_.resize(body.factor + static_cast<std::size_t>(n * n));
  with_size(n, [&](auto size) {
    // Cholesky's factor, without the columns of what does not respond: what is left of it is rounding.
    using Square = Eigen::Matrix<double, size(), size()>;
    Eigen::Map<Square> factor(&factors_[body.factor], n, n);
    Square left = response;
    for (Index k = 0; k < n; ++k) {
      const double pivot = left(k, k);
      if (!(pivot > static_cast<double>(n) * std::numeric_limits<double>::epsilon() * response(k, k))) continue;
      auto column = factor.col(body.size++);
      column.setZero();
      column.tail(n - k) = left.col(k).tail(n - k) / std::sqrt(pivot);
      for (Index i = k + 1; i < n; ++i) left.col(i).tail(n - i) -= column[i] * column.tail(n - i);
    }
  });
  size_ += body.size;
  return bodies_.size() - 1;
}

std::size_t ReducedContacts::add_contact(double friction, const Vector3d& motion, const Vector3d& load) {
  contacts_.push_back(
      {parts_.size(), parts_.size(), friction, motion, load, 0.0, Matrix3d::Zero(), Matrix3d::Zero(), 0.0, false});
  return contacts_.size() - 1;
}

void ReducedContacts::add_part(std::size_t body, const Eigen::Ref<const Eigen::Matrix3Xd>& jacobian) {
  const Body& b = bodies_[body];
  if (b.size == 0) return;
  Contact& contact = contacts_.back();
  auto part = std::find_if(parts_.begin() + static_cast<std::ptrdiff_t>(contact.parts_begin), parts_.end(),
                           [&](const Part& p) { return p.body == body; });
  if (part == parts_.end()) {
    part = parts_.insert(part, {body, b.first, b.size, jacobians_.size()});
    contact.parts_end = parts_.size();
    jacobians_.resize(jacobians_.size() + static_cast<std::size_t>(3 * b.size));
  }
  const double* const factor = factors_.data() + b.factor;
  double* const J = jacobians_.data() + part->jacobian;
  if (b.dofs == 6 && b.size == 6) {
    const Eigen::Matrix<double, 3, 6> own = jacobian;
    Eigen::Map<Eigen::Matrix<double, 3, 6>>(J) +=
        own.lazyProduct(Eigen::Map<const Eigen::Matrix<double, 6, 6>>(factor));
  } else {
    Eigen::Map<Eigen::Matrix3Xd>(J, 3, b.size) +=
        jacobian.lazyProduct(Eigen::Map<const MatrixXd>(factor, b.dofs, b.size));
  }
}

Vector3d ReducedContacts::change(const Contact& contact, const VectorXd& reduced) const {
  Vector3d u = Vector3d::Zero();
  for (std::size_t p = contact.parts_begin; p < contact.parts_end; ++p) {
    with_size(parts_[p].size, [&](auto size) {
      const Eigen::Map<const Eigen::Matrix<double, 3, size()>> J(jacobians_.data() + parts_[p].jacobian, 3,
                                                                 parts_[p].size);
      u += J.lazyProduct(
          Eigen::Map<const Eigen::Matrix<double, size(), 1>>(reduced.data() + parts_[p].first, parts_[p].size));
    });
  }
  return u;
}

void ReducedContacts::apply(const Contact& contact, const Vector3d& load, VectorXd& reduced) const {
  for (std::size_t p = contact.parts_begin; p < contact.parts_end; ++p) {
    with_size(parts_[p].size, [&](auto size) {
      const Eigen::Map<const Eigen::Matrix<double, 3, size()>> J(jacobians_.data() + parts_[p].jacobian, 3,
                                                                 parts_[p].size);
      Eigen::Map<Eigen::Matrix<double, size(), 1>>(reduced.data() + parts_[p].first, parts_[p].size) +=
          J.transpose().lazyProduct(load);
    });
  }
}

double ReducedContacts::prepare() {
  double largest = 0.0;
  reduced_.setZero(size_);
  for (Contact& c : contacts_) {
    for (std::size_t p = c.parts_begin; p < c.parts_end; ++p) {
      with_size(parts_[p].size, [&](auto size) {
        const Eigen::Map<const Eigen::Matrix<double, 3, size()>> J(jacobians_.data() + parts_[p].jacobian, 3,
                                                                   parts_[p].size);
        c.response += J.lazyProduct(J.transpose());
      });
    }
    const double trace = c.response.trace();
    const bool complies = trace > 0.0 && c.response(0, 0) > min_response * trace;
    c.scale = complies ? std::sqrt(3.0 / trace) : 0.0;
    if (!complies) {
      c.load.setZero();
      continue;
    }
    const double motion_without_load = c.motion.norm();
    if (!(motion_without_load <= largest)) largest = motion_without_load;
    c.response *= c.scale * c.scale;
    const double mean = 0.5 * (c.response(1, 1) + c.response(2, 2));
    c.across = mean + std::hypot(0.5 * (c.response(1, 1) - c.response(2, 2)), c.response(1, 2));
    double determinant = 0.0;
    bool is_regular = false;
    c.response.computeInverseAndDetWithCheck(c.inverse, determinant, is_regular, min_response);
    if (!is_regular) c.inverse.setZero();
    c.motion *= c.scale;
    c.load = into_cone(c.load / c.scale, c.friction);
    for (std::size_t p = c.parts_begin; p < c.parts_end; ++p)
      Eigen::Map<VectorXd>(jacobians_.data() + parts_[p].jacobian, 3 * parts_[p].size) *= c.scale;
    apply(c, c.load, reduced_);
  }
  return largest;
}

double residual_at(const ReducedContacts::Contact& c, Vector3d u) {
  u[0] += shift(u, c.friction);
  return (c.load - into_cone(c.load - u, c.friction)).norm() / c.scale;
}

void ReducedContacts::relax(Contact& c, Vector3d u) {
  Vector3d load = c.load - c.inverse * u;
  const bool sticks = c.inverse(0, 0) > 0.0 && load[0] > 0.0 && load.tail<2>().norm() <= c.friction * load[0];
  if (!sticks) {
    load = c.load;
    load[0] = std::max(0.0, load[0] - u[0] / c.response(0, 0));
    if (c.friction > 0.0 && c.across > 0.0) {
      u += c.response.col(0) * (load[0] - c.load[0]);
      load.tail<2>() -= u.tail<2>() / c.across;
    } else {
      load.tail<2>().setZero();
    }
    const double max_across = c.friction * load[0], across = load.tail<2>().norm();
    if (across > max_across) load.tail<2>() *= max_across / across;
  }
  apply(c, load - c.load, reduced_);
  c.load = load;
}

double ReducedContacts::iterate() {
  double worst = 0.0;
  for (Contact& c : contacts_) {
    if (!(c.scale > 0.0)) continue;
    const Vector3d u = motion(c, reduced_);
    c.open = is_open(c, u);
    if (c.open) continue;
    worst = std::max(worst, residual_at(c, u));
    relax(c, u);
  }
  // And back; the last and the first have just been, or will be, relaxed.
  for (std::size_t i = contacts_.size(); i-- > 2;) {
    Contact& c = contacts_[i - 1];
    if (c.scale > 0.0 && !c.open) relax(c, motion(c, reduced_));
  }
  return worst;
}

double ReducedContacts::residual() const {
  double worst = 0.0;
  for (const Contact& c : contacts_) {
    if (!(c.scale > 0.0)) continue;
    const double off = residual_at(c, motion(c, reduced_));
    if (!(off <= worst)) worst = off;  // one that is no number, too
  }
  return worst;
}

void ReducedContacts::set_loads(const VectorXd& loads) {
  reduced_.setZero();
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    if (!(contacts_[i].scale > 0.0)) continue;
    contacts_[i].load = loads.segment<3>(3 * static_cast<Index>(i));
    apply(contacts_[i], contacts_[i].load, reduced_);
  }
}

VectorXd ReducedContacts::loads() const {
  VectorXd loads(3 * static_cast<Index>(contacts_.size()));
  for (std::size_t i = 0; i < contacts_.size(); ++i) loads.segment<3>(3 * static_cast<Index>(i)) = contacts_[i].load;
  return loads;
}

VectorXd ReducedContacts::change(std::size_t body) const {
  const Body& b = bodies_[body];
  return Eigen::Map<const MatrixXd>(factors_.data() + b.factor, b.dofs, b.size) * reduced_.segment(b.first, b.size);
}

}  // namespace spring_workbench::friction
