#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

namespace spring_workbench::motion {

/// A moment by the local wall clock [ns since 1970].
struct WallMoment {
  std::int64_t now = 0;          ///< time without steps, as if the clock had never been set
  std::int64_t steps = 0;        ///< total of the steps by which it has been set: the clock shows `now + steps`
  std::int64_t not_running = 0;  ///< total of the times in which this process did not run [ns]
};

/// Removes the steps from a wall clock. A change relative to the steady clock by more than 0.1 s between two readings
/// is a step (the clock was set, or the machine was suspended); smaller changes are followed. Thread-safe.
class WallClock {
 public:
  /// Converts a reading of the wall clock, `wall`, made together with one of the steady clock, `steady` [ns].
  WallMoment read(std::int64_t wall, std::int64_t steady);

 private:
  std::mutex mutex_;
  std::optional<std::int64_t> offset_;  ///< wall less steady at the last reading [ns]
  std::int64_t steps_ = 0;
};

/// Result of checking a message's stamp by a StreamClock.
enum class StampResult {
  fits,
  stepped,          ///< the sender's clock was set: check the preceding rejected messages and this one again
  too_old,          ///< by more than `max_age`
  held_up,          ///< too old only because this process has not run since the newest message that fitted
  from_the_future,  ///< ahead of the stream by more than 0.1 s
  not_later,        ///< more than 0.1 s before the newest stamp of the stream
};
/// The result in words, as in /diagnostics.
std::string to_string(StampResult result);

/// What is wrong with a stamp that is `age` [s] old and was rejected with this result.
std::string complaint(StampResult result, double age, double max_age);

/// The clock of one stream of stamped messages: tracks the offset between the sender's clock and the local wall clock
/// (without the steps of the latter). Slow drift is followed. After a step of the sender's clock the offset is
/// replaced: at once if this host's own clock made the same step; otherwise once at least three messages that span 0.05
/// s of stamps have arrived as evenly as they are stamped. A single message never changes the offset.
class StreamClock {
 public:
  /// `max_age` [s], > 0: the first message must be no further from now, and no message older.
  explicit StreamClock(double max_age) : max_age_(max_age) {}

  /// Checks the stamp [ns] of a message that arrived at `now`.
  StampResult check(std::int64_t stamp, const WallMoment& now);
  /// Returns the local time [ns] of a message that is used in any case: that of its stamp if it fits, otherwise now.
  std::int64_t local_or_now(std::int64_t stamp, const WallMoment& now);
  /// The stamp by the local wall clock without its steps [ns].
  std::int64_t local(std::int64_t stamp) const { return stamp - offset_; }
  /// Age at `now` of a message with this stamp [s].
  double age(std::int64_t stamp, const WallMoment& now) const {
    return 1e-9 * static_cast<double>(now.now - local(stamp));
  }
  /// Returns whether a message has fitted yet.
  bool has_begun() const { return newest_.has_value(); }
  /// Steps of the sender's clock so far.
  std::size_t steps() const { return steps_; }
  /// Returns the steps of this host's clock that the sender's has not followed [s], since the last call. They are known
  /// from the first fitting message that was stamped more than 0.1 s after the step: earlier ones may have been under
  /// way when both clocks were set.
  double take_host_steps() { return std::exchange(host_steps_, 0.0); }

 private:
  struct Stamped {
    std::int64_t stamp;
    double age;
  };
  StampResult begin(std::int64_t stamp, const WallMoment& now);
  void step_to(std::int64_t offset);
  bool arrives_evenly(const Stamped& message);

  double max_age_;
  std::int64_t offset_ = 0;             ///< stamps minus local times [ns]
  std::optional<std::int64_t> newest_;  ///< stamp
  std::int64_t arrival_ = 0;            ///< arrival of that message [ns]
  std::int64_t not_running_ = 0;        ///< WallMoment::not_running then [ns]
  double smallest_age_ = 0.0;           ///< smallest recent age, increasing at clock_drift [s]
  std::deque<Stamped> unmatched_;       ///< messages that did not fit since the newest one that did
  std::size_t steps_ = 0;
  WallMoment stepped_;         ///< this host's clock when its newest step was noticed
  std::int64_t followed_ = 0;  ///< steps of this host's clock that were reported, or made by the sender's, too [ns]
  double host_steps_ = 0.0;    ///< see take_host_steps
};

/// Selects one of several senders of a stream: the first one, until it has been silent for `silence_timeout` [s].
class SenderChoice {
 public:
  explicit SenderChoice(double silence_timeout) : silence_timeout_(silence_timeout) {}
  /// Whether to use a message from this sender that arrived at local time `now` [s].
  bool accepts(const std::string& sender, double now) {
    if (sender != name_ && !name_.empty() && now - arrival_ <= silence_timeout_) return false;
    name_ = sender;
    arrival_ = now;
    return true;
  }
  /// The selected sender; empty before the first message.
  const std::string& name() const { return name_; }
  void forget() { name_.clear(); }

 private:
  double silence_timeout_;
  std::string name_;
  double arrival_ = 0.0;
};

/// A stream of stamped messages with its StreamClock. Messages that do not fit are kept for a while, and are used after
/// all if the sender's clock turns out to have been set.
template <typename Message>
class StampedStream {
 public:
  explicit StampedStream(double max_age) : clock_(max_age), max_age_(max_age) {}

  /// Takes a message with this stamp [ns] that arrived at `now`. Calls `use(message, local stamp [ns], age [s])` for
  /// each that fits now, in order, and `reject(message, result, age [s])` for each that will not.
  template <typename Use, typename Reject>
  void offer(const Message& message, std::int64_t stamp, const WallMoment& now, Use&& use, Reject&& reject) {
    StampResult result = clock_.check(stamp, now);
    const auto reject_kept = [&](const Kept& kept) { reject(kept.message, kept.result, kept.age); };
    if (result == StampResult::stepped) {
      for (Kept& kept : std::exchange(kept_, {})) {
        kept.result = clock_.check(kept.stamp, kept.arrival);
        if (kept.result != StampResult::fits) {
          reject_kept(kept);
        } else {
          use(kept.message, clock_.local(kept.stamp), clock_.age(kept.stamp, kept.arrival));
        }
      }
      result = clock_.check(stamp, now);
    }
    if (result != StampResult::fits) {
      kept_.push_back({message, stamp, now, result, clock_.age(stamp, now)});
      if (kept_.size() <= max_kept && clock_.has_begun()) return;
      reject_kept(kept_.front());
      return kept_.pop_front();
    }
    for (const Kept& kept : std::exchange(kept_, {})) reject_kept(kept);
    use(message, clock_.local(stamp), clock_.age(stamp, now));
  }
  /// Restarts for another sender, whose clock is not known.
  void restart() {
    clock_ = StreamClock(max_age_);
    kept_.clear();
  }
  const StreamClock& clock() const { return clock_; }
  double take_host_steps() { return clock_.take_host_steps(); }  ///< see StreamClock

 private:
  static constexpr std::size_t max_kept = 16;
  struct Kept {
    Message message;
    std::int64_t stamp = 0;
    WallMoment arrival;
    StampResult result = StampResult::fits;
    double age = 0.0;
  };
  StreamClock clock_;
  double max_age_;
  std::deque<Kept> kept_;
};

}  // namespace spring_workbench::motion
