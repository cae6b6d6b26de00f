#include "spring_workbench/fastrak/fastrak_source.h"

#include <algorithm>
#include <sstream>
#include <thread>

#include "constants.h"
#include "serial_port.h"

namespace spring_workbench::fastrak {
namespace {

using std::chrono::duration;
using std::chrono::steady_clock;

std::string hemisphere_text(const Vector3d& direction) {
  std::ostringstream text;
  text << direction.x() << "," << direction.y() << "," << direction.z();
  return text.str();
}

bool has(const std::vector<int>& stations, int station) {
  return std::count(stations.begin(), stations.end(), station) > 0;
}

std::vector<int> list_of(const FastrakSettings& settings, int station) {
  return fastrak_output_list(station, settings.format, settings.euler, settings.redundant,
                             has(settings.styluses, station));
}

}  // namespace

std::vector<std::string> fastrak_set_up(const FastrakSettings& settings) {
  // Resumes paused output, terminates an incomplete command, stops the stream.
  std::vector<std::string> portions{"\x11\rc"};
  std::string on, off;  // the last active station cannot be switched off, so first switch on, then off
  for (int station = 1; station <= kFastrakStations; ++station) {
    const bool wanted = has(settings.stations, station);
    (wanted ? on : off) += "l" + std::to_string(station) + (wanted ? ",1\r" : ",0\r");
  }
  portions.push_back("u" + on + off);
  for (const int station : settings.stations) {
    const std::string s = std::to_string(station);
    portions.push_back(fastrak_list_command(station, list_of(settings, station)) + "H" + s + "," +
                       hemisphere_text(settings.hemisphere) + "\rI" + s + ",0\r");
    portions.push_back("R" + s + "\rr" + s + ",0,0,0\r");  // the transmitter's own frame
  }
  std::string modes;  // mode 0: in mode 1 the switch would stop the stream
  for (const int station : settings.styluses) modes += "e" + std::to_string(station) + ",0\r";
  portions.push_back(modes + (settings.format == FastrakFormat::binary ? "f" : "F"));
  return portions;
}

FastrakSource::FastrakSource(const FastrakSettings& settings)
    : settings_(settings), set_up_(fastrak_set_up(settings)), problem_(settings.port + ": not opened yet") {
  for (const int station : settings_.stations) {
    layouts_.emplace(station, FastrakLayout(list_of(settings_, station), settings_.format, FastrakUnits::centimetres));
  }
  for (const char* name : {"records", "records with a warning", "bytes skipped", "set-ups",
                           "errors reported by the device", "times the port was lost", "times the stream was lost"}) {
    counters_[name] = 0;
  }
}

FastrakSource::~FastrakSource() {
  try {
    if (port_) port_->write("c");
  } catch (const std::exception&) {
    // The port has disappeared, and the stream with it.
  }
}

std::vector<motion::StationSample> FastrakSource::read(double timeout) {
  const Time end = steady_clock::now() + seconds(timeout);
  do {
    try {
      if (state_ == State::closed) {
        std::this_thread::sleep_until(std::min(end, deadline_));
        if (steady_clock::now() >= deadline_) open();
      } else {
        listen(std::min(end, deadline_));
      }
    } catch (const SerialError& error) {
      if (port_) ++counters_["times the port was lost"];
      close(error.what());
    }
  } while (samples_.empty() && steady_clock::now() < end);
  return std::exchange(samples_, {});
}

steady_clock::duration FastrakSource::time_allowed(double s) const {
  return seconds(s + line_bytes * 10.0 / settings_.baud);
}

void FastrakSource::open() {
  port_ = std::make_unique<SerialPort>(settings_.port, settings_.baud);
  problem_ = settings_.port + ": opened, asking the device for its status";
  begin_set_up();
}

void FastrakSource::close(const std::string& why) {
  port_.reset();
  problem_ = why;
  state_ = State::closed;
  deadline_ = steady_clock::now() + seconds(retry_interval);
}

void FastrakSource::begin_set_up() {
  state_ = State::setting_up;
  ++counters_["set-ups"];
  answered_ = understood_ = false;
  decoder_ = FastrakDecoder();
  portion_ = 0;
  send_portion();
}

void FastrakSource::send_portion() {
  port_->write(set_up_[portion_] + "S");  // its reply confirms that the preceding commands are done
  deadline_ = steady_clock::now() + time_allowed(answer_time);
}

void FastrakSource::listen(Time until) {
  const Time begin = steady_clock::now();
  // If this thread itself is late, the line gets some extra time before it counts as silent.
  const double least = begin >= deadline_ ? late_reader_grace : 0.0;
  const double wait = std::max(least, duration<double>(until - begin).count());
  const std::string bytes = port_->read(wait);
  const Time now = steady_clock::now();
  if (bytes.empty()) {
    if (now >= deadline_) handle_timeout();
    return;
  }
  answered_ = true;
  const std::size_t skipped_before = decoder_.bytes_skipped();
  const auto messages = decoder_.decode(bytes);
  const std::size_t samples_before = samples_.size();
  if (state_ == State::streaming) counters_["bytes skipped"] += decoder_.bytes_skipped() - skipped_before;
  for (const FastrakMessage& message : messages) {
    std::visit([&](const auto& m) { take(m, now); }, message);
  }
  stamp(samples_before, now);
  if (now >= deadline_) handle_timeout();
}

/// Assigns times of receipt to records that were read together: spread evenly since the last reading, but no faster
/// than the line can transmit them.
void FastrakSource::stamp(std::size_t first, Time now) {
  const double end = duration<double>(now.time_since_epoch()).count();
  const std::size_t count = samples_.size() - first;
  double line_time = 0.0;  // transmission time of the later records [s]
  for (std::size_t i = count; i-- > 0;) {
    motion::StationSample& sample = samples_[first + i];
    const double share = static_cast<double>(i + 1) / static_cast<double>(count);
    sample.received = std::max(end - line_time, last_reading_ + (end - last_reading_) * share);
    line_time += static_cast<double>(layouts_.at(sample.station).length()) * 10.0 / settings_.baud;
  }
  if (count > 0) last_reading_ = end;
}

void FastrakSource::take(const FastrakRecord& record, Time now) {
  samples_.push_back({record.station, 0.0, record.p_TS, record.q_TS, record.button, record.error});
  ++counters_["records"];
  if (record.error != ' ') ++counters_["records with a warning"];
  has_streamed_ = true;
  attempts_ = 0;
  deadline_ = now + time_allowed(source_silence);
}

void FastrakSource::take(const FastrakReply& reply, Time) {
  understood_ = true;
  if (reply.text.find("*ERROR*") != std::string::npos) {
    ++counters_["errors reported by the device"];
    refusal_ = reply.text;
  }
  const auto status = read_fastrak_status(reply.text);
  if (!status || state_ != State::setting_up) return;
  firmware_ = status->firmware;
  ++portion_;
  if (portion_ < set_up_.size()) return send_portion();
  if (status->binary == (settings_.format == FastrakFormat::binary) && status->centimetres) return begin_stream();
  problem_ = settings_.port + ": the device does not accept its settings" +
             (refusal_.empty() ? std::string() : ": it reports " + refusal_);
  begin_set_up();
}

void FastrakSource::begin_stream() {
  port_->write("C");
  state_ = State::streaming;
  has_streamed_ = false;
  decoder_ = FastrakDecoder(layouts_);
  deadline_ = steady_clock::now() + time_allowed(source_silence);
}

void FastrakSource::handle_timeout() {
  problem_ = reason_for_silence();
  if (state_ == State::streaming && has_streamed_) ++counters_["times the stream was lost"];
  if (++attempts_ % attempts_per_opening == 0) return close(problem_);
  begin_set_up();
}

std::string FastrakSource::reason_for_silence() const {
  const std::string where = settings_.port + ": ";
  const std::string at_baud = " at " + std::to_string(settings_.baud) + " baud";
  if (state_ == State::streaming) {
    if (has_streamed_) return where + "the stream stopped; setting the device up again";
    const std::string said = refusal_.empty() ? "" : "; it reports " + refusal_;
    return where + "the device answers but sends no data: is a receiver plugged into each socket of `stations`?" + said;
  }
  if (!answered_)
    return where + "silent" + at_baud + ": is the device on, is its cable plugged in, and is its baud rate the same?";
  if (!understood_)
    return where + "the data received" + at_baud +
           " is not a FASTRAK's: is the device set to this baud rate, 8 bits and no parity?";
  return where + "the device stopped answering while it was set up";
}

motion::SourceHealth FastrakSource::health() const {
  motion::SourceHealth health;
  health.streaming = state_ == State::streaming && has_streamed_;
  health.counters = counters_;
  health.text = problem_;
  if (health.streaming) {
    health.text = settings_.port + ": streaming" + (firmware_.empty() ? "" : ", firmware " + firmware_);
  }
  return health;
}

}  // namespace spring_workbench::fastrak
