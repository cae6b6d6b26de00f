#pragma once

#include <yaml-cpp/yaml.h>

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "spring_workbench/fastrak/fastrak_decoder.h"
#include "spring_workbench/motion/live_source.h"

namespace spring_workbench::fastrak {

class SerialPort;

/// How a FASTRAK is connected and what it shall send.
struct FastrakSettings {
  std::string port = "/dev/ttyUSB0";
  int baud = 115200;  ///< as the switches on the device's back say; 2400, 4800 … 115200
  FastrakFormat format = FastrakFormat::binary;
  std::vector<int> stations = {1};          ///< each 1 … 4, none twice; with n of them, each reports at 120 Hz / n
  std::vector<int> styluses = {1};          ///< stations whose switch is read
  bool euler = false;                       ///< angles instead of quaternions
  bool redundant = true;                    ///< every pose twice, so that no line fault can pass (fastrak_output_list)
  Vector3d hemisphere = Vector3d::UnitX();  ///< towards the half-space the stations are in, in T; zero: as tracked
};

/// The keys of read_fastrak_settings.
const std::vector<std::string>& fastrak_keys();

/// From a map: `port`, `baud`, `format` (binary, ascii), `stations` (list), `orientation` (quaternion, euler),
/// `redundant`, `hemisphere` (x y z), `stylus` (true: station 1; false: none; or a list); other keys are not looked at.
/// Throws InputError with `where`, key, value and rule.
FastrakSettings read_fastrak_settings(const YAML::Node& map, const std::string& where);

/// The commands that bring the device into the mode that the settings ask for, whatever it was in, in portions that it
/// can take at once; it streams after a further `C`.
std::vector<std::string> fastrak_set_up(const FastrakSettings& settings);

/// A FASTRAK on a serial port. It is set up again whenever it has been silent, or not understood, for 0.25 s.
class FastrakSource : public motion::LiveSource {
 public:
  /// Opens nothing yet.
  explicit FastrakSource(const FastrakSettings& settings);
  ~FastrakSource() override;  ///< stops the device's stream
  std::vector<motion::StationSample> read(double timeout) override;
  motion::SourceHealth health() const override;

 private:
  using Time = std::chrono::steady_clock::time_point;
  enum class State { closed, setting_up, streaming };

  void open();
  void close(const std::string& why);
  void begin_set_up();
  void send_portion();
  void listen(Time until);
  void take(const FastrakRecord& record, Time now);
  void stamp(std::size_t first, Time now);
  void take(const FastrakReply& reply, Time now);
  void begin_stream();
  void give_up_waiting();
  std::string why_silent() const;
  std::chrono::steady_clock::duration patience(double s) const;

  const FastrakSettings settings_;
  const std::vector<std::string> set_up_;
  std::map<int, FastrakLayout> layouts_;

  State state_ = State::closed;
  std::unique_ptr<SerialPort> port_;
  FastrakDecoder decoder_;
  std::vector<motion::StationSample> samples_;
  double last_reading_ = 0.0;  ///< when records were read last [s]
  std::size_t portion_ = 0;    ///< of set_up_ that is waited for
  Time deadline_{};            ///< closed: when to look again; else: when waiting has been in vain
  int attempts_ = 0;           ///< set-ups in vain since the device last streamed
  bool answered_ = false;      ///< something came since the set-up began …
  bool understood_ = false;    ///< … and it was a FASTRAK's
  bool has_streamed_ = false;
  std::string problem_;  ///< what `health` says while nothing streams
  std::string refusal_;  ///< the device's last error record
  std::string firmware_;
  std::map<std::string, std::size_t> counters_;
};

}  // namespace spring_workbench::fastrak
