#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>

#include "spring_workbench/rod/settings.h"

namespace spring_workbench::fuzz {

/// Interprets bytes as choices and numbers; zeros after the end.
class Choices {
 public:
  explicit Choices(std::string_view bytes) : bytes_(bytes) {}

  bool over() const { return at_ >= bytes_.size(); }
  unsigned byte() { return over() ? 0U : static_cast<unsigned char>(bytes_[at_++]); }
  bool flag() { return (byte() & 1U) != 0; }
  /// Any number, with a preference for the limits of allowed ranges.
  double number() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr std::array<double, 16> rims{
        0.0, -0.0, -1.0, 1e-300, 1e-6, 1e-3,  0.02,     0.5,
        1.0, 10.0, 1e3,  1e6,    1e12, 1e300, infinity, std::numeric_limits<double>::quiet_NaN()};
    const unsigned choice = byte();
    if (choice < rims.size()) return rims[choice];
    if (choice >= 0xf0) {
      std::array<char, 8> raw{};
      for (char& c : raw) c = static_cast<char>(byte());
      double value;
      std::memcpy(&value, raw.data(), sizeof value);
      return value;
    }
    return (choice - 128.0) / 128.0;
  }
  /// A number within what a hand can do and the input filter accepts, or not finite.
  double hand_number() {
    const double value = number();
    return std::isfinite(value) ? std::clamp(value, -2.0, 2.0) : value;
  }
  /// A positive number between these powers of ten, evenly by its logarithm.
  double between_powers(double low, double high) { return std::pow(10.0, low + (high - low) * byte() / 255.0); }
  rod::PerDofChange<double> per_dof() {
    const double stretch = number(), bend = number();
    return {stretch, bend, number()};
  }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

}  // namespace spring_workbench::fuzz
