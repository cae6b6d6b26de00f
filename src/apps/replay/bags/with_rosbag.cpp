// The only file of `replay` that depends on ROS: bags are read with the rosbag library, which needs no master.
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/Joy.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <iostream>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <utility>

#include "../constants.h"
#include "../motion.h"
#include "spring_workbench/Accepted.h"
#include "spring_workbench/Change.h"
#include "spring_workbench/math/spatial.h"
#include "spring_workbench/simulation/simulation.h"
#include "spring_workbench/validation/number_rule.h"
#include "spring_workbench/validation/renamed.h"

namespace spring_workbench::replay {
namespace {

const std::string world = "world";  // as the parameter ~world_frame of `manipulation`

/// Removes a leading slash from the name of a frame or topic.
std::string bare(const std::string& name) { return !name.empty() && name[0] == '/' ? name.substr(1) : name; }

/// Correctly rounded, so that a bag and a motion file with the same stamps give bit-identical times.
double seconds_between(const ros::Time& from, const ros::Time& to) {
  const auto nanoseconds = [](const ros::Time& time) {
    return static_cast<std::int64_t>(time.sec) * 1'000'000'000 + static_cast<std::int64_t>(time.nsec);
  };
  return static_cast<double>(nanoseconds(to) - nanoseconds(from)) / 1e9;
}

RigidTransform to_pose(const geometry_msgs::Transform& transform, const std::string& where) {
  const auto& p = transform.translation;
  const auto& q = transform.rotation;
  const validation::NumberRule position = validation::between(-farthest_position, farthest_position).in("m");
  validation::check_number(where, "translation.x", p.x, position);
  validation::check_number(where, "translation.y", p.y, position);
  validation::check_number(where, "translation.z", p.z, position);
  const Quaterniond rotation(q.w, q.x, q.y, q.z);
  validation::check_number(where, "norm of rotation", rotation.norm(), validation::between(0.5, 2.0));
  return make_transform(Vector3d(p.x, p.y, p.z), rotation);
}

live::Entry to_entry(const Accepted& message) {
  hand_input::AcceptedInput accepted;
  validation::check_number("~accepted", "kind", message.kind, validation::between(0, Accepted::EXTERNAL_WRENCH));
  validation::check_number("~accepted", "stylus", message.stylus, validation::between(1, 255));
  accepted.kind = static_cast<hand_input::AcceptedInput::Kind>(message.kind);
  accepted.hand = message.stylus - 1u;
  accepted.t = message.time;
  accepted.committed = message.committed;
  accepted.X_WS.affine() = Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(message.stylus_pose.data());
  if (message.kind == Accepted::EXTERNAL_WRENCH) {
    validation::check_number("~accepted", "numbers of wrench", static_cast<double>(message.wrench.size()),
                             validation::between(6, 6));
    validation::check_number("~accepted", "wrench_axes", message.wrench_axes,
                             validation::between(0, Accepted::TIP_AXES));
    accepted.wrench = {message.time, to_wrench(Eigen::Map<const Vector6d>(message.wrench.data())),
                       static_cast<motion::ExternalWrench::Axes>(message.wrench_axes)};
  }
  return {message.index, message.committed, message.target, std::nullopt, accepted};
}

live::Entry to_entry(const Change& message) {
  live::Change change;
  change.what = message.what;
  change.command = live::Command::from(message.command);
  change.scene = message.scene;
  change.hash_before = std::stoull(message.hash_before, nullptr, 16);
  if (!message.state.empty()) change.state = simulation::parse_state(message.state);
  return {message.index, message.committed, message.target, std::nullopt, change};
}

/// The number, from 0, of the hand that a name belongs to: `first`, `first`_2 and so on; none for any other name.
std::optional<std::size_t> hand_of(const std::string& name, const std::string& first) {
  if (name == first) return 0;
  if (name.rfind(first + "_", 0) != 0) return std::nullopt;
  const char* const end = name.data() + name.size();
  std::size_t number = 0;
  const auto read = std::from_chars(name.data() + first.size() + 1, end, number);
  const bool is_one = read.ec == std::errc() && read.ptr == end && number > 1 && name[first.size() + 1] != '0';
  return is_one ? std::optional<std::size_t>(number - 1) : std::nullopt;
}

/// Collects the hands from the messages of a bag.
class BagReader {
 public:
  BagReader(std::string path, const std::string& parent, const std::string& child, int clutch_button)
      : path_(std::move(path)),
        parent_(bare(parent)),
        child_(bare(child)),
        clutch_button_(static_cast<std::size_t>(clutch_button)) {
    if (parent_ == world) return;
    geometry_msgs::TransformStamped same;  // until /tf_static says otherwise
    same.header.frame_id = world;
    same.child_frame_id = parent_;
    same.transform.rotation.w = 1.0;
    frames_.setTransform(same, path_, true);
  }

  std::map<std::size_t, Motion> read() {
    rosbag::Bag bag(path_, rosbag::bagmode::Read);
    rosbag::View view(bag);
    take_first_static(view);
    for (const rosbag::MessageInstance& message : view) take(message);
    ros::Time zero = ros::TIME_MAX;
    for (const auto& [number, hand] : hands_) {
      if (!hand.poses.empty()) zero = std::min(zero, hand.poses.front().stamp);
    }
    std::map<std::size_t, Motion> motions;
    for (const auto& [number, hand] : hands_) {
      if (!hand.poses.empty()) motions[number] = motion(hand, zero);
    }
    if (motions.empty()) refuse_missing();
    return motions;
  }

 private:
  struct Pose {
    ros::Time stamp;
    RigidTransform X;
    double quaternion_norm;
  };
  struct Buttons {
    ros::Time stamp;
    bool grasp, next_tool, clutch;
  };
  struct Hand {
    std::vector<Pose> poses;
    std::vector<Buttons> buttons;
  };

  static Motion motion(const Hand& hand, const ros::Time& zero) {
    Motion motion;
    for (const Pose& pose : hand.poses) {
      motion::StylusSample sample;
      sample.t = seconds_between(zero, pose.stamp);
      sample.X = pose.X;
      sample.quaternion_norm = pose.quaternion_norm;
      motion.samples.push_back(sample);
    }
    for (const Buttons& b : hand.buttons) {
      const double t = std::max(0.0, seconds_between(zero, b.stamp));
      add_button(t, b.grasp, motion.buttons);
      add_button(t, b.next_tool, motion.next_tool);
      add_button(t, b.clutch, motion.clutch);
    }
    return motion;
  }

  /// Reports each renamed field of our messages in the bag once, with its new name.
  void warn_of_renamed(const rosbag::MessageInstance& message) {
    if (message.getDataType().rfind("spring_workbench/", 0) != 0 || !own_types_.insert(message.getDataType()).second)
      return;
    for (const auto& [before, now] : validation::renamed()) {
      if (!std::regex_search(message.getMessageDefinition(), std::regex("\\b" + before + "\\b"))) continue;
      std::cerr << "warning: " << path_ << ": " << message.getTopic() << ": " << before << " is now called " << now
                << "\n";
    }
  }

  /// A recorder joins /tf_static late: its first transform of a frame holds from the start of the bag.
  void take_first_static(rosbag::View& view) {
    std::vector<tf2_msgs::TFMessageConstPtr> messages;
    for (const rosbag::MessageInstance& message : view) {
      if (bare(message.getTopic()) != "tf_static") continue;
      if (const auto tf = message.instantiate<tf2_msgs::TFMessage>()) messages.push_back(tf);
    }
    for (auto tf = messages.rbegin(); tf != messages.rend(); ++tf) take_static(**tf);
  }

  void take_static(const tf2_msgs::TFMessage& tf) {
    for (geometry_msgs::TransformStamped transform : tf.transforms) {
      transform.header.frame_id = bare(transform.header.frame_id);
      transform.child_frame_id = bare(transform.child_frame_id);
      const RigidTransform X = to_pose(transform.transform, path_ + ": /tf_static: " + transform.header.frame_id +
                                                                " -> " + transform.child_frame_id);
      Eigen::Map<Eigen::Vector4d>(&transform.transform.rotation.x) = Quaterniond(X.linear()).coeffs();
      frames_.setTransform(transform, path_, true);
    }
  }

  /// Pose of a frame in the world or, where /tf_static puts `parent` elsewhere, in `parent`; none if /tf_static does
  /// not connect the two.
  std::optional<RigidTransform> place_of(const std::string& from) const {
    const std::string root = frames_.canTransform(world, parent_, {}) ? world : parent_;
    if (from == root) return RigidTransform::Identity();
    if (!frames_.canTransform(root, from, {})) return std::nullopt;
    return to_pose(frames_.lookupTransform(root, from, {}).transform, path_ + ": /tf_static");
  }

  void take(const rosbag::MessageInstance& message) {
    warn_of_renamed(message);
    const std::string topic = bare(message.getTopic());
    if (message.getDataType() == "sensor_msgs/Joy") {
      const std::size_t begins = topic.rfind("/joy");
      const auto hand = hand_of(topic.substr(0, begins), "stylus");
      if (!hand || begins == std::string::npos || begins + 4 != topic.size()) return;
      const auto joy = message.instantiate<sensor_msgs::Joy>();
      if (!joy || joy->buttons.empty()) return;
      const auto down = [&](std::size_t button) { return joy->buttons.size() > button && joy->buttons[button] != 0; };
      hands_[*hand].buttons.push_back(
          {joy->header.stamp.isZero() ? message.getTime() : joy->header.stamp, down(0), down(1), down(clutch_button_)});
    } else if (const auto tf = message.instantiate<tf2_msgs::TFMessage>()) {  // also the older tf/tfMessage
      if (topic == "tf_static") return take_static(*tf);
      for (const auto& transform : tf->transforms) take(transform, message.getTime());
    }
  }

  void take(const geometry_msgs::TransformStamped& transform, const ros::Time& received) {
    const std::string from = bare(transform.header.frame_id);
    const std::string to = bare(transform.child_frame_id);
    pairs_.insert(from + " -> " + to);
    const auto hand = hand_of(to, child_);
    if (!hand) return;
    const std::optional<RigidTransform> X_WP = place_of(from);
    if (!X_WP) return;
    const ros::Time stamp = transform.header.stamp.isZero() ? received : transform.header.stamp;
    std::ostringstream where;
    where << path_ << ": " << from << " -> " << to << " at " << stamp;
    const auto& q = transform.transform.rotation;
    hands_[*hand].poses.push_back(
        {stamp, *X_WP * to_pose(transform.transform, where.str()), Quaterniond(q.w, q.x, q.y, q.z).norm()});
  }

  [[noreturn]] void refuse_missing() const {
    const std::vector<std::string> there(pairs_.begin(), pairs_.end());
    validation::refuse(path_, "transform", parent_ + " -> " + child_,
                       there.empty() ? "a bag with transforms, got none"
                                     : "one of " + validation::join(there) + " (choose with --parent and --child)");
  }

  std::string path_, parent_, child_;
  std::size_t clutch_button_;
  tf2::BufferCore frames_;  ///< of /tf_static
  std::map<std::size_t, Hand> hands_;
  std::set<std::string> own_types_;  ///< types of our messages found so far
  std::set<std::string> pairs_;      ///< all pairs of frames in the bag, for the error message
};

}  // namespace

/// Calls `read` and converts exceptions: rosbag, ros::serialization and the decompressors each have their own.
template <typename Read>
auto reading(const std::string& path, Read&& read) {
  try {
    return read();
  } catch (const validation::InputError&) {
    throw;
  } catch (const std::exception& e) {
    throw validation::InputError(path + ": cannot be read as a bag: " + e.what());
  }
}

std::map<std::size_t, Motion> read_bag(const std::string& path, const std::string& parent, const std::string& child,
                                       int clutch_button) {
  return reading(path, [&] { return BagReader(path, parent, child, clutch_button).read(); });
}

std::vector<live::Entry> read_journal(const std::string& path) {
  return reading(path, [&] {
    rosbag::Bag bag(path, rosbag::bagmode::Read);
    std::vector<live::Entry> entries;
    for (const rosbag::MessageInstance& message : rosbag::View(bag)) {
      if (const auto accepted = message.instantiate<Accepted>()) entries.push_back(to_entry(*accepted));
      if (const auto change = message.instantiate<Change>()) entries.push_back(to_entry(*change));
    }
    std::vector<std::vector<live::Entry>> lives = live::lives_of(std::move(entries));
    if (lives.empty()) return std::vector<live::Entry>();
    if (lives.size() > 1) {
      std::cerr << "warning: " << path
                << ": manipulation was restarted during the recording (restarts: " << lives.size() - 1
                << "): only the run after the last start is replayed\n";
    }
    return live::from_first_complete(std::move(lives.back()));
  });
}

}  // namespace spring_workbench::replay
