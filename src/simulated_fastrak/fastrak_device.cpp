#include "spring_workbench/simulated_fastrak/fastrak_device.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <utility>

#include "constants.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::simulated_fastrak {

using fastrak::FastrakFormat;
using fastrak::FastrakLayout;
using fastrak::FastrakRecord;
using fastrak::FastrakUnits;
using fastrak::kFastrakStations;

namespace {

constexpr int kFieldMissing = -1, kNotANumber = -2, kOutOfRange = -3, kUnknownCommand = -99;
constexpr char kCtrlK = 0x0b, kCtrlQ = 0x11, kCtrlS = 0x13, kCtrlY = 0x19;
const char* const kCommandsWithArguments = "AHINORelor";

/// Reads the numbers after a command's letter; returns false if one is invalid. Empty fields become NaN.
bool read_arguments(const std::string& text, std::vector<double>& numbers) {
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    char* after = nullptr;
    const double value = std::strtod(word.c_str(), &after);
    if (!word.empty() && (*after != '\0' || !std::isfinite(value))) return false;
    numbers.push_back(word.empty() ? std::nan("") : value);
    begin = end + 1;
  }
  return true;
}

}  // namespace

PlayedMotion::PlayedMotion(const std::vector<motion::StylusSample>& samples, const std::string& name) {
  for (const motion::StylusSample& sample : samples) {
    const Vector3d& p = sample.X.translation();
    if (!(p.cwiseAbs().maxCoeff() < farthest_played)) {
      std::ostringstream text;
      text << p.transpose();
      validation::refuse(name, "position at " + std::to_string(sample.t) + " s", text.str(),
                         "coordinates between -9.99 and 9.99 m");
    }
    if (samples_.empty() || sample.t > samples_.back().t) samples_.push_back(sample);
  }
  if (samples_.empty()) validation::refuse("", name, "at least one sample");
}

motion::StylusSample PlayedMotion::at(double t) const {
  const double length = samples_.back().t - samples_.front().t;
  const double within = samples_.front().t + (length > 0.0 ? std::fmod(t, length) : 0.0);
  const auto later = std::upper_bound(samples_.begin(), samples_.end(), within,
                                      [](double time, const motion::StylusSample& s) { return time < s.t; });
  const motion::StylusSample& a = later == samples_.begin() ? *later : *(later - 1);
  motion::StylusSample sample = a;
  sample.t = t;
  if (later == samples_.end() || later == samples_.begin()) return sample;
  const double u = (within - a.t) / (later->t - a.t);
  sample.X = make_transform((1.0 - u) * a.X.translation() + u * later->X.translation(),
                            Quaterniond(a.X.linear()).slerp(u, Quaterniond(later->X.linear())));
  return sample;
}

FastrakDevice::FastrakDevice(std::vector<PlayedMotion> motions, std::vector<int> switches)
    : motions_(std::move(motions)), switches_(std::move(switches)) {
  if (motions_.empty() || motions_.size() > stations_.size()) {
    validation::refuse("device", "motions",
                       "1, 2, 3 or 4, one for each station, got " + std::to_string(motions_.size()));
  }
  reset();
}

void FastrakDevice::reset() {
  stations_ = {};
  for (std::size_t i = 0; i < motions_.size(); ++i) stations_[i].on = true;
  format_ = FastrakFormat::ascii;
  units_ = FastrakUnits::inches;
  continuous_ = held_ = paused_ = false;
  switch_acts_ = true;
  last_station_ = kFastrakStations;
  command_.clear();
}

void FastrakDevice::leave_in_another_mode() {
  reset();
  continuous_ = true;
}

std::string FastrakDevice::receive(std::string_view bytes) {
  std::string response;
  for (const char c : bytes) {
    if (c == kCtrlS || c == kCtrlQ) {
      paused_ = c == kCtrlS;
    } else if (c == '\r') {
      if (!command_.empty()) response += with_arguments(std::exchange(command_, {}));
    } else if (!command_.empty() || std::string_view(kCommandsWithArguments).find(c) != std::string_view::npos) {
      if (command_.size() < 256) command_ += c;
    } else {
      response += immediate(c);
    }
  }
  return paused_ ? "" : response;
}

std::string FastrakDevice::immediate(char command) {
  switch (command) {
    case 'P':
      return records();
    case 'C':
    case 'c':
      continuous_ = command == 'C';
      held_ = false;
      last_station_ = kFastrakStations;
      return "";
    case 'F':
    case 'f':
      format_ = command == 'f' ? FastrakFormat::binary : FastrakFormat::ascii;
      return "";
    case 'U':
    case 'u':
      units_ = command == 'u' ? FastrakUnits::centimetres : FastrakUnits::inches;
      return "";
    case 'S':
      return fastrak::write_fastrak_status(
          {format_ == FastrakFormat::binary, units_ == FastrakUnits::centimetres, continuous_, "0.1"});
    case 'W':
    case kCtrlY:
      reset();
      return "";
    case kCtrlK:
    case '\n':
      return "";
    default:
      return error(std::string(1, command), kUnknownCommand);
  }
}

std::string FastrakDevice::with_arguments(const std::string& command) {
  std::vector<double> numbers;
  if (!read_arguments(command.substr(1), numbers)) return error(command, kNotANumber);
  if (command[0] == 'o') return "";  // port settings, which do not apply here
  if (std::isnan(numbers[0])) return error(command, kFieldMissing);
  if (numbers[0] < 1.0 || numbers[0] > kFastrakStations) return error(command, kOutOfRange);
  const int number = static_cast<int>(numbers[0]);
  Station& station = stations_[static_cast<std::size_t>(number - 1)];
  numbers.erase(numbers.begin());
  switch (command[0]) {
    case 'O':
      return numbers.empty() || std::none_of(numbers.begin(), numbers.end(), [](double n) { return std::isnan(n); })
                 ? set_list(number, numbers)
                 : error(command, kFieldMissing);
    case 'l':
      return set_active(number, numbers);
    case 'e':
      if (numbers.empty() || !has_switch(number)) return error(command, kFieldMissing);
      if (number == 1) switch_acts_ = numbers[0] != 0.0;
      return "";
    case 'H':
      for (std::size_t i = 0; i < std::min<std::size_t>(3, numbers.size()); ++i) {
        if (!std::isnan(numbers[i])) station.hemisphere[static_cast<Eigen::Index>(i)] = numbers[i];
      }
      return "";
    default:
      return "";
  }
}

std::string FastrakDevice::set_list(int number, const std::vector<double>& arguments) {
  std::vector<int>& items = stations_[static_cast<std::size_t>(number - 1)].items;
  if (arguments.empty()) {
    std::string list = "2" + std::to_string(number) + "O";
    for (const int item : items) list += (item < 10 ? " " : "") + std::to_string(item);
    return list + "\r\n";
  }
  std::vector<int> wanted;
  for (const double item : arguments) wanted.push_back(static_cast<int>(std::clamp(item, -1.0, 99.0)));
  try {
    FastrakLayout(wanted, format_, units_);
  } catch (const validation::InputError&) {
    return error(fastrak::fastrak_list_command(number, wanted), kOutOfRange);
  }
  items = wanted;
  return "";
}

std::string FastrakDevice::set_active(int number, const std::vector<double>& arguments) {
  if (arguments.empty()) {
    std::string text = "2" + std::to_string(number) + "l";
    for (const Station& station : stations_) text += station.on ? '1' : '0';
    return text + "\r\n";
  }
  const bool on = arguments[0] == 1.0 && static_cast<std::size_t>(number) <= motions_.size();
  const bool is_last = next_active(number) == number;
  if (on || !is_last) stations_[static_cast<std::size_t>(number - 1)].on = on;
  return "";
}

/// The next active station after `after`; `after` itself if there is no other.
int FastrakDevice::next_active(int after) const {
  for (int i = 1; i < kFastrakStations; ++i) {
    const int station = (after - 1 + i) % kFastrakStations + 1;
    if (stations_[static_cast<std::size_t>(station - 1)].on) return station;
  }
  return after;
}

bool FastrakDevice::has_switch(int station) const {
  return std::count(switches_.begin(), switches_.end(), station) > 0;
}

std::string FastrakDevice::record(int number) const {
  const Station& station = stations_[static_cast<std::size_t>(number - 1)];
  const motion::StylusSample sample = motions_[static_cast<std::size_t>(number - 1)].at(t_);
  FastrakRecord record;
  record.station = number;
  record.p_TS = sample.X.translation();
  if (record.p_TS.dot(station.hemisphere) < 0.0)
    record.p_TS = -record.p_TS;  // the device cannot distinguish a point from its mirror image
  record.q_TS = Quaterniond(sample.X.linear());
  record.button = has_switch(number) && sample.button;
  return FastrakLayout(station.items, format_, units_).encode(record);
}

std::string FastrakDevice::records() const {
  std::string all;
  for (int station = 1; station <= kFastrakStations; ++station) {
    if (stations_[static_cast<std::size_t>(station - 1)].on) all += record(station);
  }
  return all;
}

std::string FastrakDevice::measure(double t) {
  t_ = t;
  std::string asked_by_switch;
  const bool pressed = motions_[0].at(t).button;
  if (pressed && !pressed_ && switch_acts_) {
    if (continuous_) {
      held_ = !held_;
    } else {
      asked_by_switch = records();
    }
  }
  pressed_ = pressed;
  if (paused_) return "";
  if (!continuous_ || held_) return asked_by_switch;
  last_station_ = next_active(last_station_);
  return record(last_station_);
}

std::string FastrakDevice::error(const std::string& command, int code) {
  std::string shown;
  for (const char c : command) {
    if (c >= ' ' && c <= '~') shown += c;
  }
  return "2 E*ERROR*" + shown.substr(0, 60) + "*ERROR* EC" + std::to_string(code) + "*PS0*FL0*ST0\r\n";
}

}  // namespace spring_workbench::simulated_fastrak
