#include "driven_solver.h"

#include <algorithm>
#include <cmath>

namespace spring_workbench {
namespace {

constexpr int most_sweeps = 1000;
constexpr double small_change = 1e-8;  ///< of the largest impulse: the sweeps end

/// [linear; angular].
Eigen::Matrix<double, 6, 1> both(const btVector3& linear, const btVector3& angular) {
  Eigen::Matrix<double, 6, 1> v;
  v << from_bullet(linear), from_bullet(angular);
  return v;
}

}  // namespace

void DrivenSolver::set_driven(std::vector<Driven> driven, double h) {
  driven_ = std::move(driven);
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

DrivenSolver::Vector6d DrivenSolver::answer(int solver_body, const Vector6d& J, const Vector6d& as_free) const {
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
  row.answer_a = answer(row.a, row.J_a, both(c.m_contactNormal1 * a.internalGetInvMass(), c.m_angularComponentA));
  row.answer_b = answer(row.b, row.J_b, both(c.m_contactNormal2 * b.internalGetInvMass(), c.m_angularComponentB));
  const double give = row.J_a.dot(row.answer_a) + row.J_b.dot(row.answer_b);
  row.inverse_effective_mass = give > 0.0 ? give : 0.0;
  row.target = c.m_jacDiagABInv > 0.0 ? c.m_rhs / c.m_jacDiagABInv : 0.0;
  return row;
}

double DrivenSolver::sweep(Rows& rows) const {
  double largest_step = 0.0;
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
    const double most = m_tmpSolverContactConstraintPool[static_cast<int>(i)].m_friction * n.impulse;
    const double size = wanted.norm();
    if (size > most) wanted *= most / size;
    const Eigen::Vector2d slid(wanted[0] - u.impulse, wanted[1] - v.impulse);
    u.apply(slid[0], rows.change);
    v.apply(slid[1], rows.change);
    largest_step = std::max({largest_step, std::abs(pressed), slid.norm()});
  }
  return largest_step;
}

void DrivenSolver::solve(Rows& rows) const {
  // Nonsmooth nonlinear conjugate gradients (Silcowitz, Niebe and Erleben 2010): a sweep's change is the gradient.
  const std::size_t contacts = rows.normal.size();
  const auto size = static_cast<Eigen::Index>(3 * contacts);
  const auto row = [&](std::size_t k) -> Row& { return k < contacts ? rows.normal[k] : rows.across[k - contacts]; };
  Eigen::VectorXd before(size), change(size), direction = Eigen::VectorXd::Zero(size);
  double last_square = 0.0;
  for (int i = 0; i < most_sweeps; ++i) {
    for (std::size_t k = 0; k < 3 * contacts; ++k) before[static_cast<Eigen::Index>(k)] = row(k).impulse;
    const double largest_step = sweep(rows);
    double largest = 0.0;
    for (std::size_t k = 0; k < 3 * contacts; ++k) {
      change[static_cast<Eigen::Index>(k)] = row(k).impulse - before[static_cast<Eigen::Index>(k)];
      largest = std::max(largest, row(k).impulse);
    }
    if (largest_step <= small_change * largest) break;
    const double square = change.squaredNorm();
    if (last_square > 0.0 && square <= last_square && i + 1 < most_sweeps) {
      const double share = square / last_square;
      for (std::size_t k = 0; k < 3 * contacts; ++k) row(k).apply(share * direction[static_cast<Eigen::Index>(k)], rows.change);
      direction = change + share * direction;
    } else {
      direction = change;
    }
    last_square = square;
  }
}

DrivenSolver::Rows DrivenSolver::make_rows(const btContactSolverInfo& info) {
  Rows rows;
  rows.change.assign(static_cast<std::size_t>(m_tmpSolverBodyPool.size()), Vector6d::Zero());
  for (int i = 0; i < m_tmpSolverContactConstraintPool.size(); ++i) {
    btSolverConstraint& contact = m_tmpSolverContactConstraintPool[i];
    const auto& point = *static_cast<const btManifoldPoint*>(contact.m_originalContactPoint);
    Row n = make_row(contact);
    // A driven body's velocity is its way over the step: its penetration is undone within it, unless that pushes a free one.
    const double penetration = -(point.getDistance() + info.m_linearSlop);
    const bool a_driven = driven_of(n.a) != nullptr, b_driven = driven_of(n.b) != nullptr;
    if (penetration > 0.0 && (a_driven || b_driven)) {
      const bool pushes = !(a_driven || n.answer_a.isZero(0.0)) || !(b_driven || n.answer_b.isZero(0.0));
      n.target += (pushes ? info.m_erp2 : 1.0) * penetration / h_;
    }
    // Bullet lets a body bounce before it is there, and then loses the bounce on the rest of the way.
    const double way_left = -penetration / h_, restitution = point.m_combinedRestitution;
    if (way_left > 0.0 && restitution > 0.0) {
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

void DrivenSolver::hand_back(const Rows& rows) {
  for (int i = 0; i < m_tmpSolverBodyPool.size(); ++i) {
    btSolverBody& body = m_tmpSolverBodyPool[i];
    const Vector6d& c = rows.change[static_cast<std::size_t>(i)];
    body.internalGetDeltaLinearVelocity() = to_bullet(Vector3d(c.head<3>()));
    body.internalGetDeltaAngularVelocity() = to_bullet(Vector3d(c.tail<3>()));
  }
  const auto load_driven = [&](const Row& row) {
    for (const auto& [body, J] : {std::pair(row.a, &row.J_a), std::pair(row.b, &row.J_b)}) {
      if (const Driven* driven = driven_of(body)) {
        driven->body->contact_W.force += row.impulse / h_ * J->head<3>();
        driven->body->contact_W.moment += row.impulse / h_ * J->tail<3>();
      }
    }
  };
  for (std::size_t i = 0; i < rows.normal.size(); ++i) {
    auto& point = *static_cast<btManifoldPoint*>(m_tmpSolverContactConstraintPool[static_cast<int>(i)].m_originalContactPoint);
    point.m_appliedImpulse = rows.normal[i].impulse;
    point.m_appliedImpulseLateral1 = rows.across[2 * i].impulse;
    point.m_appliedImpulseLateral2 = rows.across[2 * i + 1].impulse;
    load_driven(rows.normal[i]);
    load_driven(rows.across[2 * i]);
    load_driven(rows.across[2 * i + 1]);
  }
}

btScalar DrivenSolver::solveGroupCacheFriendlyIterations(btCollisionObject** bodies, int body_count,
                                                         btPersistentManifold** manifolds, int manifold_count,
                                                         btTypedConstraint** constraints, int constraint_count,
                                                         const btContactSolverInfo& info, btIDebugDraw* debug) {
  solveGroupCacheFriendlySplitImpulseIterations(bodies, body_count, manifolds, manifold_count, constraints,
                                                constraint_count, info, debug);
  Rows rows = make_rows(info);
  solve(rows);
  hand_back(rows);
  return 0.0;
}

}  // namespace spring_workbench
