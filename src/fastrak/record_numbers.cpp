#include "record_numbers.h"

#include <algorithm>
#include <boost/endian/buffers.hpp>
#include <cmath>
#include <cstring>

namespace spring_workbench::fastrak {
namespace {

constexpr double kDegree = M_PI / 180.0;

using LittleFloat = boost::endian::endian_buffer<boost::endian::order::little, float, 32>;

}  // namespace

std::optional<double> read_fixed(std::string_view text, std::size_t decimals) {
  const std::size_t point = text.size() - decimals - 1;
  double sign = 1.0, digits = 0.0, scale = 1.0;
  bool signed_already = false, in_number = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (i == point ? c == '.' : is_digit(c)) {
      in_number = true;
      if (i == point) continue;
      digits = 10.0 * digits + (c - '0');
      if (i > point) scale *= 10.0;
    } else if (i < point && !in_number && (c == '-' || c == '+') && !signed_already) {
      signed_already = true;
      if (c == '-') sign = -1.0;
    } else if (c != ' ' || in_number) {
      return std::nullopt;
    }
  }
  return sign * (digits / scale);
}

std::optional<double> read_extended(std::string_view text) {
  const auto mantissa = read_fixed(text.substr(0, 8), 5);
  const char sign = text[9];
  if (!mantissa || text[8] != 'E' || (sign != '-' && sign != '+' && sign != ' ') || !is_digit(text[10]) ||
      !is_digit(text[11]) || text[12] != ' ') {
    return std::nullopt;
  }
  const int exponent = 10 * (text[10] - '0') + (text[11] - '0');
  return *mantissa * std::pow(10.0, sign == '-' ? -exponent : exponent);
}

double read_float(std::string_view bytes) {
  LittleFloat value;
  std::memcpy(&value, bytes.data(), sizeof value);
  return static_cast<double>(value.value());
}

void write_float(double value, std::string& bytes) {
  const LittleFloat single(static_cast<float>(value));
  bytes.append(reinterpret_cast<const char*>(single.data()), sizeof single);
}

std::array<double, 4> to_angles(const Quaterniond& q) {
  const Matrix3d R = q.normalized().toRotationMatrix();
  return {std::atan2(R(1, 0), R(0, 0)) / kDegree, std::asin(std::clamp(-R(2, 0), -1.0, 1.0)) / kDegree,
          std::atan2(R(2, 1), R(2, 2)) / kDegree, 0.0};
}

Quaterniond from_angles(const std::array<double, 4>& angles) {
  return Eigen::AngleAxisd(angles[0] * kDegree, Vector3d::UnitZ()) *
         Eigen::AngleAxisd(angles[1] * kDegree, Vector3d::UnitY()) *
         Eigen::AngleAxisd(angles[2] * kDegree, Vector3d::UnitX());
}

}  // namespace spring_workbench::fastrak
