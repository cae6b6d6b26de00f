#pragma once

#include <cstddef>
#include <deque>
#include <limits>
#include <optional>
#include <vector>

#include "spring_workbench/hand_input/feed.h"
#include "spring_workbench/live/pace.h"
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
  /// The same to the newest sample and `horizon` [s] beyond, but not back, and no further than `committed` where `pace`
  /// says that this takes too long. Returns how far it is beyond the newest sample [s].
  double show_newest(const simulation::Simulation& committed, const hand_input::Feed& feed, double horizon,
                     const Pace& pace);
  const simulation::Simulation& shown() const { return copy_; }

  /// `committed` has gone on: what was shown of held objects in the meantime is compared with where it has them now.
  /// The largest errors.
  PredictionError compare(const simulation::Simulation& committed);
  /// Of the positions compared so far, the newest 1000, that which 99 % do not exceed [m].
  double position_error_99() const;
  /// Forgets what was shown: the committed simulation was changed.
  void restart();
  /// Another time began: what is shown may go back.
  void begin_anew() { shown_until_ = -std::numeric_limits<double>::infinity(); }

 private:
  struct Held {
    std::size_t object = 0;
    motion::PoseSample at;
    Twist V_WO_W;
  };
  static std::vector<Held> held(const simulation::Simulation& simulation);

  simulation::Simulation copy_;
  double shown_until_ = -std::numeric_limits<double>::infinity();  ///< [s]
  std::deque<Held> shown_;
  std::vector<Held> before_;  ///< where the committed simulation was at the last comparison
  std::deque<double> errors_;
};

}  // namespace spring_workbench::live
