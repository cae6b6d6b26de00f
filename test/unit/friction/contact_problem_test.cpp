#include "spring_workbench/friction/contact_problem.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

namespace spring_workbench::friction {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Jacobian = Eigen::Matrix<double, 3, 6>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

constexpr double h = 2e-3, gravity = 9.81, edge = 0.04;
constexpr std::size_t nothing = static_cast<std::size_t>(-1);  // a fixed body

/// Cubes and the contacts between them over a step of `h`; motions are displacements, loads are forces.
struct Boxes {
  struct Box {
    Vector3d p_W;
    Matrix6d response;
    Vector6d motion;  ///< without loads
  };
  struct Contact {
    std::size_t upper, lower;
    double friction;
    Jacobian J_upper, J_lower;
    Vector3d motion;
  };
  std::vector<Box> boxes;
  std::vector<Contact> contacts;
  std::mt19937 random;

  double either(double size) { return std::uniform_real_distribution<double>(-size, size)(random); }

  void add_box(const Vector3d& p_W, double mass) {
    Matrix6d response = Matrix6d::Zero();
    response.diagonal() << Vector3d::Constant(h * h / mass), Vector3d::Constant(h * h / (mass * edge * edge / 6.0));
    boxes.push_back({p_W, response, -gravity * h * h * Vector6d::Unit(2)});
  }
  /// Holds the last box by springs of `stiffness` [N/m], which would move it by `motion`.
  void hold(double stiffness, const Vector6d& motion) {
    Matrix6d K = stiffness * Matrix6d::Identity();
    K.bottomRightCorner<3, 3>() *= 0.01;
    boxes.back().response = Matrix6d(boxes.back().response.inverse() + K).inverse();
    boxes.back().motion = motion;
  }
  /// Four points, up to 0.1 mm and in their gaps up to 0.1 µm off, on the face of `upper` towards `lower`.
  void add_face(std::size_t upper, std::size_t lower, const Vector3d& n_W, double friction) {
    const Vector3d across = n_W.unitOrthogonal(), further = n_W.cross(across);
    Matrix3d R;
    R << n_W.transpose(), across.transpose(), further.transpose();
    for (const auto& [a, b] : {std::pair(1, 1), {1, -1}, {-1, 1}, {-1, -1}}) {
      const Vector3d p_W = boxes[upper].p_W - 0.5 * edge * n_W + (0.5 * edge * a + either(1e-4)) * across +
                           (0.5 * edge * b + either(1e-4)) * further;
      const auto jacobian = [&](std::size_t box) {
        const Vector3d l = p_W - boxes[box].p_W;
        Matrix3d cross;
        cross << 0.0, -l.z(), l.y(), l.z(), 0.0, -l.x(), -l.y(), l.x(), 0.0;
        return (Jacobian() << R, -R * cross).finished();
      };
      Contact c{upper, lower, friction, jacobian(upper), Jacobian::Zero(), either(1e-7) * Vector3d::UnitX()};
      c.motion += c.J_upper * boxes[upper].motion;
      if (lower != nothing) {
        c.J_lower = -jacobian(lower);
        c.motion += c.J_lower * boxes[lower].motion;
      }
      contacts.push_back(c);
    }
  }
  void fill(ContactProblem& problem) const {
    problem.clear();
    for (const Box& box : boxes) problem.add_body(box.response);
    for (const Contact& c : contacts) {
      problem.add_contact(c.friction, c.motion, Vector3d::Zero());
      problem.add_part(c.upper, c.J_upper);
      if (c.lower != nothing) problem.add_part(c.lower, c.J_lower);
    }
  }
  /// Largest distance from Coulomb's law [m], each load taken by the response of its contact alone.
  double violation(const ContactProblem& problem) const {
    double worst = 0.0;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const Contact& c = contacts[i];
      Vector3d u = c.motion + c.J_upper * problem.change(c.upper);
      double response = (c.J_upper * boxes[c.upper].response * c.J_upper.transpose()).trace() / 3.0;
      if (c.lower != nothing) {
        u += c.J_lower * problem.change(c.lower);
        response += (c.J_lower * boxes[c.lower].response * c.J_lower.transpose()).trace() / 3.0;
      }
      const Vector3d load = response * problem.load(i);
      const double slip = u.tail<2>().norm(), held = load.tail<2>().norm(), most = c.friction * load[0];
      const Eigen::Vector2d against = held > 0.0 ? Eigen::Vector2d(load.tail<2>() / held) : Eigen::Vector2d::Zero();
      const double along = u.tail<2>().dot(against);
      worst = std::max({worst, -load[0], held - most, -u[0], std::min(load[0], u[0]), std::min(slip, most - held),
                        std::min(most, std::max(along, (u.tail<2>() - along * against).norm()))});
    }
    return worst;
  }
};

Boxes stack(std::size_t count, double top_mass, unsigned seed, double friction = 0.5) {
  Boxes s;
  s.random.seed(seed);
  for (std::size_t i = 0; i < count; ++i) {
    s.add_box({0.0, 0.0, edge * (static_cast<double>(i) + 0.5)}, i + 1 == count ? top_mass : 1.0);
    s.add_face(i, i == 0 ? nothing : i - 1, Vector3d::UnitZ(), friction);
  }
  return s;
}

TEST(ContactProblem, KeepsCoulombsLawHoweverUnlikeTheMassesAre) {
  ContactProblem problem;
  for (unsigned seed = 0; seed < 60; ++seed) {
    Boxes s;
    s.random.seed(seed);
    const std::size_t count = 2 + seed % 8;
    for (std::size_t i = 0; i < count; ++i) {
      s.add_box({0.0, 0.0, edge * (static_cast<double>(i) + 0.5)}, std::pow(10.0, s.either(3.0)));
    }
    if (seed % 3 != 0) {  // pressed down, moved along and turned
      s.hold(std::pow(10.0, 3.0 + s.either(6.0)),
             1e-4 * (Vector6d() << s.either(1.0), s.either(1.0), -1.0, s.either(3.0), s.either(3.0), 0.0).finished());
    }
    for (std::size_t i = 0; i < count; ++i) s.add_face(i, i == 0 ? nothing : i - 1, Vector3d::UnitZ(), 0.3);
    s.fill(problem);
    const ContactProblem::Result result = problem.solve(1e-4, 1e-6);
    EXPECT_LE(result.residual, 1e-6) << "seed " << seed;
    EXPECT_LE(s.violation(problem), 4e-6) << "seed " << seed;
  }
}

TEST(ContactProblem, StacksOfUnlikeMassesTakeFewFactors) {
  ContactProblem problem;
  for (const double top : {1.0, 1e3, 1e6}) {
    const Boxes s = stack(10, top, 3);
    s.fill(problem);
    const ContactProblem::Result result = problem.solve(1e-4, 1e-6);
    EXPECT_LE(result.residual, 4e-7) << top;
    EXPECT_LE(result.factors, top < 1e4 ? 5 : 200) << top;
    double carried = 0.0;  // to what the gaps are off, as a share of the fall
    for (std::size_t i = 0; i < 4; ++i) carried += problem.load(i)[0];
    EXPECT_NEAR(carried, (9.0 + top) * gravity, 0.02 * (9.0 + top) * gravity);
  }
}

TEST(ContactProblem, AFork1e9TimesAsStiffAsTheBoxIsHeavyIsSolved) {
  for (const std::size_t count : {1, 2, 10}) {
    Boxes s;
    for (std::size_t i = 0; i < count; ++i) s.add_box({0.0, 0.0, edge * (static_cast<double>(i) + 0.5)}, 1e-3);
    s.hold(1e9, (Vector6d() << 7e-4, 0.0, -1e-3, 0.0, 3e-3, 0.0).finished());
    for (std::size_t i = 0; i < count; ++i) s.add_face(i, i == 0 ? nothing : i - 1, Vector3d::UnitZ(), 0.5);
    ContactProblem problem;
    s.fill(problem);
    EXPECT_LE(problem.solve(1e-4, 1e-6).residual, 1e-6) << count;
    EXPECT_LE(s.violation(problem), 4e-6) << count;
  }
}

TEST(ContactProblem, AnEvenRowOfBoxesTakesIterationsAlone) {
  Boxes s;
  for (std::size_t i = 0; i < 9; ++i) {
    s.add_box({2.0 * edge * static_cast<double>(i), 0.0, 0.5 * edge}, 1.0);
    s.add_face(i, nothing, Vector3d::UnitZ(), 0.5);
  }
  ContactProblem problem;
  s.fill(problem);
  const ContactProblem::Result result = problem.solve(0.01, 1e-6);
  EXPECT_LE(result.residual, 4e-7);
  EXPECT_EQ(result.factors, 0);
}

/// Contacts of one body with random Jacobians, whose degrees of freedom respond up to `spread` times as much as each
/// other. Standing still is an admissible motion.
struct RandomContacts {
  MatrixXd J;
  VectorXd response, motion;
  std::vector<double> friction;

  RandomContacts(std::mt19937& random, Index contacts, Index dofs, double spread) : response(dofs) {
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> unit;
    J = MatrixXd::NullaryExpr(3 * contacts, dofs, [&] { return normal(random); });
    for (double& r : response) r = std::pow(spread, unit(random) - 0.5);
    motion = J * VectorXd::NullaryExpr(dofs, [&] { return normal(random); });
    for (Index i = 0; i < contacts; ++i) friction.push_back(i % 4 == 0 ? 0.0 : unit(random));
  }
  std::size_t fill(ContactProblem& problem) const {
    const std::size_t body = problem.add_body(response.asDiagonal().toDenseMatrix());
    for (std::size_t i = 0; i < friction.size(); ++i) {
      const auto row = static_cast<Index>(3 * i);
      problem.add_contact(friction[i], motion.segment<3>(row), Vector3d::Zero());
      problem.add_part(body, J.middleRows<3>(row));
    }
    return body;
  }
  /// How far loads and motions are from Coulomb's law, as a share of the largest of each.
  double violation(const ContactProblem& problem, const VectorXd& change) const {
    const VectorXd u = motion + J * change;
    double worst = 0.0, largest = motion.cwiseAbs().maxCoeff() / (J * response.asDiagonal() * J.transpose()).trace();
    for (std::size_t i = 0; i < friction.size(); ++i) largest = std::max(largest, problem.load(i).norm());
    for (std::size_t i = 0; i < friction.size(); ++i) {
      const Vector3d load = problem.load(i) / largest;
      const Vector3d moves = u.segment<3>(static_cast<Index>(3 * i)) / motion.cwiseAbs().maxCoeff();
      const double most = friction[i] * load[0];
      const Eigen::Vector2d across = load.tail<2>(), slip = moves.tail<2>();
      worst = std::max({worst, -moves[0], -load[0], std::abs(load[0] * moves[0]), across.norm() - most,
                        (slip * most + slip.norm() * across).norm()});  // what slips is opposed with all there is
    }
    return worst;
  }
};

TEST(ContactProblem, RandomContactsKeepCoulombsLaw) {
  std::mt19937 random(1);
  int solved = 0;
  for (int i = 0; i < 200; ++i) {
    const RandomContacts c(random, 1 + i % 8, 6 + i % 7, i % 2 == 0 ? 1e2 : 1e6);
    ContactProblem problem;
    const std::size_t body = c.fill(problem);
    if (problem.solve(1e-9, 1e-6).residual > 1e-6) continue;
    ++solved;
    EXPECT_LE(c.violation(problem, problem.change(body)), 2e-6) << "problem " << i;
  }
  EXPECT_GE(solved, 195);
}

TEST(ContactProblem, WithoutFrictionItAgreesWithTheOnlySetOfContactsThatCanPress) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 50; ++trial) {
    const Index contacts = 1 + trial % 6;
    RandomContacts c(random, contacts, 6 + trial % 7, 1e2);
    c.friction.assign(c.friction.size(), 0.0);
    ContactProblem problem;
    const std::size_t body = c.fill(problem);
    problem.solve(1e-9, 1e-6);
    MatrixXd N(contacts, c.J.cols());
    VectorXd closing(contacts);
    for (Index i = 0; i < contacts; ++i) {
      N.row(i) = c.J.row(3 * i);
      closing[i] = c.motion[3 * i];
    }
    bool found = false;
    for (int set = 0; set < 1 << contacts && !found; ++set) {
      std::vector<Index> pressing;
      for (Index i = 0; i < contacts; ++i) {
        if ((set >> i & 1) != 0) pressing.push_back(i);
      }
      const MatrixXd P = N(pressing, Eigen::all);
      VectorXd change = VectorXd::Zero(c.J.cols());
      if (!pressing.empty()) {
        const VectorXd loads = (P * c.response.asDiagonal() * P.transpose()).ldlt().solve(VectorXd(-closing(pressing)));
        if (loads.minCoeff() < 0.0) continue;
        change = c.response.asDiagonal() * P.transpose() * loads;
      }
      if ((closing + N * change).minCoeff() < -1e-9) continue;
      found = true;
      EXPECT_LE((problem.change(body) - change).norm(), 1e-4 * (1.0 + change.norm())) << "trial " << trial;
    }
    EXPECT_TRUE(found);
  }
}

TEST(ContactProblem, AShortStepIsSolvedAsWellAsALongOne) {
  for (const double shorter : {1.0, 1e-2}) {  // all motions, of 0.04 mm at first, are as much smaller
    Boxes s = stack(10, 1e3, 3);
    for (Boxes::Contact& c : s.contacts) c.motion *= shorter;
    ContactProblem problem;
    s.fill(problem);
    problem.solve(1e-4, 1e-6);
    double carried = 0.0;
    for (std::size_t i = 0; i < 4; ++i) carried += problem.load(i)[0];
    EXPECT_NEAR(carried, 1009.0 * gravity * shorter, 0.02 * 1009.0 * gravity * shorter) << shorter;
  }
}

TEST(ContactProblem, AHeavyCubeOnALightOneSharesItsWeightOut) {
  // 1000 kg on 1 g on the ground, each contact one point: the upper carries the upper cube, the lower both.
  const double m_light = 1e-3, m_heavy = 1e3, fall = 0.01;
  ContactProblem problem;
  const std::size_t light = problem.add_body(Matrix3d::Identity() / m_light);
  const std::size_t heavy = problem.add_body(Matrix3d::Identity() / m_heavy);
  problem.add_contact(0.5, -fall * Vector3d::UnitX(), Vector3d::Zero());
  problem.add_part(light, Matrix3d::Identity());
  problem.add_contact(0.5, Vector3d::Zero(), Vector3d::Zero());  // both fall alike: the upper gap stays
  problem.add_part(heavy, Matrix3d::Identity());
  problem.add_part(light, -Matrix3d::Identity());
  problem.solve(1e-9, 1e-6);
  EXPECT_NEAR(problem.load(0)[0], (m_light + m_heavy) * fall, 1e-6 * m_heavy * fall);
  EXPECT_NEAR(problem.load(1)[0], m_heavy * fall, 1e-6 * m_heavy * fall);
}

TEST(ContactProblem, WhatOpensIsLeftAlone) {
  for (const double friction : {0.0, 0.5}) {
    for (const Vector3d& opens : {Vector3d(2.0, 0.0, 0.0), Vector3d(1.0, 2.0, 3.0)}) {
      ContactProblem problem;
      const std::size_t body = problem.add_body(MatrixXd::Identity(6, 6));
      const std::size_t contact = problem.add_contact(friction, opens, Vector3d::Zero());
      problem.add_part(body, MatrixXd::Identity(3, 6));
      EXPECT_EQ(problem.solve(1e-4, 1e-6).residual, 0.0);
      EXPECT_EQ(problem.load(contact), Vector3d::Zero());
    }
  }
}

TEST(ContactProblem, WallsThatLeaveNoRoomAreNotPressedApart) {
  // A block between two walls that overlap it by 1 mm each and lean towards each other less than friction holds: any
  // loads that balance are admissible, none makes room. It is pressed down as a hand presses it.
  const double stiffness = 1e5, press = 1e-3, lean = 0.2;
  ContactProblem problem;
  const std::size_t body = problem.add_body(Vector3d::Constant(1.0 / stiffness).asDiagonal().toDenseMatrix());
  for (const double side : {-1.0, 1.0}) {
    for (int i = 0; i < 4; ++i) {
      const Vector3d n(side * std::cos(lean), 0.0, std::sin(lean));
      const Matrix3d axes = (Matrix3d() << n, Vector3d::UnitY(), n.cross(Vector3d::UnitY())).finished().transpose();
      const Vector3d motion = axes * Vector3d(0.0, 0.0, -press);
      problem.add_contact(0.4, motion - 1e-3 * Vector3d::UnitX(), Vector3d::Zero());
      problem.add_part(body, axes);
    }
  }
  const ContactProblem::Result result = problem.solve(1e-5, 1e-6);
  EXPECT_GT(result.residual, 1e-6);
  // Each iteration presses a contact by what the body resists to what is left of the overlap, at most.
  const double once = stiffness * (press + 1e-3);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_LE(problem.load(i).norm(), 2.0 * 100.0 * once);
}

TEST(ContactProblem, PartsOfOneBodyAddUp) {
  ContactProblem once, twice;
  const Vector3d motion(-1.0, 0.3, 0.0);
  for (ContactProblem* problem : {&once, &twice}) {
    problem->add_body(Matrix3d::Identity());
    problem->add_contact(0.5, motion, Vector3d::Zero());
  }
  once.add_part(0, 3.0 * Matrix3d::Identity());
  twice.add_part(0, Matrix3d::Identity());
  twice.add_part(0, 2.0 * Matrix3d::Identity());
  once.solve(1e-9, 1e-6);
  twice.solve(1e-9, 1e-6);
  EXPECT_EQ(once.load(0), twice.load(0));
}

TEST(ContactProblem, SticksBelowTheAngleOfFrictionAndSlidesAbove) {
  const double friction = 0.5, angle = std::atan(friction);
  for (const double beyond : {-0.2, -0.01, 0.01, 0.2}) {
    const Vector3d b(-std::cos(angle + beyond), std::sin(angle + beyond), 0.0);
    ContactProblem problem;
    const std::size_t body = problem.add_body(Matrix3d::Identity());
    problem.add_contact(friction, b, Vector3d::Zero());
    problem.add_part(body, Matrix3d::Identity());
    problem.solve(1e-9, 1e-6);
    EXPECT_NEAR(problem.load(0)[0], -b[0], 1e-8);
    EXPECT_NEAR(b[1] + problem.change(body)[1], std::max(0.0, b[1] + friction * b[0]), 1e-8);
  }
}

TEST(ContactProblem, ContactsTwiceOverMoveNothingElse) {
  Boxes s = stack(4, 100.0, 5, 0.0);
  ContactProblem once, twice;
  s.fill(once);
  EXPECT_LE(once.solve(1e-6, 1e-8).residual, 1e-8);
  s.contacts.insert(s.contacts.end(), s.contacts.begin(), s.contacts.end());
  s.fill(twice);
  EXPECT_LE(twice.solve(1e-6, 1e-8).residual, 1e-8);
  for (std::size_t i = 0; i < s.boxes.size(); ++i) EXPECT_LE((once.change(i) - twice.change(i)).norm(), 1e-6);
}

TEST(ContactProblem, TheOrderOfBodiesAndContactsDoesNotMatter) {
  Boxes s = stack(5, 30.0, 6);
  ContactProblem problem, other;
  s.fill(problem);
  EXPECT_LE(problem.solve(1e-6, 1e-8).residual, 1e-7);
  Boxes turned = s;
  std::reverse(turned.boxes.begin(), turned.boxes.end());
  std::shuffle(turned.contacts.begin(), turned.contacts.end(), std::mt19937(1));
  for (Boxes::Contact& c : turned.contacts) {
    c.upper = s.boxes.size() - 1 - c.upper;
    if (c.lower != nothing) c.lower = s.boxes.size() - 1 - c.lower;
  }
  turned.fill(other);
  EXPECT_LE(other.solve(1e-6, 1e-8).residual, 1e-7);
  for (std::size_t i = 0; i < s.boxes.size(); ++i) {
    EXPECT_LE((problem.change(i) - other.change(s.boxes.size() - 1 - i)).head<3>().norm(), 1e-6);
  }
}

TEST(ContactProblem, ABodyMayHaveAnyNumberOfDegreesOfFreedom) {
  const Boxes s = stack(2, 10.0, 8);
  ContactProblem two, one;
  s.fill(two);
  EXPECT_LE(two.solve(1e-6, 1e-8).residual, 1e-7);
  MatrixXd response = MatrixXd::Zero(12, 12);
  response.topLeftCorner<6, 6>() = s.boxes[0].response;
  response.bottomRightCorner<6, 6>() = s.boxes[1].response;
  const std::size_t both = one.add_body(response);
  EXPECT_EQ(one.add_body(MatrixXd(0, 0)), both + 1);
  for (const Boxes::Contact& c : s.contacts) {
    one.add_contact(c.friction, c.motion, Vector3d::Zero());
    Eigen::Matrix3Xd J = Eigen::Matrix3Xd::Zero(3, 12);
    J.middleCols<6>(6 * static_cast<Index>(c.upper)) = c.J_upper;
    if (c.lower != nothing) J.middleCols<6>(6 * static_cast<Index>(c.lower)) = c.J_lower;
    one.add_part(both, J);
  }
  EXPECT_LE(one.solve(1e-6, 1e-8).residual, 1e-7);
  EXPECT_LE((one.change(both) - (VectorXd(12) << two.change(0), two.change(1)).finished()).norm(), 1e-6);
}

TEST(ContactProblem, TheSameProblemGivesTheSameBits) {
  const Boxes s = stack(6, 1e6, 9), other = stack(3, 1.0, 1);
  ContactProblem first, second;
  s.fill(first);
  first.solve(1e-4, 1e-6);
  other.fill(second);
  second.solve(1e-4, 1e-6);
  s.fill(second);
  second.solve(1e-4, 1e-6);
  for (std::size_t i = 0; i < s.contacts.size(); ++i) EXPECT_EQ(first.load(i), second.load(i));
}

TEST(ContactProblem, WhatCannotBeSolvedLoadsNothing) {
  ContactProblem problem;
  problem.add_contact(0.5, -Vector3d::UnitX(), Vector3d::Ones());  // it closes, but nothing can yield
  EXPECT_EQ(problem.solve(1e-4, 1e-6).residual, 0.0);
  EXPECT_EQ(problem.load(0), Vector3d::Zero());
  problem.clear();
  const std::size_t body = problem.add_body(Matrix3d::Identity());
  problem.add_contact(0.5, {std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0}, Vector3d::Zero());
  problem.add_part(body, Matrix3d::Identity());
  EXPECT_FALSE(std::isfinite(problem.solve(1e-4, 1e-6).residual));
  EXPECT_EQ(problem.load(0), Vector3d::Zero());
}

}  // namespace
}  // namespace spring_workbench::friction
