#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

#include "spring_workbench/hand_input/feed.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::live {

/// How far what was shown was from what became of it.
struct PredictionError {
  double position = 0.0;  ///< [m]
  double angle = 0.0;     ///< [rad]
};

/// What is shown: a copy of the committed simulation, which goes ahead to the newest sample of the hands, or further,
/// to where they are predicted to be. The committed one is only read.
class LookAhead {
 public:
  /// Of a simulation of the same scene and settings.
  LookAhead(const scene::Scene& scene, const simulation::SimulationSettings& settings) : copy_(scene, settings) {}

  /// Puts the copy at `committed` and goes to time `t` [s]; `feed`: that of `committed`.
  void show(const simulation::Simulation& committed, const hand_input::Feed& feed, double t);
  const simulation::Simulation& shown() const { return copy_; }

  /// `committed` has gone on: what was shown of held objects in the meantime is compared with where it has them now.
  /// The largest errors.
  PredictionError compare(const simulation::Simulation& committed);
  /// Of the positions compared so far, the newest 1000, that which 99 % do not exceed [m].
  double position_error_99() const;
  /// Forgets what was shown: the committed simulation was changed, or another time began.
  void restart();

 private:
  struct Held {
    std::size_t object = 0;
    motion::PoseSample at;
    Twist V_WO_W;
  };
  static std::vector<Held> held(const simulation::Simulation& simulation);

  simulation::Simulation copy_;
  std::deque<Held> shown_;
  std::vector<Held> before_;  ///< where the committed simulation was at the last comparison
  std::deque<double> errors_;
};

}  // namespace spring_workbench::live
