#include "reduced_contacts.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "constants.h"

namespace spring_workbench::friction {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

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
  // Pivoted, so that what gives way little, or not at all, is found with full relative accuracy.
  const Eigen::LDLT<MatrixXd> ldlt(response);
  const VectorXd d = ldlt.vectorD().cwiseMax(0.0);
  Index size = 0;
  while (size < n && d[size] > 0.0) ++size;
  bodies_.push_back({size_, size, n, factors_.size()});
  size_ += size;
  MatrixXd factor = MatrixXd(ldlt.matrixL()).leftCols(size) * d.head(size).cwiseSqrt().asDiagonal();
  factor = ldlt.transpositionsP().transpose() * factor;
  factors_.insert(factors_.end(), factor.data(), factor.data() + factor.size());
  return bodies_.size() - 1;
}

std::size_t ReducedContacts::add_contact(double friction, const Vector3d& motion, const Vector3d& load) {
  contacts_.push_back(
      {parts_.size(), parts_.size(), friction, motion, load, 0.0, Matrix3d::Zero(), Matrix3d::Zero(), 0.0});
  return contacts_.size() - 1;
}

void ReducedContacts::add_part(std::size_t body, const Eigen::Ref<const Eigen::Matrix3Xd>& jacobian) {
  const Body& b = bodies_[body];
  if (b.size == 0) return;
  parts_.push_back({body, b.first, b.size, jacobians_.size()});
  contacts_.back().parts_end = parts_.size();
  jacobians_.resize(jacobians_.size() + static_cast<std::size_t>(3 * b.size));
  Eigen::Map<Eigen::Matrix3Xd>(jacobians_.data() + parts_.back().jacobian, 3, b.size).noalias() =
      jacobian.lazyProduct(Eigen::Map<const MatrixXd>(factors_.data() + b.factor, b.dofs, b.size));
}

Vector3d ReducedContacts::change(const Contact& contact, const VectorXd& reduced) const {
  Vector3d u = Vector3d::Zero();
  for (std::size_t p = contact.parts_begin; p < contact.parts_end; ++p) {
    const double* J = jacobians_.data() + parts_[p].jacobian;
    const double* v = reduced.data() + parts_[p].first;
    for (Index k = 0; k < parts_[p].size; ++k, J += 3) u += v[k] * Eigen::Map<const Vector3d>(J);
  }
  return u;
}

void ReducedContacts::apply(const Contact& contact, const Vector3d& load, VectorXd& reduced) const {
  for (std::size_t p = contact.parts_begin; p < contact.parts_end; ++p) {
    const double* J = jacobians_.data() + parts_[p].jacobian;
    double* v = reduced.data() + parts_[p].first;
    for (Index k = 0; k < parts_[p].size; ++k, J += 3) v[k] += load.dot(Eigen::Map<const Vector3d>(J));
  }
}

double ReducedContacts::prepare() {
  double largest = 0.0;
  reduced_.setZero(size_);
  VectorXd of_load = VectorXd::Zero(size_);
  for (Contact& c : contacts_) {
    for (Index k = 0; k < 3; ++k) {  // column by column, since two parts may be of one body
      apply(c, Vector3d::Unit(k), of_load);
      c.response.col(k) = change(c, of_load);
      for (std::size_t p = c.parts_begin; p < c.parts_end; ++p)
        of_load.segment(parts_[p].first, parts_[p].size).setZero();
    }
    const double trace = c.response.trace();
    const bool complies = trace > 0.0 && c.response(0, 0) > least_response * trace;
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
    c.inverse.setZero();
    const Eigen::LLT<Matrix3d> llt(c.response);
    if (llt.info() == Eigen::Success && llt.rcond() > least_response) c.inverse = llt.solve(Matrix3d::Identity());
    c.motion *= c.scale;
    c.load = into_cone(c.load / c.scale, c.friction);
    for (std::size_t p = c.parts_begin; p < c.parts_end; ++p)
      Eigen::Map<VectorXd>(jacobians_.data() + parts_[p].jacobian, 3 * parts_[p].size) *= c.scale;
    apply(c, c.load, reduced_);
  }
  return largest;
}

double ReducedContacts::relax(Contact& c) {
  Vector3d u = motion(c, reduced_);
  Vector3d shifted = u;
  shifted[0] += shift(u, c.friction);
  const double off = (c.load - into_cone(c.load - shifted, c.friction)).norm() / c.scale;
  Vector3d load = c.load - c.inverse * u;
  const bool sticks = c.inverse(0, 0) > 0.0 && load.tail<2>().norm() <= c.friction * load[0];
  if (!sticks) {
    load = c.load;
    load[0] = std::max(0.0, load[0] - u[0] / c.response(0, 0));
    if (c.friction > 0.0 && c.across > 0.0) {
      u += c.response.col(0) * (load[0] - c.load[0]);
      load.tail<2>() -= u.tail<2>() / c.across;
    } else {
      load.tail<2>().setZero();
    }
    const double most = c.friction * load[0], across = load.tail<2>().norm();
    if (across > most) load.tail<2>() *= most / across;
  }
  apply(c, load - c.load, reduced_);
  c.load = load;
  return off;
}

double ReducedContacts::iterate() {
  double worst = 0.0;
  for (auto c = contacts_.begin(); c != contacts_.end(); ++c)
    if (c->scale > 0.0) worst = std::max(worst, relax(*c));
  for (auto c = contacts_.rbegin(); c != contacts_.rend(); ++c)
    if (c->scale > 0.0) worst = std::max(worst, relax(*c));
  return worst;
}

double ReducedContacts::residual() const {
  double worst = 0.0;
  for (const Contact& c : contacts_) {
    if (!(c.scale > 0.0)) continue;
    Vector3d u = motion(c, reduced_);
    u[0] += shift(u, c.friction);
    const double off = (c.load - into_cone(c.load - u, c.friction)).norm() / c.scale;
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
