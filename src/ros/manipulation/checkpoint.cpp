#include "spring_workbench/ros/manipulation/checkpoint.h"

#include "constants.h"
#include "spring_workbench/validation/number_rule.h"
#include "spring_workbench/validation/one_line.h"

namespace spring_workbench::manipulation {

static const std::string kKey = "resume";

Checkpoint::Checkpoint(const ros::NodeHandle& master, const ros::NodeHandle& disk, const std::string& file,
                       live::SimulationRunner& runner, const std::string& given_scene,
                       const std::vector<std::string>& scene_roots)
    : master_(master), on_master_(runner, given_scene), in_file_(runner, given_scene) {
  if (!file.empty()) file_.emplace(file);
  resume(scene_roots);
  const ros::WallDuration period(checkpoint_period);
  master_timer_ = master_.createSteadyTimer(period, [this](const ros::SteadyTimerEvent&) { keep_on_master(); });
  if (file_) file_timer_ = ros::NodeHandle(disk).createSteadyTimer(period, [this](const auto&) { keep_in_file(); });
}

Checkpoint::~Checkpoint() {
  master_timer_.stop();
  file_timer_.stop();
  try {
    if (file_) file_->remove();
  } catch (const std::exception&) {  // already logged when writing failed
  }
  master_.deleteParam(kKey);
}

void Checkpoint::keep_on_master() {
  on_master_.keep([this](const std::string& text) { master_.setParam(kKey, text); });
}

void Checkpoint::keep_in_file() {
  try {
    in_file_.keep([this](const std::string& text) {
      file_->write(text);
      set_file_error("");
    });
  } catch (const std::exception& error) {
    set_file_error(error.what());
  }
}

void Checkpoint::set_file_error(const std::string& file_error) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (file_error == file_error_) return;
  file_error_ = file_error;
  const std::string now = file_error.empty() ? "up to date again" : "not up to date: " + file_error;
  ROS_WARN_STREAM("the checkpoint file is " << now);
}

void Checkpoint::keep_on_new_master() {
  on_master_.forget();
  keep_on_master();
}

void Checkpoint::resume(const std::vector<std::string>& scene_roots) {
  XmlRpc::XmlRpcValue kept;
  const bool from_file = !master_.getParam(kKey, kept);
  if (from_file && !file_) return;
  const std::string where = from_file ? "checkpoint_file" : "~" + kKey;
  std::string text;
  try {
    if (!from_file && kept.getType() != XmlRpc::XmlRpcValue::TypeString)
      validation::refuse_because("", where, "not a checkpoint of this node");
    text = from_file ? file_->read() : static_cast<std::string>(kept);
    if (text.empty()) return;
    on_master_.resume(text, where, scene_roots);
    ROS_WARN_STREAM("resuming from the state of the node that was killed (" << where << "); nothing is held");
  } catch (const std::exception& error) {  // a broken checkpoint must not keep the node from starting
    ROS_WARN_STREAM("the checkpoint is ignored: " << validation::one_line(error.what()));
    if (from_file && text.empty()) file_error_ = error.what();  // a foreign file is left alone, and not logged again
    if (from_file && !text.empty()) file_->set_aside();         // keep it, because another run may need it
  }
}

}  // namespace spring_workbench::manipulation
