#include "spring_workbench/registration/registration.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>

#include "constants.h"
#include "millimetres.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::registration {
namespace {

using Points = Eigen::Matrix3Xd;

const std::string kWhere = "registration";

RigidTransform fit(const Points& to, const Points& from) {
  RigidTransform X;
  X.matrix() = Eigen::umeyama(from, to, false);
  return X;
}

double rms_of(const RigidTransform& X, const Points& to, const Points& from) {
  const Points residuals = (X.linear() * from).colwise() + X.translation() - to;
  return std::sqrt(residuals.squaredNorm() / static_cast<double>(to.cols()));
}

/// The order of touches, other than the given one, that fits best, with its RMS. Nothing if there are too many
/// landmarks to try all orders.
std::optional<std::pair<double, std::vector<int>>> best_other_order(const Points& to, const Points& from) {
  if (to.cols() > max_permuted) return std::nullopt;
  std::vector<int> order(static_cast<std::size_t>(to.cols()));
  std::iota(order.begin(), order.end(), 0);
  std::pair<double, std::vector<int>> best{std::numeric_limits<double>::infinity(), {}};
  Points shuffled = from;
  while (std::next_permutation(order.begin(), order.end())) {
    for (Eigen::Index i = 0; i < from.cols(); ++i) shuffled.col(i) = from.col(order[static_cast<std::size_t>(i)]);
    const double rms = rms_of(fit(to, shuffled), to, shuffled);
    if (rms < best.first) best = {rms, order};
  }
  return best;
}

void check_shape(const std::vector<Landmark>& landmarks, const Points& to) {
  if (landmarks.size() < 3)
    validation::refuse(kWhere, "landmarks", "at least 3, got " + std::to_string(landmarks.size()));
  std::set<std::string> names;
  for (const Landmark& landmark : landmarks) {
    if (!names.insert(landmark.name).second)
      throw validation::InputError(kWhere + ": landmarks: " + landmark.name + " is named twice");
    if (!landmark.p_B.allFinite() || !landmark.p_T.allFinite())
      validation::refuse(kWhere, landmark.name, "finite numbers");
  }
  const Points centred = to.colwise() - Vector3d(to.rowwise().mean());
  const Vector3d spread = Eigen::JacobiSVD<Eigen::MatrixXd>(centred).singularValues().head<3>();
  if (const double off_line = spread[1] / std::sqrt(static_cast<double>(to.cols())); off_line < min_extent) {
    validation::refuse(kWhere, "landmarks",
                       "at least " + millimetres(min_extent) + " off a common line, got " + millimetres(off_line));
  }
}

std::string in_order(const std::vector<Landmark>& landmarks, const std::vector<int>& order) {
  std::vector<std::string> names(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    names[static_cast<std::size_t>(order[i])] = landmarks[i].name;
  }
  return validation::join(names);
}

void check_fit(const std::vector<Landmark>& landmarks, const Registration& result, const Points& to, const Points& from,
               double largest_residual) {
  const auto worst = std::max_element(result.residuals.begin(), result.residuals.end());
  const auto other = best_other_order(to, from);
  if (*worst > largest_residual) {
    const std::string name = landmarks[static_cast<std::size_t>(worst - result.residuals.begin())].name;
    std::string given = millimetres(*worst);
    if (other && other->first < largest_residual) {
      given += "; the touches fit the order " + in_order(landmarks, other->second);
    }
    validation::refuse(kWhere, "residual of " + name, "at most " + millimetres(largest_residual) + ", got " + given);
  }
  if (other && other->first < std::max(3.0 * result.rms, 0.5 * largest_residual)) {
    throw validation::InputError(kWhere + ": landmarks: too symmetric, the touches also fit in the order " +
                                 in_order(landmarks, other->second) + " (rms " + millimetres(other->first) +
                                 "): add a landmark that breaks the symmetry");
  }
}

void estimate_errors(const Points& to, Registration& result) {
  const double n = static_cast<double>(to.cols());
  const double freedoms = 3.0 * n - 6.0;
  const double variance = n * result.rms * result.rms / freedoms;
  const Points centred = to.colwise() - Vector3d(to.rowwise().mean());
  const Matrix3d inertia = centred.squaredNorm() * Matrix3d::Identity() - centred * centred.transpose();
  result.touch_error = std::sqrt(variance);
  result.position_error = std::sqrt(3.0 * variance / n);
  result.angle_error = std::sqrt(variance * inertia.inverse().trace());
}

}  // namespace

Registration register_tracker(const std::vector<Landmark>& landmarks, double largest_residual) {
  const Eigen::Index n = static_cast<Eigen::Index>(landmarks.size());
  Points to(3, n), from(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    to.col(i) = landmarks[static_cast<std::size_t>(i)].p_B;
    from.col(i) = landmarks[static_cast<std::size_t>(i)].p_T;
  }
  check_shape(landmarks, to);
  Registration result;
  result.X_BT = fit(to, from);
  for (Eigen::Index i = 0; i < n; ++i) {
    result.residuals.push_back((result.X_BT * Vector3d(from.col(i)) - to.col(i)).norm());
  }
  result.rms = rms_of(result.X_BT, to, from);
  check_fit(landmarks, result, to, from, largest_residual);
  estimate_errors(to, result);
  return result;
}

PivotCalibration calibrate_tip(const std::vector<RigidTransform>& poses_TS, double largest_rms) {
  if (poses_TS.size() < min_poses)
    validation::refuse(
        kWhere, "poses",
        "at least 10, got " + std::to_string(poses_TS.size()) + ": hold the button down while you tilt the stylus");
  const Eigen::Index n = static_cast<Eigen::Index>(poses_TS.size());
  Eigen::MatrixXd A(3 * n, 6);
  Eigen::VectorXd b(3 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const RigidTransform& X = poses_TS[static_cast<std::size_t>(i)];
    A.block<3, 3>(3 * i, 0) = X.linear();
    A.block<3, 3>(3 * i, 3) = -Matrix3d::Identity();
    b.segment<3>(3 * i) = -X.translation();
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const double turned = svd.singularValues()[5] / std::sqrt(static_cast<double>(n));
  if (!(turned > min_turning))
    validation::refuse_because(kWhere, "poses",
                               "turned too little: tilt the stylus by at least 20 degrees about two axes");
  const Eigen::VectorXd x = svd.solve(b);
  PivotCalibration result{x.head<3>(), x.tail<3>(), std::sqrt((A * x - b).squaredNorm() / static_cast<double>(n))};
  if (!(result.rms <= largest_rms)) {
    validation::refuse(kWhere, "rms of the tip",
                       "at most " + millimetres(largest_rms) + ", got " + millimetres(result.rms) +
                           ": keep the tip in one place, or raise --largest-residual");
  }
  return result;
}

}  // namespace spring_workbench::registration
