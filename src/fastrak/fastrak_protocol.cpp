#include "spring_workbench/fastrak/fastrak_protocol.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "constants.h"
#include "record_numbers.h"
#include "spring_workbench/config/yaml_fields.h"

namespace spring_workbench::fastrak {
namespace {

constexpr std::size_t kHeaderLength = 3;
constexpr std::size_t kLongestRecord = 254;  // the manual, command O
constexpr std::size_t kNumberLength = 7;     // Sxxx.xx, Sx.xxxx
constexpr std::size_t kExtendedLength = 13;  // Sx.xxxxxESxx and a blank

bool all_within(const std::array<double, 4>& values, double limit) {
  return std::all_of(values.begin(), values.end(), [&](double v) { return std::abs(v) <= limit; });
}

}  // namespace

const FastrakLayout::Item* FastrakLayout::find_item(int number) {
  static const Item items[] = {
      {0, Kind::blank, 0, false},      {50, Kind::blank, 0, false},   {1, Kind::line_end, 0, false},
      {51, Kind::line_end, 0, false},  {2, Kind::position, 2, false}, {52, Kind::position, 5, true},
      {4, Kind::angles, 2, false},     {54, Kind::angles, 5, true},   {11, Kind::quaternion, 4, false},
      {61, Kind::quaternion, 5, true}, {16, Kind::button, 0, false},  {66, Kind::button, 0, false}};
  const auto* const found =
      std::find_if(std::begin(items), std::end(items), [&](auto& i) { return i.number == number; });
  return found == std::end(items) ? nullptr : found;
}

std::size_t FastrakLayout::count(Kind kind) { return kind == Kind::quaternion ? 4 : 3; }

std::size_t FastrakLayout::number_length(const Item& item) const {
  if (format_ == FastrakFormat::binary) return 4;
  return item.extended ? kExtendedLength : kNumberLength;
}

std::size_t FastrakLayout::item_length(const Item& item) const {
  switch (item.kind) {
    case Kind::blank:
      return 1;
    case Kind::line_end:
    case Kind::button:
      return 2;
    default:
      return count(item.kind) * number_length(item);
  }
}

FastrakLayout::FastrakLayout(const std::vector<int>& items, FastrakFormat format, FastrakUnits units)
    : format_(format), unit_(units == FastrakUnits::inches ? 0.0254 : 0.01) {
  bool has_position = false, has_orientation = false;
  for (const int number : items) {
    const Item* item = find_item(number);
    if (item == nullptr)
      validation::refuse("output list", "item", std::to_string(number), "0, 1, 2, 4, 11, 16, or these plus 50");
    has_position |= item->kind == Kind::position;
    has_orientation |= item->kind == Kind::angles || item->kind == Kind::quaternion;
    items_.push_back(item);
    length_ += item_length(*item);
  }
  if (!has_position || !has_orientation) validation::refuse("", "output list", "a position and an orientation");
  if (length_ > kLongestRecord) validation::refuse("", "output list", "records of at most 254 bytes");
}

std::optional<FastrakLayout::Numbers> FastrakLayout::read_numbers(const Item& item, std::string_view bytes) const {
  Numbers numbers;
  const std::size_t width = number_length(item);
  for (std::size_t i = 0; i < count(item.kind); ++i) {
    const std::string_view text = bytes.substr(i * width, width);
    if (format_ == FastrakFormat::binary) {
      numbers.value[i] = read_float(text);
    } else {
      const auto value =
          item.extended ? read_extended(text) : read_fixed(text, static_cast<std::size_t>(item.decimals));
      if (!value) return std::nullopt;
      numbers.value[i] = *value;
    }
    if (!std::isfinite(numbers.value[i])) return std::nullopt;
  }
  if (format_ == FastrakFormat::ascii && !item.extended) numbers.resolution = std::pow(10.0, -item.decimals);
  return numbers;
}

std::optional<FastrakRecord> FastrakLayout::decode(std::string_view bytes) const {
  FastrakRecord record;
  if (bytes.size() != length_ || bytes[0] != '0' || bytes[1] < '1' || bytes[1] > '0' + kFastrakStations ||
      (bytes[2] != ' ' && !is_letter(bytes[2]))) {
    return std::nullopt;
  }
  record.station = bytes[1] - '0';
  record.error = bytes[2];
  std::map<Kind, Numbers> known;
  std::optional<bool> button;
  // Keeps the value with the finer resolution of two that must agree; returns whether they do.
  const auto merge = [&](Kind kind, const std::optional<Numbers>& read) {
    if (!read) return false;
    const auto [entry, is_first] = known.try_emplace(kind, *read);
    Numbers& before = entry->second;
    const double slack = format_ == FastrakFormat::binary ? 0.0 : extended_resolution;
    const double coarser = 0.5 * std::max(read->resolution, before.resolution);
    for (std::size_t i = 0; i < 4 && !is_first; ++i) {
      const double difference = std::abs(read->value[i] - before.value[i]);
      if (!(difference <= coarser + slack * (1.0 + std::abs(before.value[i])))) return false;
    }
    if (read->resolution < before.resolution) before = *read;
    return true;
  };
  std::size_t at = kHeaderLength;
  for (const Item* item : items_) {
    const std::string_view part = bytes.substr(at, item_length(*item));
    at += part.size();
    switch (item->kind) {
      case Kind::blank:
        if (part != " ") return std::nullopt;
        break;
      case Kind::line_end:
        if (part != "\r\n") return std::nullopt;
        break;
      case Kind::button:
        if (part != " 0" && part != " 1") return std::nullopt;
        if (button && *button != (part[1] == '1')) return std::nullopt;
        button = part[1] == '1';
        break;
      default:
        if (!merge(item->kind, read_numbers(*item, part))) return std::nullopt;
    }
  }
  const auto& p = known.at(Kind::position).value;
  if (!all_within(p, farthest_measured / unit_)) return std::nullopt;
  record.p_TS = unit_ * Vector3d(p[0], p[1], p[2]);
  if (const auto quaternion = known.find(Kind::quaternion); quaternion != known.end()) {
    const auto& q = quaternion->second.value;
    record.q_TS = Quaterniond(q[0], q[1], q[2], q[3]);
    if (!(std::abs(record.q_TS.norm() - 1.0) <= norm_tolerance)) return std::nullopt;
  } else {
    const auto& angles = known.at(Kind::angles).value;
    if (!all_within(angles, 180.0)) return std::nullopt;
    record.q_TS = from_angles(angles);
  }
  record.button = button.value_or(false);
  return record;
}

void FastrakLayout::write_number(const Item& item, double value, std::string& bytes) const {
  if (format_ == FastrakFormat::binary) return write_float(value, bytes);
  char text[64];
  std::snprintf(text, sizeof text, item.extended ? "%12.*E " : "%7.*f", item.decimals, value);
  bytes += text;
}

std::string FastrakLayout::encode(const FastrakRecord& record) const {
  std::string bytes{'0', static_cast<char>('0' + record.station), record.error};
  const auto write = [&](const Item& item, const std::array<double, 4>& values) {
    for (std::size_t i = 0; i < count(item.kind); ++i) write_number(item, values[i], bytes);
  };
  const Vector3d p = record.p_TS / unit_;
  const Quaterniond& q = record.q_TS;
  for (const Item* item : items_) {
    switch (item->kind) {
      case Kind::blank:
        bytes += ' ';
        break;
      case Kind::line_end:
        bytes += "\r\n";
        break;
      case Kind::button:
        bytes += record.button ? " 1" : " 0";
        break;
      case Kind::position:
        write(*item, {p.x(), p.y(), p.z(), 0.0});
        break;
      case Kind::angles:
        write(*item, to_angles(q));
        break;
      case Kind::quaternion:
        write(*item, {q.w(), q.x(), q.y(), q.z()});
        break;
    }
  }
  return bytes;
}

std::vector<int> fastrak_output_list(int station, FastrakFormat format, bool euler, bool redundant, bool button) {
  const int orientation = euler ? 4 : 11;
  std::vector<int> items{2, orientation};
  if (button) items.push_back(16);
  if (redundant) {  // the second copy follows the first: halves of two different records do not agree
    items.insert(items.end(), {52, orientation + 50});
    if (button) items.push_back(66);
    items.insert(items.begin() + station, 0);
  }
  if (format == FastrakFormat::ascii) {
    items.push_back(1);
  } else if (!redundant) {
    items.push_back(0);
  }
  return items;
}

std::string fastrak_list_command(int station, const std::vector<int>& items) {
  std::string command = "O" + std::to_string(station);
  for (const int item : items) command += "," + std::to_string(item);
  return command + "\r";
}

}  // namespace spring_workbench::fastrak
