// The only file of `replay` that knows ROS: bags are read through rosbag's own library, which needs no master.
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/Joy.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <utility>

#include "motion.h"
#include "spring_workbench/config/yaml_fields.h"

namespace spring_workbench::replay {
namespace {

constexpr double kFarthestPosition = 1e9;  // [m] what a PoseTrack takes

/// Frame and topic names with and without a leading slash are the same.
std::string bare(const std::string& name) { return !name.empty() && name[0] == '/' ? name.substr(1) : name; }

/// Correctly rounded, so that a bag and a motion file with the same stamps give the same bits.
double seconds_between(const ros::Time& from, const ros::Time& to) {
  const auto nanoseconds = [](const ros::Time& time) {
    return static_cast<std::int64_t>(time.sec) * 1'000'000'000 + static_cast<std::int64_t>(time.nsec);
  };
  return static_cast<double>(nanoseconds(to) - nanoseconds(from)) / 1e9;
}

RigidTransform to_pose(const geometry_msgs::Transform& transform, const std::string& where) {
  const auto& p = transform.translation;
  const auto& q = transform.rotation;
  const NumberRule position = between(-kFarthestPosition, kFarthestPosition);
  check_number(where, "translation.x", p.x, position);
  check_number(where, "translation.y", p.y, position);
  check_number(where, "translation.z", p.z, position);
  const Quaterniond rotation(q.w, q.x, q.y, q.z);
  check_number(where, "norm of rotation", rotation.norm(), between(0.5, 2.0));
  return make_transform(rotation, Vector3d(p.x, p.y, p.z));
}

/// Collects one hand from the messages of a bag.
class BagReader {
 public:
  BagReader(std::string path, const std::string& parent, const std::string& child)
      : path_(std::move(path)), parent_(bare(parent)), child_(bare(child)) {}

  Motion read() {
    rosbag::Bag bag(path_, rosbag::bagmode::Read);
    rosbag::View view(bag);
    for (const rosbag::MessageInstance& message : view) take(message);
    if (motion_.samples.empty()) refuse_missing();
    for (const Buttons& b : buttons_) {
      const double t = std::max(0.0, seconds_between(first_stamp_, b.stamp));
      add_button(t, b.grasp, motion_.buttons);
      add_button(t, b.next_tool, motion_.next_tool);
    }
    return std::move(motion_);
  }

 private:
  void take(const rosbag::MessageInstance& message) {
    const std::string topic = bare(message.getTopic());
    if (topic == "tf_static") return;
    if (message.getDataType() == "sensor_msgs/Joy" && topic == "stylus/joy") {
      const auto joy = message.instantiate<sensor_msgs::Joy>();
      if (!joy || joy->buttons.empty()) return;
      buttons_.push_back({joy->header.stamp.isZero() ? message.getTime() : joy->header.stamp, joy->buttons[0] != 0,
                          joy->buttons.size() > 1 && joy->buttons[1] != 0});
    } else if (const auto tf = message.instantiate<tf2_msgs::TFMessage>()) {  // also the older tf/tfMessage
      for (const auto& transform : tf->transforms) take(transform, message.getTime());
    }
  }

  void take(const geometry_msgs::TransformStamped& transform, const ros::Time& received) {
    const std::string from = bare(transform.header.frame_id);
    const std::string to = bare(transform.child_frame_id);
    pairs_.insert(from + " -> " + to);
    if (from != parent_ || to != child_) return;
    const ros::Time stamp = transform.header.stamp.isZero() ? received : transform.header.stamp;
    if (motion_.samples.empty()) first_stamp_ = stamp;
    const double t = seconds_between(first_stamp_, stamp);
    const std::string where =
        path_ + ": " + from + " -> " + to + " at " + std::to_string(stamp.sec) + "." + std::to_string(stamp.nsec);
    motion_.samples.push_back({t, to_pose(transform.transform, where)});
  }

  [[noreturn]] void refuse_missing() const {
    const std::vector<std::string> there(pairs_.begin(), pairs_.end());
    refuse(path_, "transform", parent_ + " -> " + child_,
           there.empty() ? "one of the bag's, which has none" : "one of " + join(there));
  }

  std::string path_, parent_, child_;
  Motion motion_;
  ros::Time first_stamp_;
  struct Buttons {
    ros::Time stamp;
    bool grasp, next_tool;
  };
  std::vector<Buttons> buttons_;
  std::set<std::string> pairs_;  ///< all that are in the bag, for the message
};

}  // namespace

Motion read_bag(const std::string& path, const std::string& parent, const std::string& child) {
  try {
    return BagReader(path, parent, child).read();
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& e) {  // rosbag, ros::serialization and the decompressors have a family each
    throw InputError(path + ": cannot be read: " + e.what() + ": must be a bag");
  }
}

}  // namespace spring_workbench::replay
