#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "spring_workbench/fastrak/fastrak_protocol.h"
#include "spring_workbench/motion/stylus_source.h"

namespace spring_workbench::simulated_fastrak {

/// A motion that is played in a loop, with linear interpolation of position and rotation between its samples.
class PlayedMotion {
 public:
  /// Throws InputError if there are no samples, or for a position beyond the digits of the device (10 m and more).
  /// Samples that are not later than the previous one are skipped. `name`: what messages call the motion.
  explicit PlayedMotion(const std::vector<motion::StylusSample>& samples, const std::string& name = "motion");
  /// `t` [s] >= 0.
  motion::StylusSample at(double t) const;

 private:
  std::vector<motion::StylusSample> samples_;
};

/// A simulated FASTRAK at the level of its serial protocol: commands in, records out. It has no clock. Station k plays
/// the k-th motion, which gives the poses of the receiver in the transmitter's frame; stations without a motion have no
/// receiver. The commands `A`, `I`, `N`, `R`, `r`, `o` are accepted without effect. Ctrl-Y and `W` restore the power-on
/// state at once.
class FastrakDevice {
 public:
  /// Takes 1 … 4 motions; throws InputError for another number. `switches`: stations whose stylus switch is reported;
  /// station 1 alone for the original device, while emulations may support more.
  explicit FastrakDevice(std::vector<PlayedMotion> motions, std::vector<int> switches = {1});

  /// Returns the device's reply to these bytes from the host.
  std::string receive(std::string_view bytes);

  /// Runs one cycle at time `t` [s], in which the next active station measures. Returns what is sent: a record in
  /// continuous mode, otherwise nothing.
  std::string measure(double t);
  int last_station() const { return last_station_; }  ///< the station that measured last
  /// Restores the power-on state: inches, ASCII, position and angles, polled.
  void reset();
  /// Puts the device into a mode in which another program may have left it: streaming in ASCII and inches with the
  /// default list.
  void leave_in_another_mode();

 private:
  struct Station {
    bool on = false;
    std::vector<int> items{2, 4, 1};
    Vector3d hemisphere = Vector3d::UnitX();  ///< zero: tracked
  };
  std::string immediate(char command);
  std::string with_arguments(const std::string& command);
  std::string set_list(int station, const std::vector<double>& arguments);
  std::string set_active(int station, const std::vector<double>& arguments);
  std::string record(int station) const;
  std::string records() const;
  int next_active(int after) const;
  bool has_switch(int station) const;
  static std::string error(const std::string& command, int code);

  std::vector<PlayedMotion> motions_;
  std::vector<int> switches_;
  std::array<Station, fastrak::kFastrakStations> stations_;
  fastrak::FastrakFormat format_ = fastrak::FastrakFormat::ascii;
  fastrak::FastrakUnits units_ = fastrak::FastrakUnits::inches;
  bool continuous_ = false;
  bool held_ = false;    ///< stream stopped by the switch
  bool paused_ = false;  ///< stream paused by Ctrl-S
  bool switch_acts_ =
      true;  ///< mode 1: a press stops or restarts the stream in continuous mode, and otherwise requests records
  bool pressed_ = false;
  int last_station_ = fastrak::kFastrakStations;
  double t_ = 0.0;
  std::string command_;  ///< the part received so far of a command with arguments
};

}  // namespace spring_workbench::simulated_fastrak
