#pragma once

#include <optional>
#include <vector>

#include "spring_workbench/fastrak/cadence_clock.h"
#include "spring_workbench/motion/stream_monitor.h"

namespace spring_workbench::fastrak {

/// Stamps the samples of one station of a device evenly, at the device's sample rate. The rate is measured over three
/// seconds without a gap, and again if samples drift from it. Until it is known, the stamp is the time of receipt.
class StationStream {
 public:
  /// `dropout_after` [s], > 0: see StreamMonitor. With `even_stamps` false, the stamps are the times of receipt.
  StationStream(double dropout_after, bool even_stamps) : even_stamps_(even_stamps), monitor_(dropout_after) {}

  /// Returns the stamp [s] of the next sample, which was received at `received` [s] by the same clock.
  double stamp(double received);
  const motion::StreamFigures& figures() const { return monitor_.figures(); }

 private:
  double by_cadence(double received);

  bool even_stamps_;
  std::optional<CadenceClock> cadence_;
  std::vector<double> receipts_;  ///< times of receipt while the rate is being measured [s]
  motion::StreamMonitor monitor_;
};

}  // namespace spring_workbench::fastrak
