#pragma once

#include <ros/ros.h>

#include <memory>

#include "spring_workbench/Contacts.h"
#include "spring_workbench/sound/audio_output.h"
#include "spring_workbench/sound/contact_synthesizer.h"

namespace spring_workbench::contact_sound {

/// The node `contact_sound`: `contacts` in, sound out, to the sound device or to the WAV file `~file`. Call
/// `ros::spin()`.
class ContactSound {
 public:
  /// Reads `~volume` and `~file`. Throws InputError when one cannot be used or there is no sound device.
  ContactSound(ros::NodeHandle node, const ros::NodeHandle& private_node);

 private:
  void on_contacts(const Contacts::ConstPtr& message);
  void play(const ros::WallTimerEvent&);

  std::unique_ptr<sound::ContactSynthesizer> synthesizer_;
  std::unique_ptr<sound::AudioOutput> output_;
  ros::WallTime played_until_, last_contacts_;
  ros::Subscriber subscriber_;
  ros::WallTimer timer_;
};

}  // namespace spring_workbench::contact_sound
