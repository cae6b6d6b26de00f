#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "spring_workbench/fastrak/fastrak_protocol.h"

namespace spring_workbench::fastrak {

/// A record other than data: the reply to a command (status, a list read back, an error), without its line break.
struct FastrakReply {
  std::string text;
};

using FastrakMessage = std::variant<FastrakRecord, FastrakReply>;

/// Finds records in a stream of bytes in which records may be truncated, joined, mixed with garbage or in another mode.
/// The same bytes give the same messages, however they are split between calls.
class FastrakDecoder {
 public:
  /// `layouts`: record layouts of the stations that may report. Without any, only replies are found.
  explicit FastrakDecoder(const std::map<int, FastrakLayout>& layouts = {});

  /// Returns the records that are complete with these bytes, in order.
  std::vector<FastrakMessage> decode(std::string_view bytes);

  /// Returns the number of bytes so far that belonged to no record.
  std::size_t bytes_skipped() const { return bytes_skipped_; }

 private:
  enum class Look { found, unfinished, nothing };
  Look look_for_record(std::string_view bytes, std::vector<FastrakMessage>& found, std::size_t& length) const;
  static Look look_for_reply(std::string_view bytes, std::vector<FastrakMessage>& found, std::size_t& length);

  std::array<std::optional<FastrakLayout>, kFastrakStations> layouts_;
  std::string pending_;  ///< bytes of a record that may still be incomplete
  std::size_t bytes_skipped_ = 0;
};

}  // namespace spring_workbench::fastrak
