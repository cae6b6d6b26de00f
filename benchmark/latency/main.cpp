#include <ros/ros.h>

#include <exception>
#include <fstream>
#include <iostream>
#include <mutex>
#include <string>
#include <vector>

#include "benchmark/latency/played_device.h"
#include "spring_workbench/ObjectStates.h"

// End-to-end latency: from the first byte of a record on the serial line to the arrival of the message of
// `manipulation/objects` from which on the held object has gone as far as that record says. The device of this program
// moves the hand evenly along x, the fork is rigid, so the object's x tells which record a message knows of; no clock
// but this process' own is asked. doc/tracker.md, "Latency".

namespace {

using namespace spring_workbench;
using namespace spring_workbench::benchmark;

constexpr double kSpeed = 0.02;  // [m/s]
constexpr double kSettle = 3.0;  // [s] before and after the way

/// Rests, goes `length` [s] along x, and rests.
fastrak::PlayedMotion way(double length) {
  std::vector<motion::StylusSample> samples(4);
  const double times[] = {0.0, kSettle, kSettle + length, kSettle + length + 1e5};
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].t = times[i];
    samples[i].X.translation() = Vector3d(0.3 + (i < 2 ? 0.0 : kSpeed * length), 0.0, 0.4);
  }
  return fastrak::PlayedMotion(samples);
}

/// When and where the object was seen.
class Observer {
 public:
  explicit Observer(ros::NodeHandle& node)
      : subscriber_(
            node.subscribe("manipulation/objects", 10000, &Observer::take, this, ros::TransportHints().tcpNoDelay())) {}
  std::vector<Moment> seen() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return seen_;
  }

 private:
  void take(const ObjectStates::ConstPtr& message) {
    const double t = steady_now();
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!message->objects.empty() && message->objects[0].held)
      seen_.push_back({t, message->objects[0].pose.position.x});
  }

  mutable std::mutex mutex_;
  std::vector<Moment> seen_;
  ros::Subscriber subscriber_;
};

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "latency");
  ros::NodeHandle node, parameters("~");
  const std::string port = parameters.param<std::string>("port", "/tmp/spring_workbench_latency");
  const double rate = parameters.param("rate", 120.0), length = parameters.param("length", 10.0);
  double physics_rate = 0.0;
  node.getParam("manipulation/rate", physics_rate);
  ros::AsyncSpinner spinner(1);
  spinner.start();
  const Observer observer(node);
  const fastrak::PlayedMotion motion = way(length);
  fastrak::FastrakSimulator simulator(fastrak::FastrakDevice({motion}), fastrak::LineFaults(), port);
  const auto held = [&] { return !ros::ok() || !observer.seen().empty(); };
  try {
    const std::vector<Moment> written =
        play(simulator, motion, {rate, kSettle, kSettle + length, 2.0 * kSettle + length}, held);
    const std::vector<Moment> seen = observer.seen();
    const double offset = seen.empty() ? 0.0 : seen.back().x - (0.3 + kSpeed * length);  // in the end both are at rest
    const std::vector<double> all = latencies(written, seen, offset);
    std::ofstream out(parameters.param<std::string>("out", "/dev/stdout"), std::ios::app);
    out << rate << "," << physics_rate << "," << all.size();
    for (const double part : {0.0, 0.5, 0.99, 1.0}) out << "," << 1e3 * quantile(all, part);
    out << std::endl;
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "latency: " << error.what() << std::endl;
    return 1;
  }
}
