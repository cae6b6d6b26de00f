#include "spring_workbench/motion/stream_clock.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "constants.h"

namespace spring_workbench::motion {
namespace {

double seconds(std::int64_t nanoseconds) { return 1e-9 * static_cast<double>(nanoseconds); }

}  // namespace

std::string to_string(StampResult result) {
  static const char* const names[] = {"fits", "stepped", "too old", "held up", "from the future", "stamp not later"};
  return names[static_cast<std::size_t>(result)];
}

std::string complaint(StampResult result, double age, double max_age) {
  std::ostringstream text;
  text << "stamp: ";
  if (result == StampResult::too_old) {
    text << age << " s old, more than max_age = " << max_age
         << " s (does a bag play without --clock and use_sim_time, or do the clocks of two hosts differ?)";
  } else if (result == StampResult::from_the_future && -age > max_age) {
    text << -age << " s ahead of now, more than max_age = " << max_age << " s (do the clocks of two hosts differ?)";
  } else if (result == StampResult::from_the_future) {
    text << "ahead of the others of its stream by more than " << clock_slip << " s (was the sender's clock set?)";
  } else {
    text << "before the newest of its stream by more than " << clock_slip << " s (is it sent out of order?)";
  }
  return text.str();
}

WallMoment WallClock::read(std::int64_t wall, std::int64_t steady) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::int64_t apart = wall - steady, moved = apart - offset_.value_or(apart);
  if (std::abs(seconds(moved)) > clock_slip) steps_ += moved;
  offset_ = apart;
  return {wall - steps_, steps_};
}

StampResult StreamClock::check(std::int64_t stamp, const WallMoment& now) {
  if (!newest_) return begin(stamp, now);
  if (now.steps != stepped_.steps && now.now > stepped_.now) stepped_ = now;
  const double own_age = age(stamp, now), as_this_host = seconds(now.now - stamp + now.steps);
  const double off = std::abs(own_age - smallest_age_);
  if (off > clock_slip && std::abs(as_this_host - smallest_age_) < off) {
    step_to(now.steps);
    return StampResult::stepped;
  }
  StampResult result = StampResult::fits;
  if (own_age > max_age_) {
    const bool held_up = own_age - seconds(now.not_running - not_running_) <= max_age_;
    result = held_up ? StampResult::held_up : StampResult::too_old;
  }
  if (own_age < smallest_age_ - clock_slip) result = StampResult::from_the_future;
  if (seconds(*newest_ - stamp) > clock_slip) result = StampResult::not_later;
  if (result != StampResult::fits) {
    if (!arrives_evenly({stamp, own_age})) return result;
    const auto younger = [](const Stamped& a, const Stamped& b) { return a.age < b.age; };
    const double least = std::min_element(unmatched_.begin(), unmatched_.end(), younger)->age;
    step_to(offset_ + std::llround(1e9 * (smallest_age_ - least)));
    return StampResult::stepped;
  }
  if (seconds(local(stamp) - stepped_.now) > clock_slip)
    host_steps_ += seconds(stepped_.steps - std::exchange(followed_, stepped_.steps));
  smallest_age_ = std::min(own_age, smallest_age_ + clock_drift * seconds(now.now - arrival_));
  newest_ = std::max(*newest_, stamp);
  arrival_ = now.now;
  not_running_ = now.not_running;
  unmatched_.clear();
  return result;
}

std::int64_t StreamClock::local_or_now(std::int64_t stamp, const WallMoment& now) {
  StampResult result = check(stamp, now);
  if (result == StampResult::stepped) result = check(stamp, now);
  return result == StampResult::fits ? local(stamp) : now.now;
}

StampResult StreamClock::begin(std::int64_t stamp, const WallMoment& now) {
  offset_ = now.steps;
  const double first_age = age(stamp, now);
  if (first_age > max_age_) return StampResult::too_old;
  if (first_age < -max_age_) return StampResult::from_the_future;
  stepped_ = now;
  followed_ = now.steps;
  smallest_age_ = first_age;
  newest_ = stamp;
  arrival_ = now.now;
  not_running_ = now.not_running;
  return StampResult::fits;
}

void StreamClock::step_to(std::int64_t offset) {
  *newest_ += offset - offset_;
  offset_ = offset;
  followed_ = stepped_.steps;
  unmatched_.clear();
  ++steps_;
}

/// Returns whether this message and the preceding rejected ones arrived as evenly as they are stamped. Messages that
/// waited in a queue and arrive all at once did not.
bool StreamClock::arrives_evenly(const Stamped& message) {
  if (!unmatched_.empty() && message.stamp <= unmatched_.back().stamp) unmatched_.clear();
  unmatched_.push_back(message);
  while (unmatched_.size() > step_messages && seconds(message.stamp - unmatched_[1].stamp) >= step_span)
    unmatched_.pop_front();
  const double span = seconds(message.stamp - unmatched_.front().stamp);
  return unmatched_.size() >= step_messages && span >= step_span &&
         std::abs(message.age - unmatched_.front().age) < 0.5 * span;
}

}  // namespace spring_workbench::motion
