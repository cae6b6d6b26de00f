#include "spring_workbench/fastrak/fastrak_decoder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "support/fastrak_records.h"

namespace spring_workbench::fastrak::fastrak_decoder_test {
namespace {

using test_support::FastrakMode;
using test_support::Random;
using test_support::same_pose;

const FastrakMode kBinary{FastrakFormat::binary, FastrakUnits::centimetres, false, true};

/// Bytes sent, and the expected records.
struct Stream {
  std::vector<std::string> parts;
  std::vector<FastrakRecord> records;
  std::string bytes() const {
    std::string all;
    for (const std::string& part : parts) all += part;
    return all;
  }
};

Stream random_stream(const FastrakMode& mode, int count, unsigned seed) {
  Random random(seed);
  Stream stream;
  for (int i = 0; i < count; ++i) {
    const FastrakLayout layout = mode.layout(1 + i % 4);
    stream.parts.push_back(layout.encode(test_support::random_record(random, 1 + i % 4)));
    stream.records.push_back(*layout.decode(stream.parts.back()));
  }
  return stream;
}

std::vector<FastrakRecord> records_of(const std::vector<FastrakMessage>& messages) {
  std::vector<FastrakRecord> records;
  for (const FastrakMessage& message : messages) {
    if (const auto* record = std::get_if<FastrakRecord>(&message)) records.push_back(*record);
  }
  return records;
}

std::vector<FastrakRecord> decode(const FastrakMode& mode, const std::string& bytes) {
  return records_of(FastrakDecoder(mode.layouts()).decode(bytes));
}

bool all_were_sent(const std::vector<FastrakRecord>& got, const std::vector<FastrakRecord>& sent) {
  return std::all_of(got.begin(), got.end(), [&](const FastrakRecord& g) {
    return std::any_of(sent.begin(), sent.end(), [&](const FastrakRecord& s) { return same_pose(g, s); });
  });
}

TEST(FastrakDecoder, FindsEveryRecordOfACleanStreamAndNothingElse) {
  for (const auto& mode : test_support::all_modes()) {
    const Stream stream = random_stream(mode, 200, 1);
    FastrakDecoder decoder(mode.layouts());
    const auto got = records_of(decoder.decode(stream.bytes()));
    ASSERT_EQ(got.size(), stream.records.size());
    for (std::size_t i = 0; i < got.size(); ++i) EXPECT_TRUE(same_pose(got[i], stream.records[i]));
    EXPECT_EQ(decoder.bytes_skipped(), 0u);
  }
}

/// Data, a status, an error record and leading noise: the messages are the same wherever the bytes are split.
TEST(FastrakDecoder, SplittingMakesNoDifferenceAtAnyPoint) {
  for (const auto& mode : test_support::all_modes()) {
    Stream stream = random_stream(mode, 3, 2);
    const std::string noise = "x01 y2", status = write_fastrak_status({});
    const std::string bytes = noise + stream.parts[0] + status + stream.parts[1] + "2 E*ERROR*Q*ERROR* EC-99\r\n" +
                              stream.parts[2] + write_fastrak_status({});
    FastrakDecoder at_once(mode.layouts());
    const auto whole = at_once.decode(bytes);
    EXPECT_EQ(at_once.bytes_skipped(), noise.size());
    ASSERT_EQ(records_of(whole).size(), 3u);
    ASSERT_EQ(whole.size(), 6u);
    EXPECT_EQ(std::get<FastrakReply>(whole[1]).text, status.substr(0, 53));
    for (std::size_t cut = 0; cut <= bytes.size(); ++cut) {
      FastrakDecoder decoder(mode.layouts());
      auto got = decoder.decode(bytes.substr(0, cut));
      for (const auto& message : decoder.decode(bytes.substr(cut))) got.push_back(message);
      ASSERT_EQ(got.size(), whole.size()) << cut;
      const auto records = records_of(got);
      for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(same_pose(records[i], stream.records[i])) << cut;
    }
    FastrakDecoder one_by_one(mode.layouts());
    std::size_t count = 0;
    for (const char c : bytes) count += one_by_one.decode(std::string(1, c)).size();
    EXPECT_EQ(count, whole.size());
    EXPECT_EQ(one_by_one.bytes_skipped(), noise.size());
  }
}

/// Each byte lost, each byte repeated: no pose that was not sent; only the affected record is lost and, in binary, the
/// next one if the two together look like one.
TEST(FastrakDecoder, OneByteLostOrDoubledCostsOneRecord) {
  for (const auto& mode : test_support::all_modes()) {
    const Stream stream = random_stream(mode, 5, 3);
    const std::string bytes = stream.bytes();
    for (std::size_t at = 0; at < bytes.size(); ++at) {
      for (const bool doubled : {false, true}) {
        std::string spoilt = bytes;
        if (doubled) {
          spoilt.insert(at, 1, bytes[at]);
        } else {
          spoilt.erase(at, 1);
        }
        const auto got = decode(mode, spoilt);
        ASSERT_TRUE(all_were_sent(got, stream.records)) << at << doubled;
        ASSERT_GE(got.size(), 4u) << at << doubled;
      }
    }
  }
}

TEST(FastrakDecoder, NoWrongPosePassesWhateverHappensToTheBytes) {
  std::mt19937 random(7);
  const auto below = [&](std::size_t end) { return std::uniform_int_distribution<std::size_t>(0, end - 1)(random); };
  for (unsigned seed = 0; seed < 2000; ++seed) {
    const Stream stream = random_stream(kBinary, 12, seed);
    std::string bytes = stream.bytes();
    for (std::size_t hits = 1 + below(8); hits > 0; --hits) {
      const std::size_t at = below(bytes.size()), size = 1 + below(std::min<std::size_t>(100, bytes.size() - at));
      switch (below(5)) {
        case 0:  // lost
          bytes.erase(at, std::min(size, bytes.size() - 1));
          break;
        case 1:  // changed
          for (std::size_t i = at; i < at + size; ++i) bytes[i] = static_cast<char>(below(256));
          break;
        case 2:  // added
          for (std::size_t i = 0; i < size; ++i) bytes.insert(at, 1, static_cast<char>(below(256)));
          break;
        case 3:  // doubled
          bytes.insert(below(bytes.size()), bytes.substr(at, size));
          break;
        default:  // a bit
          bytes[at] = static_cast<char>(static_cast<unsigned char>(bytes[at]) ^ (1U << below(8)));
      }
    }
    const Stream after = random_stream(kBinary, 6, seed + 1000000);
    const auto got = decode(kBinary, bytes + after.bytes());
    std::vector<FastrakRecord> sent = stream.records;
    sent.insert(sent.end(), after.records.begin(), after.records.end());
    ASSERT_TRUE(all_were_sent(got, sent)) << seed;
    // A header in garbage can cost a record or two; then the stream is found again.
    ASSERT_GE(got.size(), 4u) << seed;
    for (std::size_t i = 0; i < 4; ++i) {
      ASSERT_TRUE(same_pose(got[got.size() - 4 + i], after.records[2 + i])) << seed;
    }
  }
}

/// 10.012008666992188 is 0 1 blank A in bytes, which looks like a header.
TEST(FastrakDecoder, RecoversFromAFalseStart) {
  FastrakMode plain = kBinary;
  plain.redundant = false;
  plain.units = FastrakUnits::inches;
  for (const FastrakMode& mode : {kBinary, plain}) {
    FastrakRecord record;
    record.p_TS = Vector3d::Constant(10.012008666992188) * (mode.units == FastrakUnits::inches ? 0.0254 : 0.01);
    const std::string bytes = mode.layout(1).encode(record);
    ASSERT_EQ(bytes.substr(3, 4), "01 A");
    std::string stream = bytes.substr(1);  // its header was lost
    for (int i = 0; i < 10; ++i) stream += bytes;
    const auto got = decode(mode, stream);
    EXPECT_EQ(got.size(), 10u);
    for (const auto& g : got) EXPECT_LT((g.p_TS - record.p_TS).norm(), 1e-12);
  }
}

TEST(FastrakDecoder, AnotherModeThanTheAskedGivesNothing) {
  for (const auto& asked : test_support::all_modes()) {
    for (const auto& sent : test_support::all_modes()) {
      const bool alike = asked.format == sent.format && asked.euler == sent.euler && asked.redundant == sent.redundant;
      if (alike || !asked.redundant) continue;
      EXPECT_TRUE(decode(asked, random_stream(sent, 100, 9).bytes()).empty());
    }
  }
}

TEST(FastrakDecoder, StationsThatWereNotRequestedAreIgnored) {
  const std::map<int, FastrakLayout> only_two{{2, kBinary.layout(2)}};
  const Stream stream = random_stream(kBinary, 40, 10);
  FastrakDecoder decoder(only_two);
  const auto got = records_of(decoder.decode(stream.bytes()));
  EXPECT_EQ(got.size(), 10u);
  for (const auto& record : got) EXPECT_EQ(record.station, 2);
  EXPECT_GT(decoder.bytes_skipped(), 0u);
}

}  // namespace
}  // namespace spring_workbench::fastrak::fastrak_decoder_test
