#pragma once

#include <cstddef>
#include <deque>
#include <limits>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "spring_workbench/hand_input/input_filter.h"
#include "spring_workbench/live/pace.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::live {

/// Largest difference between displayed poses and the poses that were later committed for the same time.
struct PredictionError {
  double position = 0.0;  ///< [m]
  double angle = 0.0;     ///< [rad]
};

/// A step of the simulation.
struct StepTime {
  double lasts = 0.0;  ///< of the hands' time [s]
  double takes = 0.0;  ///< of the processor's [s], by the clock of Pace
};

/// The displayed state: a copy of the committed simulation that is advanced to the newest sample of the hands, or
/// beyond it along their predicted motion. It only reads the committed simulation.
class LookAhead {
 public:
  /// `scene`, `settings`: of the committed simulation.
  LookAhead(const scene::Scene& scene, const simulation::SimulationSettings& settings) : copy_(scene, settings) {}

  /// Restores the copy from `committed` and advances it to time `t` [s]. `filter`: the input filter of `committed`.
  void show(const simulation::Simulation& committed, const hand_input::InputFilter& filter, double t);
  /// Advances the copy to `horizon` [s] beyond the newest sample; never back, and no further than `committed` if `pace`
  /// expects that to take too long. Does nothing if the copy is there already. Returns the time of the copy beyond the
  /// newest sample [s].
  double show_newest(const simulation::Simulation& committed, const hand_input::InputFilter& filter, double horizon,
                     const Pace& pace);
  const simulation::Simulation& shown() const { return copy_; }
  /// Measures a step of the largest length from the state of `committed`. The copy takes two, since the first one after
  /// a change also prepares the next ones, and is then as it was.
  StepTime time_of_step(const simulation::Simulation& committed, const hand_input::InputFilter& filter,
                        const Pace& pace);
  /// Whether the copy has followed the committed simulation since the last restart(). If not, it may contain other
  /// objects.
  bool has_followed() const { return has_followed_; }

  /// Compares the displayed poses of held objects with those in `committed`, which has advanced since. Returns the
  /// largest errors.
  PredictionError compare(const simulation::Simulation& committed);
  /// Returns the position error that 99 % of the newest 1000 comparisons do not exceed [m].
  double position_error_99() const;
  /// Reports that the input of `committed` or of its input filter has changed.
  void input_changed() { up_to_date_ = false; }
  /// Forgets the displayed poses, because the committed simulation was changed.
  void restart();
  /// Continues in `copy`, a simulation of the committed one's new scene; afterwards `copy` is the one before.
  void change_scene(simulation::Simulation& copy) { std::swap(copy_, copy); }
  /// Allows the displayed time to go back, because time has restarted.
  void allow_time_back() {
    shown_until_ = -std::numeric_limits<double>::infinity();
    up_to_date_ = false;
  }

 private:
  struct Held {
    std::size_t object = 0;
    motion::PoseSample at;
    Twist V_WO_W;
  };
  /// The held objects of one simulation. Checks only the objects that have changed since the last call.
  class HeldObjects {
   public:
    std::vector<Held> of(const simulation::Simulation& simulation);

   private:
    bodies::ChangeLog::Revision at_;
    std::set<std::size_t> held_;
  };

  simulation::Simulation copy_;
  HeldObjects held_in_copy_, held_in_committed_;
  bool has_followed_ = false;
  bool up_to_date_ = false;  ///< the copy is at the newest sample, and nothing has changed since
  double shown_until_ = -std::numeric_limits<double>::infinity();  ///< [s]
  std::deque<Held> shown_;
  std::vector<Held> before_;  ///< held objects of the committed simulation at the last comparison
  std::deque<double> errors_;
};

}  // namespace spring_workbench::live
