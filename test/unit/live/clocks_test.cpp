#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "spring_workbench/live/simulation_runner.h"
#include "spring_workbench/motion/stream_clock.h"
#include "support/bench_scenes.h"
#include "support/snapshots.h"

namespace spring_workbench::live::clocks_test {
namespace {

std::int64_t stamp_of(const SimulationRunner& runner) { return runner.committed(always)->at.stamp; }

constexpr std::int64_t wall_begin = 1'700'000'000'000'000'000;
constexpr double interval = 0.008;  // [s] between samples

const Vector3d grip(0.0, 0.0, 0.22);  // handle: the tip is in the box

scene::Scene one_box() {
  const Vector3d size(0.1, 0.06, 0.04);
  return scene_of({box("box", size, 1.0, Vector3d(0.0, 0.0, 0.02))}, scene::ContactMode::none);
}

std::int64_t nanoseconds(double s) { return std::llround(1e9 * s); }

simulation::SimulationSettings settings(bool massless) {
  simulation::SimulationSettings result;
  result.massless = massless;
  return result;
}

/// A hand whose sender and host have their own clocks, which can be set.
class Session {
 public:
  /// The hand grasps the box and carries it off, so that a scene that began again would show; `holds`: or lets go
  /// (of a box without mass, which stays where it is released).
  explicit Session(bool holds) : runner_(one_box(), settings(!holds), {}, false) {
    run(0.5);
    for (int k = 0; k < 50; ++k) {
      carried_ += Vector3d(0.002, 0.0, 0.001);
      run(interval);
    }
    releases_ = !holds;
    run(1.5);
  }

  /// Samples for so long; `report_arrival`: whether this process looks at them before the end.
  void run(double seconds, bool report_arrival = true) {
    for (const double end = t_ + seconds; t_ < end - 1e-9;) {
      t_ += interval;
      send();
      if (report_arrival) cycle();
    }
    if (!report_arrival) cycle();
  }
  void set_clocks(double host, double sender) {
    host_set_ += host;
    sender_set_ += sender;
  }
  /// Suspends the machine: the wall clock advances, the steady clock does not.
  void suspend(double seconds) { set_clocks(seconds, seconds); }
  /// Stops this process while the hand continues.
  void stop(double seconds) { run(seconds, false); }

  /// Sends two samples with stamps off by `ahead` [s] among correct ones.
  void send_odd(double ahead) {
    for (int k = 0; k < 2; ++k) {
      run(interval);
      set_clocks(0.0, ahead);
      send();
      set_clocks(0.0, -ahead);
      cycle();
    }
  }
  /// Moves the tracker's frame from now on.
  void move_tracker(const Vector3d& p) { X_WP_.translation() = p; }
  /// Largest force on the handle since the last call [N].
  double strongest() { return std::exchange(strongest_, 0.0); }
  HandStatistics statistics() const { return runner_.hand_statistics(0); }

  RigidTransform box() const {
    return runner_.locked([](const auto& s) { return s.objects()[0].X_WO; });
  }
  bool held() const {
    return runner_.locked([](const auto& s) { return s.objects()[0].held; });
  }
  Vector3d hand() const {
    return runner_.locked([](const auto& s) { return s.tool().X_WH.translation(); });
  }
  double time_skipped = 0.0, stepped = 0.0;
  Vector3d true_hand() const {
    return grip + carried_ + moves * Vector3d(0.1 * std::sin(3.0 * t_), 0.0, 0.05 * std::sin(5.0 * t_));
  }
  /// Stamp of the committed time minus that of the newest sample, by the host's clock [s].
  double stamp_lag() {
    const motion::WallMoment now = host();
    return 1e-9 * static_cast<double>(now.now - stamp_of(runner_));
  }
  double moves = 0.0;  ///< 1: the hand moves

 private:
  motion::WallMoment host() {
    return wall_.read(wall_begin + nanoseconds(t_) + nanoseconds(host_set_), nanoseconds(t_));
  }
  void send() {
    const std::int64_t stamp = wall_begin + nanoseconds(t_ - 0.002) + nanoseconds(sender_set_);
    waiting_.push_back({stamp, true_hand()});
  }
  void cycle() {
    HandEvents events;
    const hand_input::LocalTime arrival{t_, running_ += 0.008};
    for (const auto& [stamp, p] : waiting_) {
      const std::size_t before = stream_.clock().steps();
      const motion::WallMoment now = host();
      stream_.offer(
          p, stamp, now,
          [&](const Vector3d& at, std::int64_t local, double age) {
            if (zero_ == 0) events[0].push_back(NewEpoch{zero_ = local});
            StylusPose pose;
            pose.sample = {1e-9 * static_cast<double>(local - zero_), at, Quaterniond(pointing_down(at).linear())};
            pose.arrival = arrival;
            pose.age = age;
            pose.X_WP = X_WP_;
            if (!pressed_) events[0].push_back(StylusButton{pose.sample.t, motion::ButtonEdge::grasp});
            pressed_ = true;
            if (std::exchange(releases_, false))
              events[0].push_back(StylusButton{pose.sample.t, motion::ButtonEdge::release});
            events[0].push_back(pose);
          },
          [](const auto&...) {});
      stepped += static_cast<double>(stream_.clock().steps() - before);
    }
    waiting_.clear();
    CycleReport report = runner_.cycle(events, arrival);
    time_skipped += report.time_skipped;
    while (report.more) report = runner_.cycle({}, arrival);
    const double force = runner_.locked([](const auto& s) { return s.tool().handle_wrench_H.force.norm(); });
    strongest_ = std::max(strongest_, force);
    runner_.show(0.0, arrival, always);
  }

  SimulationRunner runner_;
  motion::WallClock wall_;
  motion::StampedStream<Vector3d> stream_{1.0};
  std::vector<std::pair<std::int64_t, Vector3d>> waiting_;
  bool pressed_ = false, releases_ = false;
  Vector3d carried_ = Vector3d::Zero();
  double t_ = 0.0, running_ = 0.0, host_set_ = 0.0, sender_set_ = 0.0;
  double strongest_ = 0.0;
  std::int64_t zero_ = 0;
  RigidTransform X_WP_ = RigidTransform::Identity();
};

struct Fault {
  const char* name;
  double host, sender;  ///< [s] by which the clocks are set
};

std::vector<Fault> faults() {
  std::vector<Fault> all;
  for (const double by : {0.3, -0.3, 3.0, -3.0, 3600.0, -3600.0}) {
    all.push_back({"both", by, by});
    all.push_back({"host", by, 0.0});
    all.push_back({"sender", 0.0, by});
  }
  for (const double asleep : {7.0, 60.0}) all.push_back({"suspend", asleep, asleep});
  return all;
}

/// Compared with a session without the fault, the hand never deviates.
TEST(Clocks, AStepIsAnOffsetAndNothingMovesForIt) {
  for (const Fault& fault : faults()) {
    for (const bool holds : {true, false}) {
      Session plain(holds), faulty(holds);
      for (Session* session : {&plain, &faulty}) {
        session->run(0.5);
        session->moves = 0.2;
        session->run(1.0);
      }
      faulty.set_clocks(fault.host, fault.sender);
      double farthest = 0.0, lag = 0.0;
      for (int k = 0; k < 250; ++k) {
        plain.run(interval);
        faulty.run(interval);
        if (k > 60) lag = std::max(lag, std::abs(faulty.stamp_lag()));  // tracked again after half a second
        if (k > 60) farthest = std::max(farthest, (plain.box().translation() - faulty.box().translation()).norm());
      }
      EXPECT_LT(farthest, 1e-3) << fault.name << fault.host << fault.sender;
      EXPECT_LT(lag, 0.05) << fault.name << fault.host << fault.sender;
      EXPECT_EQ(plain.held(), holds);
      EXPECT_EQ(faulty.held(), holds);
      EXPECT_EQ(faulty.time_skipped, 0.0);
      EXPECT_EQ(faulty.stepped, fault.sender != 0.0 ? 1.0 : 0.0);
    }
  }
}

/// A step of a clock never moves the box of a resting hand.
TEST(Clocks, AtRestNothingMovesEver) {
  for (const Fault& fault : faults()) {
    Session session(true);
    session.run(3.0);
    const RigidTransform before = session.box();
    session.set_clocks(fault.host, fault.sender);
    for (int k = 0; k < 100; ++k) {
      session.run(interval);
      ASSERT_LT((session.box().translation() - before.translation()).norm(), 1e-6) << fault.name << fault.host;
    }
  }
}

TEST(Clocks, ATimeJumpIsSkippedAndNothingMoves) {
  for (const double stopped : {0.4, 3.0, 7.0, 60.0}) {
    for (const bool holds : {true, false}) {
      Session session(holds);
      session.run(3.0);
      const RigidTransform before = session.box();
      session.stop(stopped);
      for (int k = 0; k < 100; ++k) {
        session.run(interval);
        ASSERT_LT((session.box().translation() - before.translation()).norm(), 1e-3) << stopped;
      }
      EXPECT_EQ(session.held(), holds);
      EXPECT_EQ(session.time_skipped > 0.0, stopped > 6.0) << stopped;
      EXPECT_EQ(session.stepped, 0.0);
      EXPECT_LT(std::abs(session.stamp_lag()), 0.05);
      // The hand is followed again, at a bounded speed if it was lost for long.
      session.moves = 1.0;
      session.run(2.0);
      EXPECT_LT((session.hand() - session.true_hand()).norm(), 0.02);
    }
  }
}

TEST(Senders, AStampThatIsOffMovesNothing) {
  for (const double ahead : {0.9, 0.2, -0.2, -5.0, 3600.0}) {
    Session session(true);
    session.run(3.0);
    const RigidTransform before = session.box();
    session.send_odd(ahead);
    EXPECT_LT(std::abs(session.stamp_lag()), 0.05) << ahead;
    session.run(0.5);
    EXPECT_LT((session.box().translation() - before.translation()).norm(), 1e-6);
    EXPECT_EQ(session.stepped + session.time_skipped, 0.0);
    EXPECT_LT(std::abs(session.stamp_lag()), 0.05) << ahead;
  }
}

/// Moved by half a metre, reported late or repeatedly while the box is held: the hand follows at a bounded speed.
TEST(Senders, ATrackerThatIsMovedPullsNoHarderThanAHandThatIsFoundAgain) {
  Session session(true);
  session.run(3.0);
  const double weight = 9.81;
  session.strongest();
  session.run(0.1);
  EXPECT_NEAR(session.strongest(), weight, 0.1);
  const Vector3d before = session.hand(), by(0.5, 0.0, 0.0);
  session.move_tracker(by);
  double fastest = 0.0;
  for (int k = 0; k < 500; ++k) {
    const Vector3d p = session.hand();
    session.run(interval);
    fastest = std::max(fastest, (session.hand() - p).norm() / interval);
  }
  EXPECT_LT(fastest, 0.55);  // reacquisition_speed is 0.5 m/s
  EXPECT_LT(session.strongest(), 2.0 * weight);
  EXPECT_TRUE(session.held());
  EXPECT_LT((session.hand() - before - by).norm(), 1e-3);
  EXPECT_EQ(session.statistics().tracker_moves, 1u);
  EXPECT_EQ(session.statistics().reacquisition.reacquisitions, 1u);
}

/// After a stop of 7 s its queued samples come all at once. They are too old because of the stop, and for nothing else:
/// without it, and by more than it lasted, a sample is simply too old.
TEST(Senders, SamplesThatWaitedForAStoppedProcessAreToldApart) {
  using motion::StampResult;
  for (const double stopped : {0.0, 7.0}) {
    motion::StreamClock clock(1.0);
    const auto check = [&](double stamp, double now) {
      const double not_running = now > 1.0 ? stopped : 0.0;
      const motion::WallMoment moment{wall_begin + nanoseconds(now), 0, nanoseconds(not_running)};
      return clock.check(wall_begin + nanoseconds(stamp), moment);
    };
    for (double t = 0.0; t < 1.0; t += interval) ASSERT_EQ(check(t, t), StampResult::fits) << t;
    for (double t = 1.0; t < 6.9; t += interval)
      ASSERT_EQ(check(t, 8.0), stopped > 0.0 ? StampResult::held_up : StampResult::too_old) << t;
    EXPECT_EQ(check(7.5, 8.0), StampResult::fits);
    EXPECT_EQ(check(7.6, 9.0), StampResult::too_old);  // not because of the stop, which was before
  }
}

TEST(Senders, TheFirstIsFollowedUntilItIsSilent) {
  motion::SenderChoice choice(0.5);
  EXPECT_TRUE(choice.accepts("/a", 0.0));
  for (double t = 0.01; t < 2.0; t += 0.01) {
    EXPECT_TRUE(choice.accepts("/a", t));
    EXPECT_FALSE(choice.accepts("/b", t));
  }
  EXPECT_FALSE(choice.accepts("/b", 2.4));
  EXPECT_TRUE(choice.accepts("/b", 2.6));
  EXPECT_EQ(choice.name(), "/b");
  EXPECT_FALSE(choice.accepts("/a", 2.7));
}

}  // namespace
}  // namespace spring_workbench::live::clocks_test
