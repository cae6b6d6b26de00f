#include "spring_workbench/fastrak/fastrak_decoder.h"

#include "constants.h"

namespace spring_workbench::fastrak {
namespace {

bool is_station(char c) { return c >= '1' && c <= '0' + kFastrakStations; }

}  // namespace

FastrakDecoder::FastrakDecoder(const std::map<int, FastrakLayout>& layouts) {
  for (const auto& [station, layout] : layouts) layouts_.at(static_cast<std::size_t>(station - 1)) = layout;
}

std::vector<FastrakMessage> FastrakDecoder::decode(std::string_view bytes) {
  std::vector<FastrakMessage> found;
  pending_.append(bytes);
  std::size_t begin = 0;
  while (begin < pending_.size()) {
    const std::string_view rest = std::string_view(pending_).substr(begin);
    std::size_t length = 0;
    Look look = Look::nothing;
    if (rest[0] == '0') look = look_for_record(rest, found, length);
    if (rest[0] == '2') look = look_for_reply(rest, found, length);
    if (look == Look::unfinished) break;
    if (look == Look::nothing) {
      ++bytes_skipped_;
      length = 1;
    }
    begin += length;
  }
  pending_.erase(0, begin);
  return found;
}

FastrakDecoder::Look FastrakDecoder::look_for_record(std::string_view bytes, std::vector<FastrakMessage>& found,
                                                     std::size_t& length) const {
  if (bytes.size() < 2) return Look::unfinished;
  if (!is_station(bytes[1])) return Look::nothing;
  const auto& layout = layouts_[static_cast<std::size_t>(bytes[1] - '1')];
  if (!layout) return Look::nothing;
  if (bytes.size() > 2 && bytes[2] != ' ' && !is_letter(bytes[2])) return Look::nothing;
  length = layout->length();
  if (bytes.size() < length) return Look::unfinished;
  const auto record = layout->decode(bytes.substr(0, length));
  if (!record) return Look::nothing;
  found.emplace_back(*record);
  return Look::found;
}

FastrakDecoder::Look FastrakDecoder::look_for_reply(std::string_view bytes, std::vector<FastrakMessage>& found,
                                                    std::size_t& length) {
  if (bytes.size() > 1 && bytes[1] != ' ' && !is_station(bytes[1])) return Look::nothing;
  if (bytes.size() > 2 && !is_letter(bytes[2])) return Look::nothing;
  for (std::size_t i = 3; i < bytes.size() && i < longest_reply; ++i) {
    if (bytes[i - 1] == '\r' && bytes[i] == '\n') {
      length = i + 1;
      found.emplace_back(FastrakReply{std::string(bytes.substr(0, i - 1))});
      return Look::found;
    }
    const bool printable = bytes[i] >= ' ' && bytes[i] <= '~';
    if (!printable && bytes[i] != '\r') return Look::nothing;
    if (bytes[i - 1] == '\r') return Look::nothing;
  }
  return bytes.size() < longest_reply ? Look::unfinished : Look::nothing;
}

}  // namespace spring_workbench::fastrak
