#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::fastrak {

// The serial protocol of the Polhemus FASTRAK, from its manual OPM00PI002 (Rev. G, 2012), called "the manual" below.

constexpr int kFastrakStations = 4;

/// Whether `c` is an ASCII letter, independent of the locale.
inline bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

enum class FastrakFormat { ascii, binary };
enum class FastrakUnits { inches, centimetres };

/// One data record: the measurement of one station.
struct FastrakRecord {
  int station = 1;  ///< 1 … 4
  char error =
      ' ';  ///< the device's error letter; blank: none. A warning only: the pose is still the device's best estimate
  Vector3d p_TS = Vector3d::Zero();            ///< position of the receiver S in the transmitter's frame T [m]
  Quaterniond q_TS = Quaterniond::Identity();  ///< norm within 1 % of 1
  bool button = false;                         ///< switch of the stylus; false if the output list does not include it
};

/// Layout of one station's data records: the positions of the items of its output list (the manual's command `O`).
/// Known items: 0, 50 blank; 1, 51 line break; 2, 52 position; 4, 54 azimuth, elevation, roll; 11, 61 quaternion; 16,
/// 66 stylus switch. The second of each pair has more digits in ASCII and is identical in binary.
class FastrakLayout {
 public:
  /// Throws InputError for an unknown item, a list without position or orientation, or records longer than 254 bytes.
  FastrakLayout(const std::vector<int>& items, FastrakFormat format, FastrakUnits units);

  std::size_t length() const { return length_; }  ///< length of a record [bytes], including its header of three bytes

  /// Decodes a record of `length()` bytes. Returns nothing if a byte is invalid (header, blanks, digits, line break), a
  /// number is not finite or not plausible (position beyond 10 m, quaternion not of norm 1, angle out of range), or two
  /// items of one kind differ by more than their resolution.
  std::optional<FastrakRecord> decode(std::string_view bytes) const;

  /// The record as the device sends it, rounded to the digits of the format.
  std::string encode(const FastrakRecord& record) const;

 private:
  enum class Kind { blank, line_end, position, angles, quaternion, button };
  struct Item {
    int number;
    Kind kind;
    int decimals;   ///< digits after the point in ASCII
    bool extended;  ///< has an exponent in ASCII
  };
  /// Up to four numbers, and the resolution with which they are written.
  struct Numbers {
    std::array<double, 4> value{};
    double resolution = 0.0;
  };
  static const Item* find_item(int number);
  static std::size_t count(Kind kind);
  std::size_t number_length(const Item& item) const;
  std::size_t item_length(const Item& item) const;
  std::optional<Numbers> read_numbers(const Item& item, std::string_view bytes) const;
  void write_number(const Item& item, double value, std::string& bytes) const;

  std::vector<const Item*> items_;
  FastrakFormat format_;
  double unit_;  ///< [m]
  std::size_t length_ = 3;
};

/// The output list to request from a station: position, quaternion (`euler`: angles), and the switch if it has one.
/// With `redundant` everything is sent twice, with a blank whose position identifies the station, so that a byte lost,
/// repeated or corrupted on the line cannot pass as a different pose (binary records have no checksum). Otherwise once,
/// followed by a blank or line break.
std::vector<int> fastrak_output_list(int station, FastrakFormat format, bool euler, bool redundant, bool button);

/// The command that requests an output list, e.g. "O1,2,11,16,0\r".
std::string fastrak_list_command(int station, const std::vector<int>& items);

/// The device's mode according to a status record (55 bytes, the reply to `S`).
struct FastrakStatus {
  bool binary = false, centimetres = false, continuous = false;
  std::string firmware;
};
/// Returns nothing if the reply (without its line break) is not a status record.
std::optional<FastrakStatus> read_fastrak_status(const std::string& reply);
/// The status record, with its line break.
std::string write_fastrak_status(const FastrakStatus& status);

}  // namespace spring_workbench::fastrak
