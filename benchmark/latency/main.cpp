#include <geometry_msgs/PointStamped.h>
#include <ros/ros.h>

#include <algorithm>
#include <array>
#include <exception>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <map>
#include <memory>
#include <mutex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "benchmark/latency/pixel_observer.h"
#include "benchmark/latency/played_device.h"
#include "spring_workbench/ForkState.h"
#include "spring_workbench/ObjectStates.h"

// End-to-end latency: from the first byte of a record on the serial line to the arrival of the first object poses that
// are computed from it, on `manipulation/objects` (committed) and on `manipulation/display/objects` (displayed). The
// device of this program moves the hands uniformly along x, so the x of the handle in the message of the same stamp on
// the topic `fork` identifies the newest record in a message; only the clock of this process is used. For comparison,
// the round trip of a message of the same rate to a node that only sends it back is measured. With ~pixel, the fork is
// rigid and the object a ruler, which rviz shows from above on the X display of this process; a thread reads the
// pixels. See doc/tracker.md, "Latency".

namespace {

using namespace spring_workbench;
using namespace spring_workbench::benchmark;

constexpr double kSpeed = 0.02;    // [m/s]
constexpr double kSettle = 3.0;    // [s] before and after the motion
constexpr double kTimeout = 60.0;  // [s] limit until rviz shows the object

/// A motion that rests, moves along x for `length` [s], and rests.
simulated_fastrak::PlayedMotion travel(double length) {
  std::vector<motion::StylusSample> samples(4);
  const double times[] = {0.0, kSettle, kSettle + length, kSettle + length + 1e5};
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].t = times[i];
    samples[i].X.translation() = Vector3d(0.3 + (i < 2 ? 0.0 : kSpeed * length), 0.0, 0.4);
  }
  return simulated_fastrak::PlayedMotion(samples);
}

/// Arrival times of object poses, and the positions of the handles from which these were computed.
class Observer {
 public:
  /// `prefix`: of the topics `objects`, `fork` and `fork_2`.
  Observer(ros::NodeHandle& node, const std::string& prefix) {
    const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
    subscribers_.push_back(node.subscribe(prefix + "objects", 10000, &Observer::take_objects, this, hints));
    for (const int hand : {1, 2}) {
      const boost::function<void(const ForkState::ConstPtr&)> take = [this, hand](const ForkState::ConstPtr& fork) {
        take_fork(hand, *fork);
      };
      const std::string topic = prefix + (hand == 1 ? "fork" : "fork_2");
      subscribers_.push_back(node.subscribe<ForkState>(topic, 10000, take, {}, hints));
    }
  }
  /// The hand, 1 or 2, that holds the object; 0: none yet.
  int holder() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return holder_;
  }
  /// The handle's x at the arrival of the poses with the same stamp.
  std::vector<Moment> observed(int hand) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::vector<Moment> moments;
    for (const auto& [stamp, x] : handles_.at(static_cast<std::size_t>(hand - 1))) {
      const auto arrival = arrivals_.find(stamp);
      if (arrival != arrivals_.end()) moments.push_back({arrival->second, x});
    }
    return moments;
  }

 private:
  void take_objects(const ObjectStates::ConstPtr& message) {
    const double t = steady_now();
    const std::lock_guard<std::mutex> lock(mutex_);
    arrivals_.emplace(message->header.stamp, t);
  }
  void take_fork(int hand, const ForkState& fork) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (fork.held_object.empty()) return;
    holder_ = hand;
    handles_.at(static_cast<std::size_t>(hand - 1)).emplace_back(fork.header.stamp, fork.handle.position.x);
  }

  mutable std::mutex mutex_;
  int holder_ = 0;
  std::map<ros::Time, double> arrivals_;  ///< of the first poses with a stamp [s]
  std::array<std::vector<std::pair<ros::Time, double>>, 2> handles_;
  std::vector<ros::Subscriber> subscribers_;
};

/// Messages to a relay and back: two connections, like those from tracker_driver through manipulation to the observer.
class BareLoop {
 public:
  BareLoop(ros::NodeHandle& node, double rate)
      : publisher_(node.advertise<geometry_msgs::PointStamped>("bare", 100)),
        subscriber_(node.subscribe("bare_relay", 10000, &BareLoop::take, this, ros::TransportHints().tcpNoDelay())),
        timer_(node.createSteadyTimer(ros::WallDuration(1.0 / rate), &BareLoop::send, this)) {}
  std::vector<double> latencies() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::vector<double> sorted = latencies_;
    std::sort(sorted.begin(), sorted.end());
    return sorted;
  }

 private:
  void send(const ros::SteadyTimerEvent&) {
    geometry_msgs::PointStamped message;
    message.point.x = steady_now();
    publisher_.publish(message);
  }
  void take(const geometry_msgs::PointStamped::ConstPtr& message) {
    const double t = steady_now();
    const std::lock_guard<std::mutex> lock(mutex_);
    latencies_.push_back(t - message->point.x);
  }

  mutable std::mutex mutex_;
  std::vector<double> latencies_;
  ros::Publisher publisher_;
  ros::Subscriber subscriber_;
  ros::SteadyTimer timer_;
};

/// Sends back what BareLoop sends.
void relay(ros::NodeHandle& node) {
  const ros::Publisher publisher = node.advertise<geometry_msgs::PointStamped>("bare_relay", 100);
  const boost::function<void(const geometry_msgs::PointStamped::ConstPtr&)> pass =
      [&](const geometry_msgs::PointStamped::ConstPtr& message) { publisher.publish(message); };
  const ros::Subscriber subscriber =
      node.subscribe<geometry_msgs::PointStamped>("bare", 100, pass, {}, ros::TransportHints().tcpNoDelay());
  ros::spin();
}

void add_row(std::ostream& out, const std::string& run, const std::string& end, const std::vector<double>& all) {
  out << run << "," << end << "," << all.size() << std::fixed << std::setprecision(2);
  for (const double part : {0.0, 0.5, 0.99, 1.0}) out << "," << 1e3 * quantile(all, part);
  out << std::endl;
}

/// Latencies from the records to their observations. Throws std::runtime_error if these did not move with the hand.
std::vector<double> latencies_of(const std::vector<Moment>& written, const std::vector<Moment>& observed,
                                 double length) {
  const double travel = kSpeed * length;  // [m]
  if (observed.empty() || observed.back().x - observed.front().x < 0.9 * travel)
    throw std::runtime_error("the observed object did not move with the hand");
  return latencies(written, observed, observed.back().x - (0.3 + travel));  // at the end everything is at rest
}

/// Rows on what rviz showed: latency, records whose pose was never shown, time between two frames; or that the ruler
/// was lost.
void add_pixels(std::ostream& out, const std::string& run, const std::vector<Moment>& written,
                const std::vector<Moment>& observed, double length) {
  try {
    const std::vector<double> shown = latencies_of(written, observed, length);
    add_row(out, run, "pixel", shown);
    out << run << ",never shown," << written.size() - shown.size() << ",,,," << std::endl;
    std::vector<double> between;
    for (std::size_t i = 1; i < observed.size(); ++i) {
      if (observed[i - 1].t > written.front().t && observed[i].t < written.back().t)
        between.push_back(observed[i].t - observed[i - 1].t);
    }
    std::sort(between.begin(), between.end());
    add_row(out, run, "between pictures", between);
  } catch (const std::exception& error) {
    std::cerr << "latency: pixel: " << error.what() << std::endl;
    out << run << ",pixel,0,lost,lost,lost,lost" << std::endl;
  }
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "latency");
  ros::NodeHandle node, parameters("~");
  if (parameters.param("relay", false)) {
    relay(node);
    return 0;
  }
  const std::string port = parameters.param<std::string>("port", "/tmp/spring_workbench_latency");
  const double rate = parameters.param("rate", 120.0), length = parameters.param("length", 10.0);
  const int hands = parameters.param("hands", 1), stations = parameters.param("stations", 1);
  ros::AsyncSpinner spinner(1);
  spinner.start();
  const Observer committed(node, "manipulation/"), displayed(node, "manipulation/display/");
  const BareLoop bare(node, rate);
  const simulated_fastrak::PlayedMotion motion = travel(length);
  const std::vector<simulated_fastrak::PlayedMotion> motions(static_cast<std::size_t>(stations), motion);
  simulated_fastrak::FastrakSimulator simulator(simulated_fastrak::FastrakDevice(motions, {1, 2}),
                                                simulated_fastrak::LineFaults(), port);
  Playing playing{rate, stations, 1, kSettle, kSettle + length, 2.0 * kSettle + length};
  const double latest = steady_now() + kTimeout;
  try {
    const auto pixels = parameters.param("pixel", false) ? std::make_unique<PixelObserver>(Ruler()) : nullptr;
    const auto held = [&] {
      const int holder = committed.holder();  // the hand that is there first
      if (holder > 0) playing.counted = holder;
      const bool shown = !pixels || !pixels->observed().empty() || steady_now() > latest;
      return !ros::ok() || (shown && holder > 0 && displayed.holder() == holder);
    };
    const std::vector<Moment> written = play(simulator, motion, playing, held);
    std::ofstream out(parameters.param<std::string>("out", "/dev/stdout"), std::ios::app);
    std::ostringstream run;
    run << rate << "," << hands << "," << stations;
    add_row(out, run.str(), "bare loop", bare.latencies());
    if (!pixels)
      add_row(out, run.str(), "committed", latencies_of(written, committed.observed(playing.counted), length));
    add_row(out, run.str(), "displayed", latencies_of(written, displayed.observed(playing.counted), length));
    if (pixels) add_pixels(out, run.str(), written, pixels->observed(), length);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "latency: " << error.what() << std::endl;
    return 1;
  }
}
