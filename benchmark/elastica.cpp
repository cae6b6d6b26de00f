#include "benchmark/elastica.h"

#include <Eigen/LU>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "spring_workbench/dynamics/held_body.h"
#include "spring_workbench/validation/names.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double kHalfPi = 1.5707963267948966192313216916398;
constexpr double kLength = 0.2;  // m
constexpr double kBend = 500.0;  // N/m
constexpr double kRigid = 1e10;  // N/m, N m/rad
constexpr int kLoadSteps = 40;
constexpr double kNewtonTolerance = 1e-13;

struct Moduli {
  double k, phi;
};

Moduli moduli(double slope) {
  const double k = std::sqrt(0.5 * (1.0 + std::sin(slope)));
  return {k, std::asin(std::min(1.0, 1.0 / (k * std::sqrt(2.0))))};
}

double root_of_load(double slope) {
  const Moduli m = moduli(slope);
  return std::comp_ellint_1(m.k) - std::ellint_1(m.k, m.phi);
}

/// The body on the tip of a rod that hardly extends or twists. Its mass only scales the accelerations, which vanish.
dynamics::HeldBody bending_body(const std::string& shape) {
  dynamics::HeldBody body(
      rod::make_shape_model(validation::named<rod::ShapeKind>(shape, "benchmark", "shape"), kLength),
      dynamics::BodyInertia(), 0.0);
  body.set_springs({kRigid, kBend, kRigid}, {1.0, 1.0, 1.0});
  return body;
}

/// Newton's method on q̈ = 0 at rest.
void find_rest(const dynamics::HeldBody& body, const dynamics::HandleState& handle, rod::StrainVector& q) {
  const rod::StrainVector still = rod::StrainVector::Zero(body.size()), K = body.stiffness();
  for (int iteration = 0; iteration < 50; ++iteration) {
    rod::StrainMatrix slope(body.size(), body.size());
    for (int j = 0; j < body.size(); ++j) {
      rod::StrainVector up = q, down = q;
      const double step = 1e-5 * K[0] / std::max(K[0], K[j]);
      up[j] += step;
      down[j] -= step;
      slope.col(j) =
          (body.acceleration(handle, up, still) - body.acceleration(handle, down, still)) / (up[j] - down[j]);
    }
    const rod::StrainVector change = slope.partialPivLu().solve(body.acceleration(handle, q, still));
    q -= change;
    if (change.norm() < kNewtonTolerance * (1.0 + q.norm())) return;
  }
}

}  // namespace

TipDeflection exact_elastica(double alpha) {
  double low = 0.0, high = kHalfPi;  // the slope at the tip grows with the load up to a right angle
  for (int i = 0; i < 200 && high - low > 1e-16; ++i) {
    const double middle = 0.5 * (low + high);
    (root_of_load(middle) < std::sqrt(alpha) ? low : high) = middle;
  }
  const double slope = 0.5 * (low + high);
  const Moduli m = moduli(slope);
  const double bent = std::comp_ellint_2(m.k) - std::ellint_2(m.k, m.phi);
  return {slope, 1.0 - 2.0 * bent / std::sqrt(alpha), 1.0 - std::sqrt(2.0 * std::sin(slope) / alpha)};
}

TipDeflection shape_deflection(const std::string& shape, double alpha) {
  dynamics::HeldBody body = bending_body(shape);
  const dynamics::HandleState handle = body.state_at(motion::MotionSegment(RigidTransform::Identity()), 0.0);
  const double EI = kBend * kLength * kLength * kLength / 3.0;
  rod::StrainVector q = rod::StrainVector::Zero(body.size());
  for (int step = 1; step <= kLoadSteps; ++step) {
    Wrench load;
    load.force = Vector3d(alpha * EI / (kLength * kLength) * step / kLoadSteps, 0.0, 0.0);
    body.set_load(load);
    find_rest(body, handle, q);
  }
  const RigidTransform tip = body.object(handle, {q, rod::StrainVector::Zero(body.size())}).X;
  const Matrix3d R = tip.linear();
  return {std::atan2(R(0, 2), R(2, 2)), tip.translation().x() / kLength, 1.0 - tip.translation().z() / kLength};
}

std::vector<ElasticaRow> elastica_table() {
  std::vector<ElasticaRow> rows;
  for (const std::string& shape : validation::names<rod::ShapeKind>()) {
    for (const double alpha : {0.1, 0.25, 0.5, 1.0, 2.0, 3.0, 5.0, 7.0, 10.0}) {
      ElasticaRow row{shape, alpha, exact_elastica(alpha), shape_deflection(shape, alpha)};
      row.tip_error =
          std::hypot(row.model.deflection - row.exact.deflection, row.model.shortening - row.exact.shortening);
      row.slope_error = std::abs(row.model.slope - row.exact.slope);
      rows.push_back(row);
    }
  }
  return rows;
}

double evaluation_cost(const std::string& shape) {
  using Clock = std::chrono::steady_clock;
  constexpr int batch = 1000;
  dynamics::HeldBody body(
      rod::make_shape_model(validation::named<rod::ShapeKind>(shape, "benchmark", "shape"), kLength),
      dynamics::BodyInertia(), 9.81);
  body.set_springs({2000.0, kBend, 5.0}, {1.0, 1.0, 1.0});
  const dynamics::HandleState handle = body.state_at(motion::MotionSegment(RigidTransform::Identity()), 0.0);
  rod::StrainVector q = rod::StrainVector::Constant(body.size(), 0.05), q_dot = q;
  double least = std::numeric_limits<double>::infinity(), spent = 0.0;
  while (spent < 0.05) {
    const Clock::time_point start = Clock::now();
    for (int i = 0; i < batch; ++i) q_dot[0] = 1e-9 * body.acceleration(handle, q, q_dot)[0];
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    least = std::min(least, seconds / batch);
    spent += seconds;
  }
  return 1e9 * least;
}

double elastica_check(const std::string& folder) {
  std::ifstream file(folder + "/elastica.csv");
  std::string line, cell;
  std::getline(file, line);
  double largest = -1.0;
  while (std::getline(file, line)) {
    std::istringstream in(line);
    std::vector<double> v;  // alpha, w/L, u/L, slope
    for (int column = 0; column < 4 && std::getline(in, cell, ','); ++column) v.push_back(std::stod(cell));
    if (v.size() != 4) continue;
    const TipDeflection exact = exact_elastica(v[0]);
    largest = std::max(
        {largest, std::abs(exact.deflection - v[1]), std::abs(exact.shortening - v[2]), std::abs(exact.slope - v[3])});
  }
  return largest;
}

std::string elastica_csv(const std::vector<ElasticaRow>& rows) {
  std::ostringstream out;
  out.precision(8);
  out << "shape,alpha,exact_slope,exact_w_over_L,exact_u_over_L,slope,w_over_L,u_over_L,tip_error_over_L,slope_error\n";
  for (const ElasticaRow& row : rows) {
    out << row.shape << ',' << row.alpha << ',' << row.exact.slope << ',' << row.exact.deflection << ','
        << row.exact.shortening << ',' << row.model.slope << ',' << row.model.deflection << ',' << row.model.shortening
        << ',' << row.tip_error << ',' << row.slope_error << '\n';
  }
  return out.str();
}

}  // namespace spring_workbench::benchmark
