#include <cstdio>

#include "record_numbers.h"
#include "spring_workbench/fastrak/fastrak_protocol.h"

namespace spring_workbench::fastrak {
namespace {

constexpr std::size_t kStatusLength = 53;  // without the line break
constexpr unsigned kBinaryFlag = 1, kCentimetresFlag = 2, kContinuousFlag = 8, kOtherFlags = 0x3F4;

}  // namespace

std::optional<FastrakStatus> read_fastrak_status(const std::string& reply) {
  if (reply.size() != kStatusLength || reply[0] != '2' || reply[2] != 'S') return std::nullopt;
  unsigned flags = 0;
  for (std::size_t i = 3; i < 6; ++i) {
    const char c = reply[i];
    const int digit = is_digit(c) ? c - '0' : c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
    if (digit < 0) return std::nullopt;
    flags = 16 * flags + static_cast<unsigned>(digit);
  }
  FastrakStatus status;
  status.binary = (flags & kBinaryFlag) != 0;
  status.centimetres = (flags & kCentimetresFlag) != 0;
  status.continuous = (flags & kContinuousFlag) != 0;
  const std::string version = reply.substr(15, 6);
  const std::size_t first = version.find_first_not_of(' ');
  if (first != std::string::npos) status.firmware = version.substr(first, version.find_last_not_of(' ') - first + 1);
  return status;
}

std::string write_fastrak_status(const FastrakStatus& status) {
  const unsigned flags = kOtherFlags | (status.binary ? kBinaryFlag : 0) | (status.centimetres ? kCentimetresFlag : 0) |
                         (status.continuous ? kContinuousFlag : 0);
  char text[64];
  std::snprintf(text, sizeof text, "21S%03X    F3F  %6.6s%-32.32s\r\n", flags, status.firmware.c_str(), "simulated");
  return text;
}

}  // namespace spring_workbench::fastrak
