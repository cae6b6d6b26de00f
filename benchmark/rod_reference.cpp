#include "benchmark/rod_reference.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "benchmark/solver_run.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double kRecordedUncertainty = 2e-9;  // m, as stated by the recorded trajectories
constexpr double kFineHandTolerance = 1e-8;    // of fine_poses(); far below what the samples leave, at least 1e-4

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
    poses.push_back(make_transform({v[1], v[2], v[3]}, Quaterniond(v[7], v[4], v[5], v[6]).normalized()));
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

/// RodReference::hand_error of a case whose outputs are `halfway`.
double hand_error(RodCase halfway, const std::string& shape, const std::vector<RigidTransform>& X_WO) {
  if (halfway.fine_hand.empty()) return 0.0;
  halfway.hand = halfway.fine_hand;
  const PoseDistance left = largest_distance(X_WO, fine_poses(halfway, shape, kFineHandTolerance));
  return std::max(left.position, left.angle * farthest_point(halfway));
}

}  // namespace

double farthest_point(const RodCase& one) { return std::sqrt(1.5 * one.inertia.sum() / one.mass); }

std::vector<RigidTransform> fine_poses(const RodCase& one, const std::string& shape, double tolerance) {
  RodRun run = run_solver(one, shape, "solver_radau", tolerance, StepEnds::samples_and_outputs);
  if (!run.finite) throw std::runtime_error(one.name + ' ' + shape + ": Radau IIA does not reach the end");
  return std::move(run.X_WO);
}

RodCase with_halfway_outputs(RodCase one) {
  one.output_interval *= 0.5;
  return one;
}

std::vector<RigidTransform> every_other(const std::vector<RigidTransform>& poses) {
  std::vector<RigidTransform> some;
  for (std::size_t i = 0; i < poses.size(); i += 2) some.push_back(poses[i]);
  return some;
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
  const RodCase halfway = with_halfway_outputs(one);
  RodReference reference;
  reference.halfway = fine_poses(halfway, shape, kFineTolerance);
  reference.X_WO = every_other(reference.halfway);
  if (one.recorded.empty()) {
    reference.uncertainty =
        largest_distance(reference.halfway, fine_poses(halfway, shape, 10.0 * kFineTolerance)).position;
  } else {
    const std::vector<RigidTransform> recorded = recorded_poses(one);
    reference.uncertainty = std::max(kRecordedUncertainty, largest_distance(recorded, reference.X_WO).position);
    reference.X_WO = recorded;
  }
  reference.largest_deflection = largest_deflection(one, reference.X_WO);
  reference.hand_error = hand_error(halfway, shape, reference.halfway);
  return reference;
}

}  // namespace spring_workbench::benchmark
