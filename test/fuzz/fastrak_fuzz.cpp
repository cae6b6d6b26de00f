#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "fuzz/targets.h"
#include "spring_workbench/fastrak/fastrak_decoder.h"

namespace spring_workbench::fuzz {
namespace {

std::map<int, fastrak::FastrakLayout> layouts_of(unsigned mode) {
  const auto format = (mode & 1U) != 0 ? fastrak::FastrakFormat::binary : fastrak::FastrakFormat::ascii;
  const auto units = (mode & 2U) != 0 ? fastrak::FastrakUnits::centimetres : fastrak::FastrakUnits::inches;
  const bool euler = (mode & 4U) != 0, redundant = (mode & 8U) != 0;
  std::map<int, fastrak::FastrakLayout> layouts;
  for (int station = 1; station <= fastrak::kFastrakStations; ++station) {
    if (((mode >> (3 + static_cast<unsigned>(station))) & 1U) != 0) continue;  // off
    layouts.emplace(
        station, fastrak::FastrakLayout(fastrak::fastrak_output_list(station, format, euler, redundant, station == 1),
                                        format, units));
  }
  return layouts;
}

bool same(const fastrak::FastrakMessage& a, const fastrak::FastrakMessage& b) {
  if (a.index() != b.index()) return false;
  if (const auto* reply = std::get_if<fastrak::FastrakReply>(&a))
    return reply->text == std::get<fastrak::FastrakReply>(b).text;
  const auto &x = std::get<fastrak::FastrakRecord>(a), &y = std::get<fastrak::FastrakRecord>(b);
  return x.station == y.station && x.error == y.error && x.p_TS == y.p_TS && x.q_TS.coeffs() == y.q_TS.coeffs() &&
         x.button == y.button;
}

void check(const fastrak::FastrakMessage& message, const std::map<int, fastrak::FastrakLayout>& layouts) {
  if (const auto* reply = std::get_if<fastrak::FastrakReply>(&message)) {
    require(reply->text.size() >= 2 && reply->text.size() < 256, "a reply has 2 … 255 characters");
    fastrak::read_fastrak_status(reply->text);
    return;
  }
  const auto& record = std::get<fastrak::FastrakRecord>(message);
  require(layouts.count(record.station) == 1, "only stations that were asked report");
  require(record.p_TS.allFinite() && record.p_TS.cwiseAbs().maxCoeff() <= 10.0 + 1e-9, "the position is a tracker's");
  require(std::abs(record.q_TS.norm() - 1.0) <= 0.01, "the quaternion is a rotation");
}

}  // namespace

void fastrak(std::string_view input) {
  if (input.size() < 2) return;
  static const auto all_layouts = [] {
    std::vector<std::map<int, fastrak::FastrakLayout>> all;
    for (unsigned mode = 0; mode < 256; ++mode) all.push_back(layouts_of(mode));
    return all;
  }();
  const auto& layouts = all_layouts[static_cast<unsigned char>(input[0])];
  const std::size_t step = 1U + static_cast<unsigned char>(input[1]);
  const std::string_view bytes = input.substr(2);
  fastrak::FastrakDecoder whole(layouts), pieces(layouts);
  const auto messages = whole.decode(bytes);
  require(whole.bytes_skipped() <= bytes.size(), "no more bytes are left out than came");
  std::vector<fastrak::FastrakMessage> again;
  for (std::size_t i = 0; i < bytes.size(); i += step) {
    for (const fastrak::FastrakMessage& message : pieces.decode(bytes.substr(i, step))) again.push_back(message);
  }
  require(messages.size() == again.size() && std::equal(messages.begin(), messages.end(), again.begin(), same),
          "how the bytes are split makes no difference");
  for (const fastrak::FastrakMessage& message : messages) check(message, layouts);
}

}  // namespace spring_workbench::fuzz
