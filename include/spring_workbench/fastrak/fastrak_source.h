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

/// How a FASTRAK is connected and what it is configured to send.
struct FastrakSettings {
  std::string port = "/dev/ttyUSB0";
  int baud = 115200;  ///< as set by the switches on the back of the device: 2400, 4800 … 115200
  FastrakFormat format = FastrakFormat::binary;
  std::vector<int> stations = {1};  ///< each 1 … 4, without duplicates; n stations report at 120 Hz / n each
  std::vector<int> styluses = {1};  ///< stations whose switch is read
  bool euler = false;               ///< whether to request angles instead of quaternions
  bool redundant = true;            ///< sends every pose twice to detect line errors (fastrak_output_list)
  Vector3d hemisphere =
      Vector3d::UnitX();  ///< points into the half-space of the stations, in T; zero: tracked by the device
};

/// The keys of read_fastrak_settings.
const std::vector<std::string>& fastrak_keys();

/// Reads a map: `port`, `baud`, `format` (binary, ascii), `stations` (list), `orientation` (quaternion, euler),
/// `redundant`, `hemisphere` (x y z), `stylus` (true: station 1; false: none; or a list). Ignores other keys. Throws
/// InputError with `where`, key, value and rule.
FastrakSettings read_fastrak_settings(const YAML::Node& map, const std::string& where);

/// The commands that put the device into the mode of the settings from any other mode, in chunks that its input buffer
/// can take. A further `C` then starts the stream.
std::vector<std::string> fastrak_set_up(const FastrakSettings& settings);

/// A FASTRAK on a serial port. It is configured again whenever nothing, or nothing intelligible, has arrived for 0.25
/// s.
class FastrakSource : public motion::LiveSource {
 public:
  /// Does not open the port yet; read() does.
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
  void handle_timeout();
  std::string reason_for_silence() const;
  std::chrono::steady_clock::duration time_allowed(double s) const;

  const FastrakSettings settings_;
  const std::vector<std::string> set_up_;
  std::map<int, FastrakLayout> layouts_;

  State state_ = State::closed;
  std::unique_ptr<SerialPort> port_;
  FastrakDecoder decoder_;
  std::vector<motion::StationSample> samples_;
  double last_reading_ = 0.0;  ///< time at which records were last read [s]
  std::size_t portion_ = 0;    ///< index of the chunk of `set_up_` whose reply is awaited
  Time deadline_{};            ///< if closed, the time of the next attempt to open; otherwise when waiting times out
  int attempts_ = 0;           ///< failed set-ups since the device last streamed
  bool answered_ = false;      ///< whether anything has arrived since the set-up began …
  bool understood_ = false;    ///< … and whether it came from a FASTRAK
  bool has_streamed_ = false;
  std::string problem_;  ///< text of `health` while not streaming
  std::string refusal_;  ///< the device's last error record
  std::string firmware_;
  std::map<std::string, std::size_t> counters_;
};

}  // namespace spring_workbench::fastrak
