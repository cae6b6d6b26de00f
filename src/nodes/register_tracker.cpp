#include <getopt.h>
#include <ros/ros.h>
#include <sensor_msgs/Joy.h>
#include <tf2_msgs/TFMessage.h>

#include <fstream>
#include <iostream>
#include <sstream>

#include "spring_workbench/config/yaml_fields.h"
#include "spring_workbench/motion_files/motion_file.h"
#include "spring_workbench/registration/touches.h"
#include "spring_workbench/ros/common/parameters.h"
#include "spring_workbench/validation/input_error.h"

namespace spring_workbench {
namespace {

const char* const kWhere = "command line";
const char* const kHelp = R"(Where the tracker stands on the workbench, or where the tip of the stylus is.

register_tracker --landmarks FILE [--motion FILE] [--registration FILE] [--largest-residual MM] --out FILE
register_tracker --pivot          [--motion FILE] [--registration FILE] [--largest-residual MM] --out FILE

  --landmarks         YAML: landmarks: [{name: a, position: [x, y, z]}, ...], metres in the workbench. Touch one after
                      the other, in this order, and press the button while the tip rests there
  --pivot             hold the tip in one place, press the button, turn the stylus about it to all sides, let go
  --motion            a recorded motion with a button column, as the tracker measured it, in place of the running
                      tracker_driver
  --registration      with --motion: the file found before, whose tip is to be used. A running driver has its own
  --largest-residual  the most that a touch may be off, or the tip's rms [mm]; 5
  --out               the file to write, for `registration:=` of workbench.launch and fastrak.launch

Exit status: 0 done; 1 failed; 2 what is given or touched cannot be used, with one line on standard error; nothing is
written then.
)";

struct Options {
  bool help = false, pivot = false;
  std::string landmarks, motion, registration, out;
  double largest_residual = 5e-3;  ///< [m]
};

Options parse_options(int argc, char** argv) {
  const option known[] = {{"help", no_argument, nullptr, 'h'},
                          {"pivot", no_argument, nullptr, 'p'},
                          {"landmarks", required_argument, nullptr, 'l'},
                          {"motion", required_argument, nullptr, 'm'},
                          {"registration", required_argument, nullptr, 'g'},
                          {"out", required_argument, nullptr, 'o'},
                          {"largest-residual", required_argument, nullptr, 'r'},
                          {nullptr, 0, nullptr, 0}};
  Options options;
  opterr = 0;
  for (int code; (code = getopt_long(argc, argv, "", known, nullptr)) != -1;) {
    switch (code) {
      case 'h':
        options.help = true;
        return options;
      case 'p':
        options.pivot = true;
        break;
      case 'l':
        options.landmarks = optarg;
        break;
      case 'm':
        options.motion = optarg;
        break;
      case 'g':
        options.registration = optarg;
        break;
      case 'o':
        options.out = optarg;
        break;
      case 'r':
        options.largest_residual = 1e-3 * config::read_number(YAML::Node(std::string(optarg)), kWhere,
                                                              "--largest-residual", validation::positive());
        break;
      default:
        validation::refuse(kWhere, "option", argv[optind - 1], "one of those that --help lists");
    }
  }
  if (optind < argc) validation::refuse(kWhere, "argument", argv[optind], "an option that --help lists");
  if (options.out.empty()) validation::refuse(kWhere, "--out", "(nothing)", "the path of the file to write");
  if (options.pivot == !options.landmarks.empty()) {
    validation::refuse(kWhere, "--landmarks", options.pivot ? "given beside --pivot" : "(nothing)",
                       "one of --landmarks and --pivot");
  }
  return options;
}

/// The stylus and its button from the running driver.
class Listener {
 public:
  Listener()
      : tf_(node_.subscribe("/tf", 1000, &Listener::on_transforms, this)),
        joy_(node_.subscribe("stylus/joy", 1000, &Listener::on_buttons, this)) {}

  /// All samples until the button was let go for the `count`th time.
  std::vector<motion::StylusSample> collect(std::size_t count) {
    for (std::size_t seen = 0; seen < count && ros::ok();) {
      ros::spinOnce();
      ros::WallDuration(0.005).sleep();
      if (seen == released_) continue;
      seen = released_;
      std::cout << "touch " << seen << " of " << count << std::endl;
    }
    if (!ros::ok()) throw std::runtime_error("interrupted");
    return samples_;
  }

 private:
  void on_transforms(const tf2_msgs::TFMessage& message) {
    for (const auto& transform : message.transforms) {
      if (transform.child_frame_id != "stylus") continue;
      const auto& p = transform.transform.translation;
      const auto& q = transform.transform.rotation;
      motion::StylusSample sample;
      sample.t = transform.header.stamp.toSec();
      sample.X = make_transform(Quaterniond(q.w, q.x, q.y, q.z), Vector3d(p.x, p.y, p.z));
      sample.button = pressed_;
      samples_.push_back(sample);
    }
  }
  void on_buttons(const sensor_msgs::Joy& message) {
    const bool pressed = !message.buttons.empty() && message.buttons[0] != 0;
    if (pressed_ && !pressed) ++released_;
    pressed_ = pressed;
  }

  ros::NodeHandle node_;
  std::vector<motion::StylusSample> samples_;
  bool pressed_ = false;
  std::size_t released_ = 0;
  ros::Subscriber tf_, joy_;
};

/// Samples as the driver sends them, and the registration that it has.
struct Take {
  std::vector<motion::StylusSample> samples;
  registration::StoredRegistration present;
};

Take take(const Options& options, std::size_t touches, int argc, char** argv) {
  if (!options.motion.empty()) {
    registration::StoredRegistration present;
    if (!options.registration.empty())
      present = registration::read_registration(config::load_yaml_file(options.registration), options.registration);
    std::vector<motion::StylusSample> samples = motion_files::read_motion_file(options.motion);
    for (motion::StylusSample& sample : samples)
      sample.X = present.X_BT * sample.X * Eigen::Translation3d(present.p_ST);
    return {samples, present};
  }
  ros::init(argc, argv, "register_tracker");
  Listener listener;
  const std::vector<motion::StylusSample> samples = listener.collect(touches);
  return {samples, registration::read_registration(ros_common::private_parameters(ros::NodeHandle("tracker_driver")),
                                                   "tracker_driver")};
}

std::string pivot(const Options& options, Take& taken) {
  std::vector<RigidTransform> poses;
  for (const auto& press : registration::presses(taken.samples)) {
    for (const motion::StylusSample& sample : press) poses.push_back(sample.X);
  }
  const registration::PivotCalibration found = registration::calibrate_tip(poses, options.largest_residual);
  taken.present.p_ST += found.p_ST;
  std::ostringstream report;
  report << "# tip: rms " << 1e3 * found.rms << " mm over " << poses.size() << " poses\n";
  return report.str();
}

std::string locate(const Options& options, const std::vector<registration::Landmark>& known, Take& taken) {
  const std::vector<registration::Landmark> landmarks =
      registration::touched_landmarks(known, registration::presses(taken.samples), options.largest_residual);
  const registration::Registration found = registration::register_tracker(landmarks, options.largest_residual);
  taken.present.X_BT = found.X_BT * taken.present.X_BT;
  std::ostringstream report;
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    report << "# " << landmarks[i].name << ": residual " << 1e3 * found.residuals[i] << " mm\n";
  }
  report << "# residuals' rms " << 1e3 * found.rms << " mm; a touch is off by " << 1e3 * found.touch_error
         << " mm along an axis\n# expected error: position " << 1e3 * found.position_error
         << " mm at the landmarks' middle, angle " << 1e3 * found.angle_error
         << " mrad\n# check: no other order of the touches fits\n";
  return report.str();
}

void run(const Options& options, int argc, char** argv) {
  const std::vector<registration::Landmark> known =
      options.pivot ? std::vector<registration::Landmark>() : registration::read_landmarks(options.landmarks);
  Take taken = take(options, options.pivot ? 1 : known.size(), argc, argv);
  const std::string report = options.pivot ? pivot(options, taken) : locate(options, known, taken);
  const std::string text = registration::write_registration(taken.present, report);
  std::cout << text;
  std::ofstream file(options.out);
  if (!(file << text) || !file.flush()) throw std::runtime_error(options.out + ": cannot be written");
}

}  // namespace
}  // namespace spring_workbench

/// Touches of known landmarks, or turning about the tip, as a file for the launch files.
int main(int argc, char** argv) {
  using namespace spring_workbench;
  try {
    const Options options = parse_options(argc, argv);
    if (options.help) {
      std::cout << kHelp;
      return 0;
    }
    run(options, argc, argv);
    return 0;
  } catch (const validation::InputError& e) {
    std::cerr << "register_tracker: " << e.what() << std::endl;
    return 2;
  } catch (const std::exception& e) {
    std::cerr << "register_tracker: failed: " << e.what() << std::endl;
    return 1;
  }
}
