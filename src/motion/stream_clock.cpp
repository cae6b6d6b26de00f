#include "spring_workbench/motion/stream_clock.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "constants.h"

namespace spring_workbench::motion {
namespace {

double seconds(std::int64_t nanoseconds) { return 1e-9 * static_cast<double>(nanoseconds); }

}  // namespace

std::string to_string(StampVerdict verdict) {
  static const char* const names[] = {"fits", "stepped", "too old", "from the future", "stamp not later"};
  return names[static_cast<std::size_t>(verdict)];
}

WallMoment WallClock::look(std::int64_t wall, std::int64_t steady) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::int64_t apart = wall - steady, moved = apart - offset_.value_or(apart);
  if (std::abs(seconds(moved)) > clock_slip) steps_ += moved;
  offset_ = apart;
  return {wall - steps_, steps_};
}

StampVerdict StreamClock::judge(std::int64_t stamp, const WallMoment& now) {
  if (!newest_) return begin(stamp, now);
  const double own_age = age(stamp, now), as_this_host = seconds(now.now - stamp + now.steps);
  const double off = std::abs(own_age - usual_age_);
  if (off > clock_slip && std::abs(as_this_host - usual_age_) < off) {
    step_to(now.steps);
    return StampVerdict::stepped;
  }
  StampVerdict verdict = StampVerdict::fits;
  if (own_age > max_age_) verdict = StampVerdict::too_old;
  if (own_age < usual_age_ - clock_slip) verdict = StampVerdict::from_the_future;
  if (seconds(*newest_ - stamp) > clock_slip) verdict = StampVerdict::not_later;
  if (verdict != StampVerdict::fits) {
    if (!comes_as_stamped({stamp, own_age})) return verdict;
    const auto younger = [](const Stamped& a, const Stamped& b) { return a.age < b.age; };
    const double least = std::min_element(misfits_.begin(), misfits_.end(), younger)->age;
    step_to(offset_ + std::llround(1e9 * (usual_age_ - least)));
    return StampVerdict::stepped;
  }
  usual_age_ = std::min(own_age, usual_age_ + clock_drift * seconds(now.now - came_));
  newest_ = std::max(*newest_, stamp);
  came_ = now.now;
  misfits_.clear();
  return verdict;
}

std::int64_t StreamClock::local_or_now(std::int64_t stamp, const WallMoment& now) {
  StampVerdict verdict = judge(stamp, now);
  if (verdict == StampVerdict::stepped) verdict = judge(stamp, now);
  return verdict == StampVerdict::fits ? local(stamp) : now.now;
}

StampVerdict StreamClock::begin(std::int64_t stamp, const WallMoment& now) {
  offset_ = now.steps;
  const double first_age = age(stamp, now);
  if (first_age > max_age_) return StampVerdict::too_old;
  if (first_age < -max_age_) return StampVerdict::from_the_future;
  usual_age_ = first_age;
  newest_ = stamp;
  came_ = now.now;
  return StampVerdict::fits;
}

void StreamClock::step_to(std::int64_t offset) {
  *newest_ += offset - offset_;
  offset_ = offset;
  misfits_.clear();
  ++steps_;
}

/// Whether this one, and those before it that did not fit either, come as evenly as they are stamped: what waited
/// somewhere and comes at once does not.
bool StreamClock::comes_as_stamped(const Stamped& message) {
  if (!misfits_.empty() && message.stamp <= misfits_.back().stamp) misfits_.clear();
  misfits_.push_back(message);
  while (misfits_.size() > step_messages && seconds(message.stamp - misfits_[1].stamp) >= step_span)
    misfits_.pop_front();
  const double span = seconds(message.stamp - misfits_.front().stamp);
  return misfits_.size() >= step_messages && span >= step_span &&
         std::abs(message.age - misfits_.front().age) < 0.5 * span;
}

}  // namespace spring_workbench::motion
