#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::fastrak {

// The numbers of a FASTRAK's records.

/// ASCII, whatever the locale.
inline bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Right-aligned digits with a point before the last `decimals`; the sign first or next to the digits.
std::optional<double> read_fixed(std::string_view text, std::size_t decimals);
/// Sx.xxxxxESxx and a blank.
std::optional<double> read_extended(std::string_view text);
/// IEEE 754, 32 bit, least significant byte first.
double read_float(std::string_view bytes);
void write_float(double value, std::string& bytes);

/// Azimuth, elevation, roll [deg] of R = Rz(azimuth) Ry(elevation) Rx(roll).
std::array<double, 4> to_angles(const Quaterniond& q);
Quaterniond from_angles(const std::array<double, 4>& angles);

}  // namespace spring_workbench::fastrak
