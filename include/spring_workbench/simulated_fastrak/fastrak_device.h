#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "spring_workbench/fastrak/fastrak_protocol.h"
#include "spring_workbench/motion/stylus_source.h"

namespace spring_workbench::simulated_fastrak {

/// A motion that is played round and round, straight and evenly turning between its samples.
class PlayedMotion {
 public:
  /// Throws InputError for no samples and for a position that the device has no digits for (10 m and more). Samples
  /// that are not later than the one before are skipped.
  explicit PlayedMotion(const std::vector<motion::StylusSample>& samples);
  /// `t` [s] >= 0.
  motion::StylusSample at(double t) const;

 private:
  std::vector<motion::StylusSample> samples_;
};

/// A FASTRAK as its line sees it: commands in, records out. It has no clock. Station k plays the k-th motion, whose
/// poses are those of the receiver in the transmitter's frame; sockets without a motion have no receiver. Taken and
/// without effect: `A`, `I`, `N`, `R`, `r`, `o`. Ctrl-Y and `W` give the state at power-on, at once.
class FastrakDevice {
 public:
  /// 1 … 4 motions; throws InputError for another number. `switches`: the stations whose stylus' switch works; 1 alone
  /// with the maker's device, while one that emulates it may know more.
  explicit FastrakDevice(std::vector<PlayedMotion> motions, std::vector<int> switches = {1});

  /// What the device answers to these bytes of the host.
  std::string receive(std::string_view bytes);

  /// One cycle at time `t` [s]: the next active station measures. What is sent: a record in continuous mode.
  std::string measure(double t);
  int last_station() const { return last_station_; }  ///< that measured last
  /// As at power-on: inches, ASCII, position and angles, polled.
  void reset();
  /// As another program may have left it: streaming inches in ASCII with the default list.
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
  bool held_ = false;    ///< by the switch
  bool paused_ = false;  ///< by Ctrl-S
  bool switch_acts_ =
      true;  ///< mode 1: in continuous mode a press stops and starts the stream, else it asks for records
  bool pressed_ = false;
  int last_station_ = fastrak::kFastrakStations;
  double t_ = 0.0;
  std::string command_;  ///< one with arguments, up to now
};

}  // namespace spring_workbench::simulated_fastrak
