#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::fastrak {

// Conversion of the numbers in FASTRAK records.

/// Whether `c` is an ASCII digit, independent of the locale.
inline bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Reads right-aligned digits with a point before the last `decimals`; the sign is first or next to the digits.
std::optional<double> read_fixed(std::string_view text, std::size_t decimals);
/// Reads the format Sx.xxxxxESxx, followed by a blank.
std::optional<double> read_extended(std::string_view text);
/// Reads a 32-bit IEEE 754 number, least significant byte first.
double read_float(std::string_view bytes);
void write_float(double value, std::string& bytes);

/// Azimuth, elevation, roll [deg] of R = Rz(azimuth) Ry(elevation) Rx(roll).
std::array<double, 4> to_angles(const Quaterniond& q);
Quaterniond from_angles(const std::array<double, 4>& angles);

}  // namespace spring_workbench::fastrak
