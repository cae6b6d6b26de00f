#include "spring_workbench/motion/pose_track.h"

#include <algorithm>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "constants.h"
#include "spring_workbench/math/so3.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::motion {
namespace {

void check_sample(const PoseSample& sample) {
  validation::check_number("tracked pose", "t", sample.t, validation::between(-farthest_time, farthest_time).in("s"));
  const std::string where = "tracked pose at t = " + std::to_string(sample.t) + " s";
  const char* const axes[] = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i) {
    validation::check_number(where, axes[i], sample.X.translation()[i],
                             validation::between(-farthest_position, farthest_position).in("m"));
  }
  const Matrix3d R = sample.X.linear();
  const double defect = (R.transpose() * R - Matrix3d::Identity()).norm();
  if (!(defect < rotation_tolerance && R.determinant() > 0.0)) {  // also true for NaN
    std::ostringstream text;
    text << R.format(Eigen::IOFormat(6, Eigen::DontAlignCols, " ", "; "));
    validation::refuse(where, "rotation", text.str(), "a right-handed orthonormal matrix");
  }
}

/// Derivative at 0 of the parabola through (0, 0), (s_1, x_1) and (s_2, x_2).
Vector3d parabola_slope(double s_1, const Vector3d& x_1, double s_2, const Vector3d& x_2) {
  return (s_2 / s_1 * x_1 - s_1 / s_2 * x_2) / (s_2 - s_1);
}

Vector3d displacement(const PoseSample& from, const PoseSample& to) {
  return to.X.translation() - from.X.translation();
}

}  // namespace

PoseTrack::PoseTrack(double dropout_after) : dropout_after_(dropout_after), current_(RigidTransform::Identity()) {
  validation::check_number("tracked pose", "dropout_after", dropout_after, validation::positive_or_infinite().in("s"));
}

bool PoseTrack::push(const PoseSample& sample) {
  check_sample(sample);
  if (!nodes_.empty() && !(sample.t - end() >= shortest_interval)) return false;
  nodes_.emplace_back();
  nodes_.back().sample = sample;
  current_valid_ = false;
  return true;
}

const MotionSegment& PoseTrack::segment(double t) {
  if (current_valid_ && current_.begin() <= t && t < current_.end()) return current_;
  const std::size_t k = index_at(t);
  if (joined(k)) {
    nodes_[k] = with_velocity(k);
    nodes_[k + 1] = with_velocity(k + 1);
  }
  current_ = make_segment(k);
  current_valid_ = true;
  return current_;
}

MotionSegment PoseTrack::provisional(double t) const { return make_segment(index_at(t)); }

RigidTransform PoseTrack::pose(double t) const {
  const std::size_t k = index_at(t);
  return nodes_[k].sample.t == t ? nodes_[k].sample.X : make_segment(k).at(t).X;
}

double PoseTrack::next_after(double t) const {
  const auto later = first_after(t);
  return later == nodes_.end() ? std::numeric_limits<double>::infinity() : later->sample.t;
}

std::deque<PoseTrack::Node>::const_iterator PoseTrack::first_after(double t) const {
  return std::upper_bound(nodes_.begin(), nodes_.end(), t,
                          [](double time, const Node& node) { return time < node.sample.t; });
}

std::size_t PoseTrack::index_at(double t) const {
  if (nodes_.empty() || !(t >= begin())) throw std::logic_error("PoseTrack: no sample at or before this time");
  return static_cast<std::size_t>(first_after(t) - nodes_.begin()) - 1;
}

void PoseTrack::forget_before(double t) {
  // The segment at t may still need the sample before its start for its velocities.
  while (nodes_.size() > 2 && nodes_[2].sample.t <= t) nodes_.pop_front();
}

void PoseTrack::clear() {
  nodes_.clear();
  current_valid_ = false;
}

void PoseTrack::archive(math::StateArchive& state) {
  state(nodes_);
  if (state.is_restoring()) current_valid_ = false;
}

bool PoseTrack::joined(std::size_t k) const {
  return k + 1 < nodes_.size() && nodes_[k + 1].sample.t - nodes_[k].sample.t <= dropout_after_;
}

MotionSegment PoseTrack::make_segment(std::size_t k) const {
  const PoseSample& a = nodes_[k].sample;
  if (k + 1 == nodes_.size()) return MotionSegment(a.X, a.t);
  if (!joined(k)) return MotionSegment(a.X, a.t, nodes_[k + 1].sample.t);
  const Node node_a = with_velocity(k);
  const Node node_b = with_velocity(k + 1);
  return MotionSegment(node_a.sample, node_a.v_W, node_a.w_B, node_b.sample, node_b.v_W, node_b.w_B);
}

PoseTrack::Node PoseTrack::with_velocity(std::size_t k) const {
  Node node = nodes_[k];
  if (node.velocity_fixed) return node;
  const bool has_before = k > 0 && joined(k - 1);
  const bool has_after = joined(k);
  const PoseSample& here = node.sample;
  if (has_before && has_after) {
    const PoseSample& before = nodes_[k - 1].sample;
    const PoseSample& after = nodes_[k + 1].sample;
    const double s_1 = before.t - here.t;
    const double s_2 = after.t - here.t;
    node.v_W = parabola_slope(s_1, displacement(here, before), s_2, displacement(here, after));
    node.w_B = parabola_slope(s_1, math::turn_between(here.X, before.X), s_2, math::turn_between(here.X, after.X));
  } else {  // at an end: the chord
    const PoseSample& other = nodes_[has_before ? k - 1 : k + 1].sample;
    const double s = other.t - here.t;
    node.v_W = displacement(here, other) / s;
    node.w_B = math::turn_between(here.X, other.X) / s;
  }
  node.velocity_fixed = true;
  return node;
}

}  // namespace spring_workbench::motion
