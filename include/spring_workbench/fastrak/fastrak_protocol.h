#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::fastrak {

// What a Polhemus FASTRAK says on its serial line, after the maker's manual OPM00PI002 (Rev. G, 2012): "the manual".

constexpr int kFastrakStations = 4;

/// ASCII, whatever the locale.
inline bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

enum class FastrakFormat { ascii, binary };
enum class FastrakUnits { inches, centimetres };

/// One data record: what one station measured.
struct FastrakRecord {
  int station = 1;   ///< 1 … 4
  char error = ' ';  ///< the device's error letter; blank: none. A warning: the pose is as good as the device could do
  Vector3d p_TS = Vector3d::Zero();            ///< of the receiver S in the transmitter's frame T [m]
  Quaterniond q_TS = Quaterniond::Identity();  ///< its norm within 1 % of 1
  bool button = false;                         ///< the stylus' switch; false where the list does not hold it
};

/// Where the items of one station's output list (the manual's command `O`) stand in its data records.
/// Known items: 0, 50 blank; 1, 51 end of line; 2, 52 position; 4, 54 azimuth, elevation, roll; 11, 61 quaternion;
/// 16, 66 stylus switch. The latter of each pair has more digits in ASCII and is the same in binary.
class FastrakLayout {
 public:
  /// Throws InputError for an unknown item, a list without position or orientation, or with records over 254 bytes.
  FastrakLayout(const std::vector<int>& items, FastrakFormat format, FastrakUnits units);

  std::size_t length() const { return length_; }  ///< of a record, its header of three bytes included

  /// The record in `length()` bytes. Nothing where a byte is not what it must be (header, blanks, digits, end of line),
  /// a number is not finite or no tracker's (position over 10 m, norm of the quaternion not 1, angle out of range), or
  /// two items of a kind differ by more than their digits.
  std::optional<FastrakRecord> decode(std::string_view bytes) const;

  /// The record as the device sends it, rounded to the digits that the format has.
  std::string encode(const FastrakRecord& record) const;

 private:
  enum class Kind { blank, line_end, position, angles, quaternion, button };
  struct Item {
    int number;
    Kind kind;
    int decimals;   ///< digits after the point in ASCII
    bool extended;  ///< in ASCII with an exponent
  };
  /// Up to four numbers, and how far each may be from another writing of the same.
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

/// The output list that a station is asked for: position, quaternion (`euler`: angles), switch where it has one.
/// `redundant`: all of it twice, with a blank whose place marks the station, so that no byte lost, doubled or changed
/// on the line can pass as another pose (binary records have no checksum); else once, and a blank or end of line.
std::vector<int> fastrak_output_list(int station, FastrakFormat format, bool euler, bool redundant, bool button);

/// "O1,2,11,16,0\r": the command that asks for a list.
std::string fastrak_list_command(int station, const std::vector<int>& items);

/// What a status record (55 bytes, the answer to `S`) says of the device's mode.
struct FastrakStatus {
  bool binary = false, centimetres = false, continuous = false;
  std::string firmware;
};
/// Nothing where the reply (without its end of line) is no status record.
std::optional<FastrakStatus> read_fastrak_status(const std::string& reply);
/// The status record, with its end of line.
std::string write_fastrak_status(const FastrakStatus& status);

}  // namespace spring_workbench::fastrak
