#include <ros/ros.h>
#include <topic_tools/shape_shifter.h>
#include <unistd.h>

#include <algorithm>
#include <exception>
#include <fstream>
#include <iostream>
#include <iterator>
#include <mutex>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "benchmark/latency/played_device.h"
#include "spring_workbench/ForkState.h"
#include "spring_workbench/StepReport.h"
#include "spring_workbench/scene/scene.h"

// Cost of the running nodes: one or two hands, driven by a simulated device, each grasp an object of the scene, press
// it down and push it along x. doc/load.md describes what is measured.

namespace {

using namespace spring_workbench;
using namespace spring_workbench::benchmark;

constexpr double kSpeed = 0.01;                    // [m/s] along x
constexpr double kReach = 0.2;                     // [m] reach of the fork from the handle to the tip
constexpr double kAbove = 0.15, kPressed = 0.005;  // [m]
constexpr double kBetween = 0.1;                   // [s] between two readings of the processor time
constexpr double kDown = 1.0, kGrasp = 1.5, kBegin = 2.5, kEnd = 2.0;  // [s]

/// A motion that lowers the tip into an object, grasps it, presses, moves along x at constant speed, and rests.
simulated_fastrak::PlayedMotion work_at(const Vector3d& object, double length) {
  std::vector<motion::StylusSample> samples;
  const auto add = [&](double t, double x, double height, bool button) {
    motion::StylusSample sample;
    sample.t = t;
    sample.X = make_transform(object + Vector3d(x, 0.0, kReach + height), Quaterniond(0.0, 1.0, 0.0, 0.0));
    sample.button = button;
    samples.push_back(sample);
  };
  add(0.0, 0.0, kAbove, false);
  add(kDown, 0.0, 0.0, false);
  add(kGrasp, 0.0, 0.0, true);
  add(kBegin - 0.2, 0.0, -kPressed, true);
  add(kBegin, 0.0, -kPressed, true);
  add(kBegin + length, kSpeed * length, -kPressed, true);
  add(kBegin + length + 1e5, kSpeed * length, -kPressed, true);
  return simulated_fastrak::PlayedMotion(samples);
}

/// Data on a process from /proc.
struct Process {
  explicit Process(int pid) : folder("/proc/" + std::to_string(pid) + "/") {}
  /// Time since its start [s].
  double age() const {
    std::ifstream up("/proc/uptime");
    double uptime = 0.0;
    up >> uptime;
    return uptime - ticks(kStart) / static_cast<double>(sysconf(_SC_CLK_TCK));
  }
  /// Processor time of all threads [s].
  double processor_time() const { return (ticks(kUser) + ticks(kSystem)) / static_cast<double>(sysconf(_SC_CLK_TCK)); }
  /// Resident memory [MB].
  double memory() const {
    std::ifstream file(folder + "statm");
    double total = 0.0, resident = 0.0;
    file >> total >> resident;
    return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
  }
  std::string folder;

 private:
  // Fields of the file `stat` after the name of the program.
  static constexpr std::size_t kUser = 11, kSystem = 12, kStart = 19;
  double ticks(std::size_t field) const {
    std::ifstream stat(folder + "stat");
    const std::string text((std::istreambuf_iterator<char>(stat)), std::istreambuf_iterator<char>());
    std::istringstream rest(text.substr(text.rfind(')') + 1));
    const std::vector<std::string> fields((std::istream_iterator<std::string>(rest)), {});
    return std::stod(fields.at(field));
  }
};

/// Subscribes to the node, including the messages for rviz and for a bag, which it does not read. Evaluates the cycles
/// in which something was held.
class Observer {
 public:
  Observer(ros::NodeHandle& node, const Process& process) : process_(process) {
    const ros::TransportHints fast = ros::TransportHints().tcpNoDelay();
    steps_ = node.subscribe("manipulation/steps", 10000, &Observer::take_steps, this, fast);
    fork_ = node.subscribe("manipulation/fork", 10000, &Observer::take_fork, this, fast);
    for (const char* topic : {"manipulation/objects", "manipulation/accepted", "manipulation/display/objects",
                              "manipulation/display/markers", "tf"}) {
      unread_.push_back(node.subscribe<topic_tools::ShapeShifter>(
          topic, 10000, [](const topic_tools::ShapeShifter::ConstPtr&) {}, nullptr, fast));
    }
  }
  template <typename Use>
  auto locked(Use&& use) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return use();
  }
  bool sees_hand() const {
    return locked([this] { return !seen.empty(); });
  }

  // Guarded by the mutex.
  std::vector<Moment> seen;           ///< of the first hand
  std::vector<double> step_times;     ///< [s] of cycles
  std::vector<double> publish_times;  ///< [s] of cycles
  double first = 0.0, until = 0.0;    ///< times of the first and last such cycle, steady clock [s]
  double processor_time = 0.0;        ///< processor time of the node between the two [s]
  std::size_t missed = 0;             ///< deadlines
  double start = 0.0;                 ///< start-up time of the node until its first report [s]
  std::set<std::string> run, named;   ///< subsystems that ran; all subsystems

 private:
  void take_steps(const StepReport::ConstPtr& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (start == 0.0) start = process_.age();
    if (!holds_ || message->steps == 0) return;
    const double now = steady_now();
    if (step_times.empty()) {
      first = now;
      processor_time_before_ = process_.processor_time();
    }
    if (now > until + kBetween) {
      until = now;
      processor_time = process_.processor_time() - processor_time_before_;
    }
    step_times.push_back(message->wall_time);
    publish_times.push_back(message->publish_time);
    missed += message->deadline_missed;
    run.insert(message->active.begin(), message->active.end());
    named.insert(message->skipped.begin(), message->skipped.end());
  }
  void take_fork(const ForkState::ConstPtr& message) {
    const double t = steady_now();
    const std::lock_guard<std::mutex> lock(mutex_);
    holds_ = !message->held_object.empty();
    seen.push_back({t, message->handle.position.x});
  }

  Process process_;
  mutable std::mutex mutex_;
  bool holds_ = false;
  double processor_time_before_ = 0.0;
  ros::Subscriber steps_, fork_;
  std::vector<ros::Subscriber> unread_;
};

std::string words(const std::set<std::string>& all, const std::set<std::string>& but = {}) {
  std::string text;
  for (const std::string& word : all) {
    if (but.count(word) == 0) text += (text.empty() ? "" : " ") + word;
  }
  return text;
}

/// Positions of the first `count` movable objects of the scene.
std::vector<Vector3d> objects_of(const scene::Scene& scene, std::size_t count) {
  std::vector<Vector3d> places;
  for (const scene::Body& body : scene.bodies) {
    if (body.movable && places.size() < count) places.push_back(body.X_WO.translation());
  }
  if (places.size() < count) throw std::runtime_error("the scene has too few objects");
  return places;
}

/// Writes start-up time [ms], memory [MB], cycles, quantiles 50, 99 and 99.9 % of their time [µs], deadlines missed, 50
/// % and 99 % quantiles and maximum of latency [ms], subsystems that ran, subsystems that did not, 99 % quantile of the
/// publishing time [µs], and processor time of the node [% of one processor].
void tell(Observer& observer, const Process& process, const std::vector<double>& all, std::ostream& out) {
  observer.locked([&] {
    std::vector<double>& steps = observer.step_times;
    if (steps.empty()) throw std::runtime_error("nothing was held");
    std::sort(steps.begin(), steps.end());
    out << 1e3 * observer.start << ',' << process.memory() << ',' << steps.size();
    for (const double part : {0.5, 0.99, 0.999}) out << ',' << 1e6 * quantile(steps, part);
    out << ',' << observer.missed;
    for (const double part : {0.5, 0.99, 1.0}) out << ',' << 1e3 * quantile(all, part);
    out << ',' << words(observer.run) << ',' << words(observer.named, observer.run);
    std::sort(observer.publish_times.begin(), observer.publish_times.end());
    out << ',' << 1e6 * quantile(observer.publish_times, 0.99) << ','
        << 100.0 * observer.processor_time / (observer.until - observer.first) << std::endl;
  });
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "load");
  ros::NodeHandle node, parameters("~");
  const std::string port = parameters.param<std::string>("port", "/tmp/spring_workbench_load");
  const int hands = parameters.param("hands", 1);
  const double rate = parameters.param("rate", 120.0), length = parameters.param("length", 15.0);
  const Process process(parameters.param("pid", 0));
  ros::AsyncSpinner spinner(1);
  spinner.start();
  Observer observer(node, process);
  try {
    const scene::Scene scene = scene::load_scene(parameters.param<std::string>("scene", ""));
    std::vector<simulated_fastrak::PlayedMotion> motions;
    for (const Vector3d& place : objects_of(scene, static_cast<std::size_t>(hands)))
      motions.push_back(work_at(place, length));
    simulated_fastrak::FastrakSimulator simulator(simulated_fastrak::FastrakDevice(motions, {1, 2}),
                                                  simulated_fastrak::LineFaults(), port);
    const Playing playing{rate, hands, 1, kBegin, kBegin + length, kBegin + length + kEnd};
    const std::vector<Moment> written =
        play(simulator, motions.front(), playing, [&] { return !ros::ok() || observer.sees_hand(); });
    const std::vector<double> all = latencies(written, observer.locked([&] { return observer.seen; }), 0.0);
    std::ofstream out(parameters.param<std::string>("out", "/dev/stdout"));
    tell(observer, process, all, out);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "load: " << error.what() << std::endl;
    return 1;
  }
}
