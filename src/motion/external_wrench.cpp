#include "spring_workbench/motion/external_wrench.h"

#include <algorithm>
#include <limits>

#include "constants.h"
#include "spring_workbench/validation/names.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::motion {

void validate(const ExternalWrench& sample, const std::string& where) {
  const auto check = [&](const std::string& field, const Vector3d& values, double most, const char* unit) {
    const char* const axes[] = {"x", "y", "z"};
    for (int i = 0; i < 3; ++i) {
      validation::check_number(where, field + "." + axes[i], values[i], validation::between(-most, most).in(unit));
    }
  };
  validation::check_number(where, "t", sample.t, validation::between(-farthest_time, farthest_time).in("s"));
  check("force", sample.wrench.force, largest_force, "N");
  check("torque", sample.wrench.moment, largest_moment, "N·m");
  const std::vector<std::string> axes = validation::names<ExternalWrench::Axes>();
  if (static_cast<std::size_t>(sample.axes) >= axes.size()) {
    validation::refuse(where, "axes", "one of " + validation::join(axes));
  }
}

void WrenchTrack::push(const ExternalWrench& sample) {
  validate(sample, "");
  while (!next_.empty() && next_.back().t >= sample.t) next_.pop_back();
  next_.push_back(sample);
}

bool WrenchTrack::advance_to(double now, double same_time) {
  while (!next_.empty() && next_.front().t <= now + same_time) {
    present_ = next_.front();
    next_.pop_front();
  }
  const bool timed_out = present_ && present_->t + timeout_ <= now + same_time;
  if (timed_out) present_.reset();
  return timed_out;
}

double WrenchTrack::next_change_time(double now, double same_time) const {
  double next = std::numeric_limits<double>::infinity();
  const auto take = [&](double t) { next = t > now + same_time ? std::min(next, t) : next; };
  for (const ExternalWrench& sample : next_) take(sample.t);
  if (present_) take(present_->t + timeout_);
  return next;
}

void WrenchTrack::clear() {
  next_.clear();
  present_.reset();
}

}  // namespace spring_workbench::motion
