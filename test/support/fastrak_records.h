#pragma once

#include <map>
#include <string>
#include <vector>

#include "spring_workbench/fastrak/fastrak_protocol.h"
#include "support/random_poses.h"

namespace spring_workbench::test_support {

/// A mode in which a device can report.
struct FastrakMode {
  fastrak::FastrakFormat format;
  fastrak::FastrakUnits units;
  bool euler, redundant;

  fastrak::FastrakLayout layout(int station) const {
    return fastrak::FastrakLayout(fastrak::fastrak_output_list(station, format, euler, redundant, station == 1), format,
                                  units);
  }
  std::map<int, fastrak::FastrakLayout> layouts() const {
    std::map<int, fastrak::FastrakLayout> all;
    for (int station = 1; station <= fastrak::kFastrakStations; ++station) all.emplace(station, layout(station));
    return all;
  }
};

inline std::vector<FastrakMode> all_modes() {
  std::vector<FastrakMode> modes;
  for (const auto format : {fastrak::FastrakFormat::ascii, fastrak::FastrakFormat::binary}) {
    for (const auto units : {fastrak::FastrakUnits::inches, fastrak::FastrakUnits::centimetres}) {
      for (const bool euler : {false, true}) {
        for (const bool redundant : {false, true}) modes.push_back({format, units, euler, redundant});
      }
    }
  }
  return modes;
}

inline fastrak::FastrakRecord random_record(Random& random, int station) {
  fastrak::FastrakRecord record;
  record.station = station;
  record.error = random.number(0.0, 1.0) < 0.1 ? 'k' : ' ';
  record.p_TS = random.vector(2.0);
  record.q_TS = Quaterniond(random.rotation());
  record.button = station == 1 && random.number(0.0, 1.0) < 0.5;
  return record;
}

inline bool same_pose(const fastrak::FastrakRecord& a, const fastrak::FastrakRecord& b) {
  return a.station == b.station && a.p_TS == b.p_TS && a.q_TS.coeffs() == b.q_TS.coeffs() && a.button == b.button;
}

}  // namespace spring_workbench::test_support
