#include "spring_workbench/ros/register_tracker/register_tracker.h"

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/ros.h>
#include <sensor_msgs/Joy.h>
#include <tf2_msgs/TFMessage.h>

#include <atomic>
#include <iostream>

#include "constants.h"
#include "spring_workbench/config/command_line.h"
#include "spring_workbench/config/output_file.h"
#include "spring_workbench/motion_files/motion_file.h"
#include "spring_workbench/registration/touches.h"
#include "spring_workbench/ros/common/callback_thread.h"
#include "spring_workbench/ros/common/conversions.h"
#include "spring_workbench/ros/common/counted_subscriber.h"
#include "spring_workbench/ros/common/exit_after_timeout.h"
#include "spring_workbench/ros/common/lost_messages.h"
#include "spring_workbench/ros/common/master_watch.h"
#include "spring_workbench/ros/common/parameters.h"

namespace spring_workbench::register_tracker {
namespace {

std::atomic<bool> has_samples{false};  ///< before that, an interrupt ends the program without a file

/// Collects samples of the stylus and its button from the running driver. Reports in /diagnostics what it has lost.
class Listener {
 public:
  Listener()
      : diagnostics_(node_.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10)),
        timer_(node_.createSteadyTimer(ros::WallDuration(1.0), &Listener::publish_diagnostics, this)) {
    using ros_common::CountedSubscriber;
    tf_ = CountedSubscriber::to<const tf2_msgs::TFMessage&>(node_, "/tf", input_queue,
                                                            [this](const auto& message) { on_transforms(message); });
    joy_ = CountedSubscriber::to<const sensor_msgs::Joy&>(node_, "stylus/joy", input_queue,
                                                          [this](const auto& message) { on_buttons(message); });
  }
  ~Listener() { master_thread_.stop(); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  /// Returns all samples until the button is released for the `count`th time.
  std::vector<motion::StylusSample> collect(std::size_t count) {
    for (std::size_t seen = 0; seen < count && ros::ok();) {
      ros::spinOnce();
      ros::WallDuration(0.005).sleep();
      if (seen == released_) continue;
      seen = released_;
      std::cout << "touch " << seen << " of " << count << std::endl;
    }
    if (!ros::ok()) throw std::runtime_error("interrupted");
    has_samples = true;
    return samples_;
  }

 private:
  void on_transforms(const tf2_msgs::TFMessage& message) {
    for (const auto& transform : message.transforms) {
      if (transform.child_frame_id != "stylus") continue;
      motion::StylusSample sample;
      sample.t = transform.header.stamp.toSec();
      sample.X = ros_common::from_message(transform.transform);
      sample.button = pressed_;
      samples_.push_back(sample);
    }
  }
  void on_buttons(const sensor_msgs::Joy& message) {
    const bool pressed = !message.buttons.empty() && message.buttons[0] != 0;
    if (pressed_ && !pressed) ++released_;
    pressed_ = pressed;
  }

  void publish_diagnostics(const ros::SteadyTimerEvent&) {
    diagnostic_msgs::DiagnosticArray message;
    message.header.stamp = ros::Time::now();
    message.status = {lost_messages_.report(ros::this_node::getName())};
    diagnostics_.publish(message);
  }

  ros::NodeHandle node_;
  std::vector<motion::StylusSample> samples_;
  bool pressed_ = false;
  std::size_t released_ = 0;
  ros_common::CallbackThread master_thread_{"master"};
  ros_common::MasterWatch master_watch_{master_thread_.handle(node_)};
  ros_common::LostMessages lost_messages_;
  ros::Publisher diagnostics_;
  ros::SteadyTimer timer_;
  ros_common::CountedSubscriber tf_, joy_;
};

}  // namespace

std::string help_text() {
  return R"(Finds the pose of the tracker on the workbench, or the tip of the stylus.

register_tracker --landmarks FILE [--motion FILE] [--registration FILE] [--largest-residual MM] --out FILE
register_tracker --pivot          [--motion FILE] [--registration FILE] [--largest-residual MM] --out FILE

  --landmarks         YAML: landmarks: [{name: a, position: [x, y, z]}, ...], metres in the workbench. Touch them
                      in this order, and press the button while the tip rests on each
  --pivot             hold the tip in one place, press the button, tilt the stylus in all directions, release
  --motion            a recorded motion with a button column, as the tracker measured it, in place of the running
                      tracker_driver
  --registration      with --motion: the file of an earlier run, whose tip is used. A running driver has its own
  --largest-residual  largest error of a touch, or rms of the tip [mm]; default 5
  --out               the file to write, for `registration:=` of workbench.launch and fastrak.launch

Exit status: 0 done; 1 failed; 2 invalid arguments or touches, with one line on standard error. If it is not 0,
nothing is written.
)";
}

std::optional<Options> parse_options(int argc, char** argv) {
  using config::command_line;
  Options options;
  double largest_residual = 5.0;  // [mm]
  if (!config::read_command_line(
          argc, argv,
          {{"pivot", [&](const std::string&) { options.pivot = true; }, no_argument},
           config::text_option("landmarks", options.landmarks),
           config::text_option("motion", options.motion),
           config::text_option("registration", options.registration),
           config::number_option("largest-residual", validation::positive().in("mm"), largest_residual),
           config::text_option("out", options.out)})) {
    return std::nullopt;
  }
  options.largest_residual = 1e-3 * largest_residual;
  if (options.out.empty()) validation::refuse_missing(command_line, "--out", "path of the file to write");
  if (options.pivot && !options.landmarks.empty())
    throw validation::InputError(validation::prefix(command_line, "--landmarks, --pivot") + "cannot be given together");
  if (!options.pivot && options.landmarks.empty())
    validation::refuse_missing(command_line, "--landmarks or --pivot", "what to register");
  return options;
}

void run(const Options& options, int argc, char** argv) {
  std::vector<registration::Landmark> known;
  if (!options.pivot) known = registration::read_landmarks(options.landmarks);
  std::vector<motion::StylusSample> samples;
  registration::StoredRegistration present;
  if (options.motion.empty()) {
    ros::init(argc, argv, "register_tracker");
    ros_common::exit_after_timeout([] { return !has_samples && ros::isShuttingDown(); }, EXIT_FAILURE);
    samples = Listener().collect(options.pivot ? 1 : known.size());
    present = registration::read_registration(ros_common::private_parameters(ros::NodeHandle("tracker_driver")),
                                              "tracker_driver");
  } else {
    if (!options.registration.empty()) present = registration::read_registration_file(options.registration);
    samples = registration::as_sent(motion_files::read_motion_file(options.motion), present);
  }
  const std::string text = options.pivot
                               ? registration::find_tip(samples, present, options.largest_residual)
                               : registration::find_tracker(samples, known, present, options.largest_residual);
  std::cout << text;
  config::OutputFile file(options.out);
  file.write(text);
  file.commit();
}

}  // namespace spring_workbench::register_tracker
