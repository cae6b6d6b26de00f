#include "spring_workbench/instruments/reading_average.h"

#include <cmath>
#include <utility>

#include "constants.h"

namespace spring_workbench::instruments {
namespace {

const std::string& carried_by(const tools::ToolState& tool) {
  return tool.held_object.empty() ? tool.touched : tool.held_object;
}

}  // namespace

void ReadingAverage::record_instant(double t, const tools::ToolState& tool) {
  const std::string& carried = carried_by(tool);
  if (carried.empty() || (last_ && (t < last_->t || last_->carried != carried))) {
    last_.reset();
    present_ = Part();
    parts_.clear();
  }
  if (carried.empty()) return;
  if (last_) {
    const double half = 0.5 * (t - last_->t);
    present_.duration += t - last_->t;
    present_.weight += half * (last_->weight + tool.weight);
    present_.torque += half * (last_->torque + tool.torque);
  }
  last_ = Instant{t, tool.weight, tool.torque, carried};
  if (present_.duration < reading_part) return;
  parts_.push_back(std::exchange(present_, Part()));
  if (parts_.size() > reading_parts) parts_.pop_front();
}

tools::Reading ReadingAverage::average(double Part::*integral, double present) const {
  tools::Reading reading{present};
  if (parts_.empty()) return reading;
  double duration = 0.0, sum = 0.0, squares = 0.0;
  for (const Part& part : parts_) {
    duration += part.duration;
    sum += part.*integral;
  }
  reading.mean = sum / duration;
  for (const Part& part : parts_) squares += part.duration * std::pow(part.*integral / part.duration - reading.mean, 2);
  const auto count = static_cast<double>(parts_.size());
  if (count > 1.0) reading.uncertainty = std::sqrt(squares / duration / (count - 1.0));
  return reading;
}

/// The path along the axis is that of the tip of an undeformed probe, relative to the touched body.
void ReadingAverage::touch(double t, const tools::ToolState& tool, const RigidTransform& X_WT) {
  const double stiffness = tool.stiffness.stretch, damping = tool.probe_damping;
  const double force = -tool.handle_wrench_H.force.z();
  const bool continues = touch_ && touch_->touched == tool.touched && touch_->probe_stiffness == stiffness &&
                         touch_->probe_damping == damping && t >= touch_->t;
  if (!continues) {
    touch_.reset();
    material_.reset();
  }
  if (tool.touched.empty() || !(force > 0.0) || (touch_ && t == touch_->t)) return;
  const RigidTransform X_TS = X_WT.inverse() * tool.X_WS;
  if (!touch_) {
    touch_ = Touch{t, tool.touched, stiffness, damping, X_TS.linear().col(2), MaterialEstimate(stiffness, damping)};
  }
  touch_->t = t;
  touch_->estimate.add(t, touch_->axis_T.dot(X_TS * Vector3d(0.0, 0.0, tool.length)), force);
  material_ = touch_->estimate.reading();
}

void ReadingAverage::add(double t, tools::ToolState& tool, const RigidTransform& X_WT) {
  record_instant(t, tool);
  touch(t, tool, X_WT);
  fill_in(tool);
}

void ReadingAverage::fill_in(tools::ToolState& tool) const {
  const bool known = material_ && touch_->touched == tool.touched;
  tool.material_stiffness = known ? material_->material.value : 0.0;
  tool.material_stiffness_uncertainty = known ? material_->material_deviation : 0.0;
  const bool same = last_ && last_->carried == carried_by(tool);
  tool.weight_average = same ? average(&Part::weight, tool.weight) : tools::Reading{tool.weight};
  tool.torque_average = same ? average(&Part::torque, tool.torque) : tools::Reading{tool.torque};
}

}  // namespace spring_workbench::instruments
