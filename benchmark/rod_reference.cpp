#include "benchmark/rod_reference.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "benchmark/cvode_integrator.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double kSameTime = 1e-9;             // s
constexpr double kRecordedUncertainty = 2e-9;  // m: what the recorded trajectories say of themselves

std::vector<RigidTransform> recorded_poses(const RodCase& one) {
  std::ifstream file(one.recorded);
  std::vector<RigidTransform> poses;
  const std::vector<double> times = output_times(one);
  std::string line, cell;
  std::getline(file, line);
  while (poses.size() < times.size() && std::getline(file, line)) {
    std::istringstream in(line);
    std::vector<double> v;  // t, x, y, z, qx, qy, qz, qw
    for (int column = 0; column < 9 && std::getline(in, cell, ','); ++column) {
      if (column != 1) v.push_back(std::stod(cell));
    }
    if (v.size() != 8 || std::abs(v[0] - times[poses.size()]) > 1e-6) break;
    poses.push_back(make_transform(Quaterniond(v[7], v[4], v[5], v[6]).normalized(), {v[1], v[2], v[3]}));
  }
  if (poses.size() != times.size()) {
    throw std::runtime_error(one.recorded + ": fewer rows than outputs at 50 Hz to " + std::to_string(one.duration) +
                             " s");
  }
  return poses;
}

double largest_deflection(const RodCase& one, const std::vector<RigidTransform>& X_WO) {
  motion::PoseTrack track = hand_track(one);
  const Vector3d p_HO = one.fork.length * Vector3d::UnitZ() - one.p_OE;
  const std::vector<double> times = output_times(one);
  double largest = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const RigidTransform X_WH = track.segment(times[i]).at(times[i]).X;
    largest = std::max(largest, (X_WO[i].translation() - X_WH * p_HO).norm());
  }
  return largest;
}

dynamics::StrainState unpacked(const double* y, int size) {
  return {Eigen::Map<const Eigen::VectorXd>(y, size), Eigen::Map<const Eigen::VectorXd>(y + size, size)};
}

}  // namespace

std::vector<double> tolerance_scale(const RodCase& one, const dynamics::HeldBody& body) {
  const int n = body.size();
  std::vector<double> scale;
  for (int i = 0; i < 2 * n; ++i) {
    const double strain = one.mass * 9.81 * one.fork.length / body.stiffness()[i % n];
    scale.push_back((i < n ? 1.0 : 10.0) * std::min(strain, 1.0));
  }
  return scale;
}

std::vector<RigidTransform> cvode_poses(const RodCase& one, const std::string& shape, double tolerance) {
  const dynamics::HeldBody body = held_body(one, shape);
  const int n = body.size();
  motion::PoseTrack track = hand_track(one);
  const motion::MotionSegment* segment = &track.segment(0.0);
  CvodeIntegrator cvode(2 * n, [&](double t, const double* y, double* rate) {
    const dynamics::StrainState state = unpacked(y, n);
    if (!body.shape().admissible(body.full_state(t, state).q)) return false;
    Eigen::Map<Eigen::VectorXd>(rate, n) = state.q_dot;
    Eigen::Map<Eigen::VectorXd>(rate + n, n) = body.acceleration(body.forcing(*segment, t), state.q, state.q_dot);
    return true;
  });
  const std::vector<double> y(static_cast<std::size_t>(2 * n), 0.0);
  cvode.begin(0.0, y, tolerance, tolerance_scale(one, body));
  std::vector<RigidTransform> poses{body.object(body.forcing(*segment, 0.0), unpacked(y.data(), n)).X};
  const std::vector<double> ends = step_ends(one), times = output_times(one);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    segment = &track.segment(0.5 * (ends[i] + ends[i + 1]));
    cvode.restart(ends[i]);
    const dynamics::StrainState state = unpacked(cvode.advance(ends[i + 1], true), n);
    if (ends[i + 1] > times[poses.size()] - kSameTime) {
      poses.push_back(body.object(body.forcing(*segment, ends[i + 1]), state).X);
    }
  }
  return poses;
}

PoseDistance largest_distance(const std::vector<RigidTransform>& a, const std::vector<RigidTransform>& b) {
  PoseDistance distance;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    distance.position = std::max(distance.position, (a[i].translation() - b[i].translation()).norm());
    distance.angle = std::max(distance.angle, math::log_so3(a[i].linear().transpose() * b[i].linear()).norm());
  }
  return distance;
}

RodReference rod_reference(const RodCase& one, const std::string& shape) {
  RodReference reference;
  if (one.recorded.empty()) {
    reference.X_WO = cvode_poses(one, shape, 1e-12);
    reference.uncertainty = largest_distance(reference.X_WO, cvode_poses(one, shape, 1e-11)).position;
  } else {
    reference.X_WO = recorded_poses(one);
    reference.uncertainty = kRecordedUncertainty;
  }
  reference.largest_deflection = largest_deflection(one, reference.X_WO);
  return reference;
}

}  // namespace spring_workbench::benchmark
