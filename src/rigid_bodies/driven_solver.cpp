#include "driven_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "constants.h"
#include "spring_workbench/math/friction_cones.h"
#include "spring_workbench/scene/constants.h"

namespace spring_workbench::rigid_bodies {
namespace {

/// [linear; angular].
Eigen::Matrix<double, 6, 1> both(const btVector3& linear, const btVector3& angular) {
  Eigen::Matrix<double, 6, 1> v;
  v << from_bullet(linear), from_bullet(angular);
  return v;
}

}  // namespace

void DrivenSolver::set_driven(std::vector<Driven> driven, double h) {
  driven_ = std::move(driven);
  impacts_.clear();
  missed_way_ = 0.0;
  h_ = h;
}

double DrivenSolver::Row::rate(const std::vector<Vector6d>& change) const {
  return J_a.dot(change[static_cast<std::size_t>(a)]) + J_b.dot(change[static_cast<std::size_t>(b)]);
}

void DrivenSolver::Row::apply(double more, std::vector<Vector6d>& change) {
  impulse += more;
  change[static_cast<std::size_t>(a)] += more * answer_a;
  change[static_cast<std::size_t>(b)] += more * answer_b;
}

const DrivenSolver::Driven* DrivenSolver::driven_of(int solver_body) const {
  const btRigidBody* bullet = m_tmpSolverBodyPool[solver_body].m_originalBody;
  const auto found = std::find_if(driven_.begin(), driven_.end(), [&](const Driven& d) { return d.bullet == bullet; });
  return bullet == nullptr || found == driven_.end() ? nullptr : &*found;
}

Vector6d DrivenSolver::response(int solver_body, const Vector6d& J, const Vector6d& as_free) const {
  // An impulse p spread over the step is a wrench p / h, which moves the body on by compliance · p / h in h.
  if (const Driven* driven = driven_of(solver_body)) return driven->body->compliance * J / (h_ * h_);
  return as_free;
}

DrivenSolver::Row DrivenSolver::make_row(btSolverConstraint& c) const {
  Row row;
  row.a = c.m_solverBodyIdA;
  row.b = c.m_solverBodyIdB;
  row.J_a = both(c.m_contactNormal1, c.m_relpos1CrossNormal);
  row.J_b = both(c.m_contactNormal2, c.m_relpos2CrossNormal);
  const btSolverBody& a = m_tmpSolverBodyPool[row.a];
  const btSolverBody& b = m_tmpSolverBodyPool[row.b];
  row.answer_a = response(row.a, row.J_a, both(c.m_contactNormal1 * a.internalGetInvMass(), c.m_angularComponentA));
  row.answer_b = response(row.b, row.J_b, both(c.m_contactNormal2 * b.internalGetInvMass(), c.m_angularComponentB));
  const double give = row.J_a.dot(row.answer_a) + row.J_b.dot(row.answer_b);
  row.inverse_effective_mass = give > 0.0 ? give : 0.0;
  row.target = c.m_jacDiagABInv > 0.0 ? c.m_rhs / c.m_jacDiagABInv : 0.0;
  return row;
}

DrivenSolver::Change DrivenSolver::iteration(Rows& rows) const {
  Change largest;
  const auto step_of = [&](const Row& row) {
    return row.inverse_effective_mass > 0.0 ? (row.target - row.rate(rows.change)) / row.inverse_effective_mass : 0.0;
  };
  const std::size_t count = rows.normal.size();
  for (std::size_t step = 0; step < 2 * count; ++step) {  // there and back: so the sweep is a symmetric operation
    const std::size_t i = step < count ? step : 2 * count - 1 - step;
    Row& n = rows.normal[i];
    const double pressed = std::max(0.0, n.impulse + step_of(n)) - n.impulse;
    n.apply(pressed, rows.change);
    Row& u = rows.across[2 * i];
    Row& v = rows.across[2 * i + 1];
    Eigen::Vector2d wanted(u.impulse + step_of(u), v.impulse + step_of(v));
    const double most = n.friction * n.impulse;
    const double size = wanted.norm();
    if (size > most) wanted *= most / size;
    const Eigen::Vector2d slid(wanted[0] - u.impulse, wanted[1] - v.impulse);
    u.apply(slid[0], rows.change);
    v.apply(slid[1], rows.change);
    largest.impulse = std::max({largest.impulse, std::abs(pressed), slid.norm()});
    largest.path = std::max({largest.path, h_ * std::abs(pressed) * n.inverse_effective_mass,
                             h_ * std::abs(slid[0]) * u.inverse_effective_mass,
                             h_ * std::abs(slid[1]) * v.inverse_effective_mass});
  }
  return largest;
}

bool DrivenSolver::iterate_until_done(Rows& rows) const {
  // Nonsmooth nonlinear conjugate gradients (Silcowitz, Niebe and Erleben 2010): a sweep's change is the gradient.
  const std::size_t count = 3 * rows.normal.size();
  const auto size = static_cast<Eigen::Index>(count);
  Eigen::VectorXd before(size), change(size), direction = Eigen::VectorXd::Zero(size);
  double last_square = 0.0;
  for (int i = 0; i < most_iterations; ++i) {
    for (std::size_t k = 0; k < count; ++k) before[static_cast<Eigen::Index>(k)] = rows[k].impulse;
    const Change of_sweep = iteration(rows);
    double largest = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
      change[static_cast<Eigen::Index>(k)] = rows[k].impulse - before[static_cast<Eigen::Index>(k)];
      largest = std::max(largest, rows[k].impulse);
    }
    if (of_sweep.impulse <= small_change * largest) return true;
    if (i >= enough_sweeps && of_sweep.path <= small_displacement && missed(rows) <= small_displacement) return true;
    const double square = change.squaredNorm();
    if (last_square > 0.0 && square <= last_square && i + 1 < most_iterations) {
      const double share = square / last_square;
      for (std::size_t k = 0; k < count; ++k)
        rows[k].apply(share * direction[static_cast<Eigen::Index>(k)], rows.change);
      direction = change + share * direction;
    } else {
      direction = change;
    }
    last_square = square;
  }
  return false;
}

void DrivenSolver::solve_at_once(Rows& rows) const {
  std::vector<std::size_t> giving;  // rows of the contacts that give way, three for each
  std::vector<double> friction;
  for (std::size_t i = 0; i < rows.normal.size(); ++i) {
    if (!(rows.normal[i].inverse_effective_mass > 0.0)) continue;
    for (const std::size_t k : {i, rows.normal.size() + 2 * i, rows.normal.size() + 2 * i + 1}) giving.push_back(k);
    friction.push_back(rows.normal[i].friction);
  }
  const auto size = static_cast<Eigen::Index>(giving.size());
  Eigen::MatrixXd A(size, size);
  Eigen::VectorXd b(size), impulse;
  std::vector<Vector6d> alone(rows.change.size(), Vector6d::Zero());
  for (Eigen::Index j = 0; j < size; ++j) {
    const Row& row = rows[giving[static_cast<std::size_t>(j)]];
    b[j] = -row.target;
    Row unit = row;
    unit.apply(1.0, alone);
    for (Eigen::Index i = 0; i < size; ++i) A(i, j) = rows[giving[static_cast<std::size_t>(i)]].rate(alone);
    alone[static_cast<std::size_t>(row.a)].setZero();
    alone[static_cast<std::size_t>(row.b)].setZero();
  }
  if (!math::solve_in_cones(A, b, friction, impulse)) return;
  Rows found = rows;
  found.clear();
  for (Eigen::Index i = 0; i < size; ++i) found[giving[static_cast<std::size_t>(i)]].apply(impulse[i], found.change);
  iteration(found);
  if (missed(found) < missed(rows)) rows = std::move(found);
}

double DrivenSolver::missed(const Rows& rows) const {
  double missed = 0.0;
  for (const Row& n : rows.normal) {
    if (!(n.inverse_effective_mass > 0.0)) continue;
    const double missing = n.target - n.rate(rows.change);
    missed = std::max(missed, h_ * (n.impulse > 0.0 ? std::abs(missing) : missing));
  }
  const auto finite = [](const Vector6d& v) { return v.allFinite(); };
  return std::all_of(rows.change.begin(), rows.change.end(), finite) ? missed : std::numeric_limits<double>::infinity();
}

void DrivenSolver::solve(Rows& rows) {
  if (!iterate_until_done(rows) && missed(rows) > small_miss && rows.normal.size() <= most_at_once) solve_at_once(rows);
  const double missed_now = missed(rows);
  if (!std::isfinite(missed_now)) rows.clear();
  missed_way_ = std::max(missed_way_, missed_now);
}

void DrivenSolver::Rows::clear() {
  for (std::size_t k = 0; k < 3 * normal.size(); ++k) (*this)[k].impulse = 0.0;
  std::fill(change.begin(), change.end(), Vector6d::Zero());
}

Vector6d DrivenSolver::velocity(int solver_body, bool at_start) const {
  const btSolverBody& body = m_tmpSolverBodyPool[solver_body];
  if (at_start) {
    if (const Driven* driven = driven_of(solver_body)) return to_vector(driven->body->V_WO_W);
    return both(body.m_linearVelocity, body.m_angularVelocity);
  }
  return both(body.m_linearVelocity + body.m_externalForceImpulse,
              body.m_angularVelocity + body.m_externalTorqueImpulse);
}

double DrivenSolver::rate(const Row& row, bool at_start) const {
  return row.J_a.dot(velocity(row.a, at_start)) + row.J_b.dot(velocity(row.b, at_start));
}

DrivenSolver::Rows DrivenSolver::make_rows(const btContactSolverInfo& info) {
  Rows rows;
  rows.change.assign(static_cast<std::size_t>(m_tmpSolverBodyPool.size()), Vector6d::Zero());
  for (int i = 0; i < m_tmpSolverContactConstraintPool.size(); ++i) {
    btSolverConstraint& contact = m_tmpSolverContactConstraintPool[i];
    const auto& point = *static_cast<const btManifoldPoint*>(contact.m_originalContactPoint);
    Row n = make_row(contact);
    n.friction = contact.m_friction;
    n.gap = point.getDistance() + info.m_linearSlop;
    const double way_left = n.gap / h_, restitution = point.m_combinedRestitution;
    if (drives(n)) {
      // A driven body's velocity is its way over the step. A penetration is undone slowly, or it would become a speed.
      const bool pushes = !(driven_of(n.a) || n.answer_a.isZero(0.0)) || !(driven_of(n.b) || n.answer_b.isZero(0.0));
      const double undone = (pushes ? info.m_erp2 : 1.0) * std::min(1.0, h_ / recovery_time);
      n.target = -rate(n, false) - (n.gap < 0.0 ? undone : 1.0) * way_left;
    } else if (n.gap < -blind_way_of_free) {
      // Deeper than a way leads, between triangles that push to both sides: bounces off both have no end.
      n.target = -rate(n, false);
    } else if (way_left > 0.0 && restitution > 0.0) {
      // Bullet lets a body bounce before it is there, and then loses the bounce on the rest of the way.
      const double approach = (n.target + way_left) / (1.0 + restitution);
      n.target = approach > way_left ? n.target + way_left : approach - way_left;
    }
    rows.normal.push_back(n);
    rows.normal.back().apply(point.m_appliedImpulse, rows.change);  // from the last step's impulses on
    const double before[2] = {point.m_appliedImpulseLateral1, point.m_appliedImpulseLateral2};
    for (int k = 0; k < 2; ++k) {
      rows.across.push_back(make_row(m_tmpSolverContactFrictionConstraintPool[contact.m_frictionIndex + k]));
      rows.across.back().apply(before[k], rows.change);
    }
  }
  return rows;
}

DrivenSolver::Row DrivenSolver::impact_row(const Row& row) const {
  Row impact = row;
  if (const Driven* driven = driven_of(row.a)) impact.answer_a = driven->body->mobility * row.J_a;
  if (const Driven* driven = driven_of(row.b)) impact.answer_b = driven->body->mobility * row.J_b;
  impact.inverse_effective_mass = std::max(0.0, row.J_a.dot(impact.answer_a) + row.J_b.dot(impact.answer_b));
  impact.target = -rate(row, true);
  impact.impulse = 0.0;
  return impact;
}

void DrivenSolver::stop_approaches(Rows& rows) {
  Rows closing;
  closing.change.assign(rows.change.size(), Vector6d::Zero());
  std::vector<std::size_t> contacts;  // of those in `rows`
  bool approach = false;
  for (std::size_t i = 0; i < rows.normal.size(); ++i) {
    if (rows.normal[i].gap > closed) continue;
    Row n = impact_row(rows.normal[i]);
    approach = approach || (drives(n) && n.target > slow);
    const auto& contact = m_tmpSolverContactConstraintPool[static_cast<int>(i)];
    const auto& point = *static_cast<const btManifoldPoint*>(contact.m_originalContactPoint);
    if (n.target > scene::rest_speed) n.target *= 1.0 + point.m_combinedRestitution;
    closing.normal.push_back(n);
    for (std::size_t k = 0; k < 2; ++k) closing.across.push_back(impact_row(rows.across[2 * i + k]));
    contacts.push_back(i);
  }
  if (!approach) return;
  solve(closing);
  for (std::size_t i = 0; i < rows.change.size(); ++i) {
    if (driven_of(static_cast<int>(i)) == nullptr) rows.change[i] += closing.change[i];
  }
  hand_back_impacts(closing, contacts);
  for (std::size_t i = 0; i < rows.change.size(); ++i) {
    const Driven* driven = driven_of(static_cast<int>(i));
    if (driven == nullptr) continue;
    rows.change[i] += driven->body->displacement_by_impulse * to_vector(driven->body->impact_W) / h_;
  }
}

void DrivenSolver::load_driven(const Row& row, double amount, Wrench DrivenBody::*load) const {
  for (const auto& [body, J] : {std::pair(row.a, &row.J_a), std::pair(row.b, &row.J_b)}) {
    if (const Driven* driven = driven_of(body)) driven->body->*load += to_wrench(amount * *J);
  }
}

void DrivenSolver::hand_back_impacts(const Rows& rows, const std::vector<std::size_t>& contacts) {
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const auto& contact = m_tmpSolverContactConstraintPool[static_cast<int>(contacts[i])];
    Impact impact{static_cast<const btManifoldPoint*>(contact.m_originalContactPoint), Vector3d::Zero()};
    for (const Row* row : {&rows.normal[i], &rows.across[2 * i], &rows.across[2 * i + 1]}) {
      impact.impulse_W += row->impulse * row->J_a.head<3>();
      load_driven(*row, row->impulse, &DrivenBody::impact_W);
    }
    impacts_.push_back(impact);
  }
}

void DrivenSolver::hand_back(const Rows& rows) {
  for (int i = 0; i < m_tmpSolverBodyPool.size(); ++i) {
    btSolverBody& body = m_tmpSolverBodyPool[i];
    const Vector6d& c = rows.change[static_cast<std::size_t>(i)];
    body.internalGetDeltaLinearVelocity() = to_bullet(Vector3d(c.head<3>()));
    body.internalGetDeltaAngularVelocity() = to_bullet(Vector3d(c.tail<3>()));
  }
  for (std::size_t i = 0; i < rows.normal.size(); ++i) {
    auto& point =
        *static_cast<btManifoldPoint*>(m_tmpSolverContactConstraintPool[static_cast<int>(i)].m_originalContactPoint);
    point.m_appliedImpulse = rows.normal[i].impulse;
    point.m_appliedImpulseLateral1 = rows.across[2 * i].impulse;
    point.m_appliedImpulseLateral2 = rows.across[2 * i + 1].impulse;
    for (const Row* row : {&rows.normal[i], &rows.across[2 * i], &rows.across[2 * i + 1]}) {
      load_driven(*row, row->impulse / h_, &DrivenBody::contact_W);
    }
  }
}

btScalar DrivenSolver::solveGroupCacheFriendlyIterations(btCollisionObject** bodies, int body_count,
                                                         btPersistentManifold** manifolds, int manifold_count,
                                                         btTypedConstraint** constraints, int constraint_count,
                                                         const btContactSolverInfo& info, btIDebugDraw* debug) {
  solveGroupCacheFriendlySplitImpulseIterations(bodies, body_count, manifolds, manifold_count, constraints,
                                                constraint_count, info, debug);
  Rows rows = make_rows(info);
  if (!driven_.empty()) stop_approaches(rows);
  solve(rows);
  hand_back(rows);
  return 0.0;
}

}  // namespace spring_workbench::rigid_bodies
