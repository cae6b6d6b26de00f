#include <ros/ros.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "spring_workbench/ObjectStates.h"
#include "spring_workbench/simulated_device/fastrak_simulator.h"

// End-to-end latency: from the first byte of a record on the serial line to the arrival of the message of
// `manipulation/objects` from which on the held object has gone as far as that record says. The device of this program
// moves the hand evenly along x, the fork is rigid, so the object's x tells which record a message knows of; no clock
// but this process' own is asked. doc/tracker.md, "Latency".

namespace {

using namespace spring_workbench;
using std::chrono::steady_clock;

constexpr double kSpeed = 0.02;      // [m/s]
constexpr double kTolerance = 1e-7;  // [m] of the floats on the line; 5 µs at kSpeed
constexpr double kSettle = 3.0;      // [s] before and after the way

struct Moment {
  double t = 0.0;  ///< [s]
  double x = 0.0;  ///< [m]
};

double now() { return std::chrono::duration<double>(steady_clock::now().time_since_epoch()).count(); }

/// Rests, goes `length` [s] along x, and rests.
PlayedMotion way(double length) {
  std::vector<StylusSample> samples(4);
  const double times[] = {0.0, kSettle, kSettle + length, kSettle + length + 1e5};
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].t = times[i];
    samples[i].X.translation() = Vector3d(0.3 + (i < 2 ? 0.0 : kSpeed * length), 0.0, 0.4);
  }
  return PlayedMotion(samples);
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
    const double t = now();
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!message->objects.empty() && message->objects[0].held)
      seen_.push_back({t, message->objects[0].pose.position.x});
  }

  mutable std::mutex mutex_;
  std::vector<Moment> seen_;
  ros::Subscriber subscriber_;
};

/// Plays the device in real time; the moments at which records of the moving hand were written.
std::vector<Moment> play(const std::string& port, double rate, double length, const Observer& observer) {
  const PlayedMotion motion = way(length);
  FastrakSimulator simulator(FastrakDevice({motion}), LineFaults(), port);
  while (ros::ok() && observer.seen().empty()) {  // the nodes start, the device is set up, the object is grasped
    simulator.measure(0.0);
    simulator.serve(0.005);
  }
  std::vector<Moment> written;
  const double start = now();
  for (long cycle = 1; ros::ok(); ++cycle) {
    const double t = static_cast<double>(cycle) / rate;
    if (t > 2.0 * kSettle + length) break;
    simulator.serve(0.0);
    std::this_thread::sleep_until(steady_clock::time_point(
        std::chrono::duration_cast<steady_clock::duration>(std::chrono::duration<double>(start + t))));
    if (t > kSettle && t < kSettle + length) written.push_back({now(), motion.at(t).X.translation().x()});
    simulator.measure(t);
  }
  return written;
}

/// From each record to the first message of those that have gone as far for good [s], in ascending order.
std::vector<double> latencies(const std::vector<Moment>& written, std::vector<Moment> seen, double last_x) {
  std::vector<double> result;
  const double offset = seen.back().x - last_x;  // of the object from the hand: both are at rest there
  for (std::size_t i = seen.size() - 1; i-- > 0;) seen[i].x = std::min(seen[i].x, seen[i + 1].x);
  std::size_t i = 0;
  for (const Moment& record : written) {
    while (i < seen.size() && seen[i].x - offset < record.x - kTolerance) ++i;
    if (i < seen.size()) result.push_back(seen[i].t - record.t);
  }
  std::sort(result.begin(), result.end());
  return result;
}

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
  const std::vector<Moment> written = play(port, rate, length, observer);
  const std::vector<double> all = latencies(written, observer.seen(), 0.3 + kSpeed * length);
  if (all.size() < 10) {
    std::cerr << "latency: only " << all.size() << " of " << written.size() << " records were seen again" << std::endl;
    return 1;
  }
  const auto at = [&](double part) {
    return 1e3 * all[static_cast<std::size_t>(part * static_cast<double>(all.size() - 1))];
  };
  std::ofstream out(parameters.param<std::string>("out", "/dev/stdout"), std::ios::app);
  out << rate << "," << physics_rate << "," << all.size() << "," << at(0.0) << "," << at(0.5) << "," << at(0.99) << ","
      << at(1.0) << std::endl;
  return 0;
}
