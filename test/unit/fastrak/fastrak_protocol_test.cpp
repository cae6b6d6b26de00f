#include "spring_workbench/fastrak/fastrak_protocol.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "spring_workbench/validation/input_error.h"
#include "support/fastrak_records.h"

namespace spring_workbench::fastrak::fastrak_protocol_test {
namespace {

using test_support::Random;

constexpr double kInch = 0.0254;

Matrix3d rotation_about_z_y_x(double azimuth, double elevation, double roll) {
  const double degree = M_PI / 180.0;
  return (Eigen::AngleAxisd(azimuth * degree, Vector3d::UnitZ()) *
          Eigen::AngleAxisd(elevation * degree, Vector3d::UnitY()) *
          Eigen::AngleAxisd(roll * degree, Vector3d::UnitX()))
      .toRotationMatrix();
}

TEST(FastrakLayout, ReadsTheDefaultListWhereverTheSignStands) {
  const FastrakLayout layout({2, 4, 1}, FastrakFormat::ascii, FastrakUnits::inches);
  for (const char* text :
       {"01   12.34  -5.60  -0.78  90.00 -12.50 179.99\r\n", "01   12.34-  5.60-  0.78  90.00- 12.50 179.99\r\n",
        "01 + 12.34-005.60  -0.78 +90.00 -12.50 179.99\r\n"}) {
    const auto record = layout.decode(text);
    ASSERT_TRUE(record) << text;
    EXPECT_EQ(record->station, 1);
    EXPECT_EQ(record->error, ' ');
    EXPECT_LT((record->p_TS - kInch * Vector3d(12.34, -5.60, -0.78)).norm(), 1e-15);
    EXPECT_LT((record->q_TS.toRotationMatrix() - rotation_about_z_y_x(90.0, -12.5, 179.99)).norm(), 1e-15);
  }
}

TEST(FastrakLayout, ReadsFieldsThatTouch) {
  const FastrakLayout layout({2, 4, 1}, FastrakFormat::ascii, FastrakUnits::centimetres);
  const auto record = layout.decode("03k-123.45-100.00-200.00-179.99 -89.99-170.00\r\n");
  ASSERT_TRUE(record);
  EXPECT_EQ(record->station, 3);
  EXPECT_EQ(record->error, 'k');
  EXPECT_LT((record->p_TS - Vector3d(-1.2345, -1.0, -2.0)).norm(), 1e-15);
}

TEST(FastrakLayout, ReadsExtendedPrecision) {
  const FastrakLayout layout({52, 61, 1}, FastrakFormat::ascii, FastrakUnits::inches);
  const std::string text =
      "01  1.23400E+01 -5.60000E+00 -7.80000E-01  5.00000E-01  5.00000E-01 -5.00000E-01  5.00000E-01 \r\n";
  EXPECT_EQ(layout.length(), 96u);
  const auto record = layout.decode(text);
  ASSERT_TRUE(record);
  EXPECT_LT((record->p_TS - kInch * Vector3d(12.34, -5.60, -0.78)).norm(), 1e-15);
  EXPECT_LT((record->q_TS.coeffs() - Quaterniond(0.5, 0.5, -0.5, 0.5).coeffs()).norm(), 1e-15);
  EXPECT_EQ(layout.encode(*record), text);
}

TEST(FastrakLayout, ReadsBinaryFloatsLeastByteFirst) {
  const FastrakLayout layout({2, 11, 0}, FastrakFormat::binary, FastrakUnits::inches);
  const char bytes[] =
      "\x30\x31\x20\x00\x00\x20\x41\x00\x00\x90\xc0\x00\x00\x10\x40\x00\x00\x00\x3f\x00\x00\x00\x3f\x00\x00\x00\xbf"
      "\x00\x00\x00\x3f\x20";
  const auto record = layout.decode(std::string_view(bytes, 32));
  ASSERT_TRUE(record);
  EXPECT_LT((record->p_TS - kInch * Vector3d(10.0, -4.5, 2.25)).norm(), 1e-15);
  EXPECT_EQ(record->q_TS.coeffs(), Quaterniond(0.5, 0.5, -0.5, 0.5).coeffs());

  const FastrakLayout with_switch({2, 11, 16, 0}, FastrakFormat::binary, FastrakUnits::inches);
  const char pressed[] =
      "\x30\x31\x6b\x00\x00\x40\x3e\x00\x00\x40\x42\x00\x00\xf0\xc1\x00\x00\x80\x3f\x00\x00\x00\x00\x00\x00\x00\x00"
      "\x00\x00\x00\x00\x20\x31\x20";
  const auto held = with_switch.decode(std::string_view(pressed, 34));
  ASSERT_TRUE(held);
  EXPECT_EQ(held->error, 'k');
  EXPECT_TRUE(held->button);
  EXPECT_LT((held->p_TS - kInch * Vector3d(0.1875, 48.0, -30.0)).norm(), 1e-15);
}

/// Known values: azimuth 30, elevation 20, roll 10 degrees give this first column of R and this quaternion.
TEST(FastrakLayout, AnglesAreThoseOfTheManual) {
  const FastrakLayout layout({2, 4, 1}, FastrakFormat::ascii, FastrakUnits::inches);
  const auto record = layout.decode("01    0.00   0.00   0.00  30.00  20.00  10.00\r\n");
  ASSERT_TRUE(record);
  EXPECT_LT((record->q_TS.toRotationMatrix().col(0) - Vector3d(0.8138, 0.4698, -0.3420)).norm(), 1e-4);
  EXPECT_LT((record->q_TS.coeffs() - Quaterniond(0.9515, 0.0381, 0.1893, 0.2393).coeffs()).norm(), 1e-4);
}

TEST(FastrakLayout, WhatIsEncodedIsDecodedToTheDigitsOfTheFormat) {
  Random random(3);
  for (const auto& mode : test_support::all_modes()) {
    const double digits_p = mode.format == FastrakFormat::binary ? 1e-6 : mode.redundant ? 2e-5 : 0.5e-4 * 2.54;
    const double digits_R = mode.format == FastrakFormat::binary ? 1e-6 : 4e-4;
    for (int i = 0; i < 200; ++i) {
      const FastrakRecord sent = test_support::random_record(random, 1 + i % 4);
      const FastrakLayout layout = mode.layout(sent.station);
      const std::string bytes = layout.encode(sent);
      ASSERT_EQ(bytes.size(), layout.length());
      const auto got = layout.decode(bytes);
      ASSERT_TRUE(got) << bytes;
      EXPECT_EQ(got->station, sent.station);
      EXPECT_EQ(got->error, sent.error);
      EXPECT_EQ(got->button, sent.button && sent.station == 1);
      EXPECT_LT((got->p_TS - sent.p_TS).cwiseAbs().maxCoeff(), digits_p * 1.01);
      EXPECT_LT((got->q_TS.toRotationMatrix() - sent.q_TS.toRotationMatrix()).norm(), digits_R);
    }
  }
}

/// Redundant lists, for a line without checksum: if any byte of a record is changed to any value, the record is refused
/// or gives the pose that was sent. In ASCII only digits beyond the shorter of the two copies may differ.
TEST(FastrakLayout, NoChangedByteOfARedundantRecordGivesAnotherPose) {
  Random random(4);
  for (const auto& mode : test_support::all_modes()) {
    if (!mode.redundant) continue;
    const double p_digits = mode.format == FastrakFormat::binary ? 0.0 : 0.0151 * 0.0254;
    const double R_digits = mode.format == FastrakFormat::binary ? 0.0 : 2e-3;
    std::size_t refused = 0, looked = 0;
    for (int station = 1; station <= kFastrakStations; ++station) {
      const std::string bytes = mode.layout(station).encode(test_support::random_record(random, station));
      const auto sent = mode.layout(station).decode(bytes);
      ASSERT_TRUE(sent);
      for (std::size_t at = 0; at < bytes.size(); ++at) {
        for (int value = 0; value < 256; ++value) {
          std::string changed = bytes;
          changed[at] = static_cast<char>(value);
          const int says = changed[1] - '0';
          if (changed == bytes || says < 1 || says > kFastrakStations) continue;
          ++looked;
          const auto got = mode.layout(says).decode(changed);
          if (!got && ++refused) continue;
          ASSERT_EQ(got->station, station) << at << " " << value;
          ASSERT_EQ(got->button, sent->button);
          ASSERT_LE((got->p_TS - sent->p_TS).cwiseAbs().maxCoeff(), p_digits) << at << " " << value;
          ASSERT_LE((got->q_TS.toRotationMatrix() - sent->q_TS.toRotationMatrix()).norm(), R_digits) << at;
        }
      }
    }
    EXPECT_GT(refused, looked / 2);
  }
}

/// Two records of one station with the middle lost, so that head and tail form a complete one.
TEST(FastrakLayout, NoTwoHalvesOfRedundantRecordsGiveAThirdPose) {
  Random random(5);
  for (const auto& mode : test_support::all_modes()) {
    if (!mode.redundant || mode.format != FastrakFormat::binary) continue;
    for (int i = 0; i < 100; ++i) {
      const int station = 1 + i % 4;
      const FastrakLayout layout = mode.layout(station);
      const FastrakRecord first = test_support::random_record(random, station);
      FastrakRecord second = i % 2 == 0 ? test_support::random_record(random, station) : first;
      if (i % 2 == 1) second.p_TS.x() += 1e-3;  // nearly the same: a hand that hardly moves
      const std::string a = layout.encode(first), b = layout.encode(second);
      const auto sent_a = *layout.decode(a), sent_b = *layout.decode(b);
      for (std::size_t cut = 1; cut < a.size(); ++cut) {
        const auto got = layout.decode(a.substr(0, cut) + b.substr(cut));
        ASSERT_TRUE(!got || test_support::same_pose(*got, sent_a) || test_support::same_pose(*got, sent_b)) << cut;
      }
    }
  }
}

TEST(FastrakLayout, RefusesImplausibleRecords) {
  const FastrakLayout layout({2, 11, 0}, FastrakFormat::binary, FastrakUnits::centimetres);
  const auto with = [&](double x, double q) {
    FastrakRecord record;
    record.p_TS.x() = x;
    record.q_TS.coeffs() *= q;
    return layout.decode(layout.encode(record)).has_value();
  };
  const double infinity = std::numeric_limits<double>::infinity(), nan = std::nan("");
  EXPECT_TRUE(with(9.9, 1.009));
  EXPECT_FALSE(with(10.1, 1.0));
  EXPECT_FALSE(with(nan, 1.0));
  EXPECT_FALSE(with(infinity, 1.0));
  EXPECT_FALSE(with(0.0, 0.0));
  EXPECT_FALSE(with(0.0, nan));
  EXPECT_FALSE(with(0.0, 1.02));
}

TEST(FastrakLayout, RefusesListsThatGiveNoPose) {
  const auto refused = [](const std::vector<int>& items) {
    try {
      FastrakLayout(items, FastrakFormat::ascii, FastrakUnits::inches);
    } catch (const validation::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refused({2, 11, 16, 0}), "");
  EXPECT_NE(refused({2, 11, 17}).find("17"), std::string::npos);
  EXPECT_NE(refused({2, 0}).find("orientation"), std::string::npos);
  EXPECT_NE(refused({}).find("position"), std::string::npos);
  EXPECT_NE(refused({2, 11, 52, 61, 54, 54, 54}).find("254"), std::string::npos);
}

TEST(FastrakStatus, ReadsTheManualsFlags) {
  const auto status = read_fastrak_status("21S3F4    F31  2.3.01EXAMPLE                         ");
  ASSERT_TRUE(status);
  EXPECT_FALSE(status->binary || status->centimetres || status->continuous);
  EXPECT_EQ(status->firmware, "2.3.01");
  const auto other = read_fastrak_status("24S3FB    F31  2.3.01EXAMPLE                         ");
  ASSERT_TRUE(other);
  EXPECT_TRUE(other->binary && other->centimetres && other->continuous);
  for (const int mode : {0, 1, 2, 3, 4, 5, 6, 7}) {
    const std::string text = write_fastrak_status({(mode & 1) != 0, (mode & 2) != 0, (mode & 4) != 0, "1.2"});
    EXPECT_EQ(text.size(), 55u);
    const auto again = read_fastrak_status(text.substr(0, 53));
    ASSERT_TRUE(again);
    EXPECT_EQ(again->binary, (mode & 1) != 0);
    EXPECT_EQ(again->centimetres, (mode & 2) != 0);
    EXPECT_EQ(again->continuous, (mode & 4) != 0);
  }
  EXPECT_FALSE(read_fastrak_status("21O 2 4 1"));
  EXPECT_FALSE(read_fastrak_status("21S3G4    F31  2.3.01EXAMPLE                         "));
}

}  // namespace
}  // namespace spring_workbench::fastrak::fastrak_protocol_test
