#pragma once

#include <optional>
#include <vector>

#include "spring_workbench/fastrak/cadence_clock.h"
#include "spring_workbench/hand_input/input_filter.h"
#include "spring_workbench/hand_input/stream_monitor.h"
#include "spring_workbench/motion/live_source.h"

namespace spring_workbench::fastrak {

/// One station of a device on its way from the wire: stamped by the device's cadence, then through the truth layer.
/// The cadence is measured over three seconds without a gap, anew if it proves wrong; until then a stamp is the moment
/// of receipt.
class StationStream {
 public:
  /// `dropout_after` [s], > 0: see SampleGate. `even_stamps`: false leaves the moments of receipt as they are.
  StationStream(const hand_input::TruthSettings& settings, double dropout_after, bool even_stamps)
      : even_stamps_(even_stamps), truth_(settings, dropout_after), monitor_(dropout_after) {}

  /// The sample's verdict, stamp on the clock of `received` [s], and pose X_TS.
  hand_input::TrueSample take(const motion::StationSample& sample);
  const hand_input::GateCounts& counts() const { return truth_.counts(); }
  const hand_input::StreamFigures& figures() const { return monitor_.figures(); }

 private:
  double stamp(double received);

  bool even_stamps_;
  std::optional<CadenceClock> cadence_;
  std::vector<double> receipts_;  ///< while the cadence is measured [s]
  hand_input::TruthLayer truth_;
  hand_input::StreamMonitor monitor_;
};

}  // namespace spring_workbench::fastrak
