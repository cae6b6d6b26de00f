#include "spring_workbench/ros/contact_sound/contact_sound.h"

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "constants.h"
#include "spring_workbench/Contacts.h"
#include "spring_workbench/SceneDescription.h"
#include "spring_workbench/config/yaml_fields.h"
#include "spring_workbench/ros/common/callback_thread.h"
#include "spring_workbench/ros/common/loop_clock.h"
#include "spring_workbench/ros/common/master_watch.h"
#include "spring_workbench/ros/common/parameters.h"
#include "spring_workbench/sound/audio_output.h"
#include "spring_workbench/sound/contact_synthesizer.h"

namespace spring_workbench::contact_sound {
namespace {

class ContactSound {
 public:
  ContactSound(ros::NodeHandle& node, const ros::NodeHandle& private_node) : played_until_(ros_common::steady_time()) {
    const std::string& where = private_node.getNamespace();
    YAML::Node parameters = ros_common::private_parameters(private_node);
    config::check_keys(parameters, where, "", {"file", "volume"});
    const YAML::Node volume = ros_common::take(parameters, "volume"), file = ros_common::take(parameters, "file");
    synthesizer_ = std::make_unique<sound::ContactSynthesizer>(
        volume ? config::read_number(volume, where, "volume", validation::between(0.0, 1.0)) : 0.8);
    output_ = file ? sound::open_wav_file(config::read_string(file, where, "file")) : sound::open_audio_device();
    ros::NodeHandle heard = contacts_thread_.handle(node);
    constexpr std::uint32_t unbounded =
        0;  // so that no impact is lost; messages are processed faster than they are sent
    subscriber_ = heard.subscribe("contacts", unbounded, &ContactSound::on_contacts, this);
    scene_subscriber_ = heard.subscribe("scene_description", 1, &ContactSound::on_scene, this);
    timer_ = node.createSteadyTimer(ros::WallDuration(render_period), &ContactSound::play, this);
  }
  ~ContactSound() {
    contacts_thread_.stop();
    timer_.stop();
    output_.reset();        // completes the file
    master_thread_.stop();  // may have to wait for the master
  }
  ContactSound(const ContactSound&) = delete;
  ContactSound& operator=(const ContactSound&) = delete;

 private:
  /// A body rings like a cube with the same mass and radius of gyration.
  void on_scene(const SceneDescription::ConstPtr& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    bodies_.clear();
    compliances_.clear();
    for (const BodyDescription& body : message->bodies) {
      const double trace = body.inertia[0] + body.inertia[4] + body.inertia[8];
      if (body.compliance > 0.0) compliances_[body.name] = body.compliance;
      if (body.mass > 0.0 && trace > 0.0) bodies_[body.name] = {body.mass, std::sqrt(2.0 * trace / body.mass)};
    }
  }

  /// Both bodies of an impact ring if they are movable; without a scene description, a small wooden block rings.
  void strike(const Contact& contact) {
    bool rings = false;
    double compliance = 0.0;
    for (const std::string& name : {contact.object, contact.other}) {
      if (const auto found = compliances_.find(name); found != compliances_.end()) compliance += found->second;
    }
    for (const std::string& name : {contact.object, contact.other}) {
      const auto body = bodies_.find(name);
      if (body == bodies_.end()) continue;
      synthesizer_->strike(contact.impulse, {body->second.mass, body->second.size, compliance});
      rings = true;
    }
    if (!rings) synthesizer_->strike(contact.impulse);
  }

  void on_contacts(const Contacts::ConstPtr& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    double speed = 0.0;
    for (const Contact& contact : message->contacts) {
      if (contact.phase == Contact::STARTED) strike(contact);
      if (contact.phase == Contact::PERSISTING) speed = std::max(speed, contact.slip_speed);
    }
    synthesizer_->scrape(speed);
    last_contacts_ = ros_common::steady_time();
  }

  void play(const ros::SteadyTimerEvent&) {
    const double now = ros_common::steady_time();
    played_until_ = std::max(played_until_, now - longest_filled_gap);
    const auto count =
        static_cast<std::size_t>(std::max(0.0, now - played_until_) * sound::ContactSynthesizer::sample_rate);
    played_until_ += static_cast<double>(count) / sound::ContactSynthesizer::sample_rate;
    output_->write(render(count, now));  // may block on the disk
  }

  std::vector<float> render(std::size_t count, double now) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (now - last_contacts_ > silent_after) synthesizer_->scrape(0.0);
    return synthesizer_->render(count);
  }

  std::mutex mutex_;  ///< guards the synthesizer, the bodies and the time of their last message
  std::unique_ptr<sound::ContactSynthesizer> synthesizer_;
  std::unique_ptr<sound::AudioOutput> output_;
  std::map<std::string, sound::SoundingBody> bodies_;  ///< the movable ones
  std::map<std::string, double> compliances_;          ///< of soft bodies [m/N]
  double played_until_, last_contacts_ = 0.0;          ///< [s], by the steady clock
  ros_common::CallbackThread contacts_thread_{"contacts"}, master_thread_{"master"};
  ros_common::MasterWatch master_watch_{master_thread_.handle(ros::NodeHandle())};
  ros::Subscriber subscriber_, scene_subscriber_;
  ros::SteadyTimer timer_;
};

}  // namespace

void run(ros::NodeHandle node, const ros::NodeHandle& private_node) {
  const ContactSound sound(node, private_node);
  // Not ros::spin(), which would go on until the master has answered that this node is gone.
  while (ros::ok() && !ros::isShuttingDown()) ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.1));
}

}  // namespace spring_workbench::contact_sound
