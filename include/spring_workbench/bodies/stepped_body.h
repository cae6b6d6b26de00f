#pragma once

#include <any>
#include <functional>

#include "spring_workbench/math/spatial.h"
#include "spring_workbench/math/state_archive.h"
#include "spring_workbench/motion/pose_track.h"

namespace spring_workbench::bodies {

inline bool is_finite(const motion::MotionState& s) {
  return s.X.matrix().allFinite() && s.velocity.linear.allFinite() && s.velocity.angular.allFinite();
}

/// Snapshot of the part of a body's motion that a step changes, so that a trial step can be undone and repeated.
/// Reusing a snapshot allocates nothing. It holds less than a saved simulation: intermediate results that a trial has
/// computed are kept for the next one.
class TrialStart {
 public:
  template <typename State>
  void keep(const State& state) {
    if (State* kept = std::any_cast<State>(&state_)) {
      *kept = state;
    } else {
      state_ = state;
    }
  }
  /// Returns the state that was kept; it must be of the same type.
  template <typename State>
  const State& kept() const {
    return *std::any_cast<State>(&state_);
  }

 private:
  std::any state_;
};

/// Body that contact can carry over the same step repeatedly, until the contact load fits: a held body on its fork, or
/// a free one.
class SteppedBody {
 public:
  virtual ~SteppedBody() = default;

  virtual std::size_t index() const = 0;  ///< index in the scene
  /// Returns the current pose and velocity of the object frame, in world axes.
  virtual motion::MotionState object() const = 0;

  /// Advances the body by `h` [s] under a constant wrench at the centre of mass, in world axes. Returns false, and
  /// changes nothing, if the result is non-finite or out of range.
  virtual bool advance(double h, const Wrench& contact_W) = 0;
  /// Returns whether the body meets nothing on its straight path between two poses of the object frame.
  using PathCheck = std::function<bool(const RigidTransform& X0_WO, const RigidTransform& X1_WO)>;
  /// Advances the body without contact. A body that aims for a pose may check the path to it first.
  virtual bool advance_freely(double h, const PathCheck&) { return advance(h, Wrench()); }
  /// Accepts the last advance(), which was not a trial.
  virtual void accept() {}
  /// Saves the motion before a trial, and restores it bit-identically.
  virtual void save(TrialStart& start) const = 0;
  virtual void restore(const TrialStart& start) = 0;

  /// Change of the displacement over a step per constant wrench, and per impulse at its start; 6 × 6 [linear;
  /// angular].
  struct Response {
    Matrix6d displacement, by_impulse;
  };
  virtual Response response(double h) const = 0;
  /// Moves the end of the last advance(), of `h` [s], to where it would be if its wrench were changed by `change_W`, to
  /// first order.
  virtual void correct(double h, const Wrench& change_W) = 0;
  /// Returns the change of the velocity per impulse.
  virtual Matrix6d mobility() const = 0;
  virtual void add_impulse(const Wrench& impulse_W) = 0;
  /// Returns whether the displacement over a step is the mean of the velocities at both ends, times the step. A load
  /// that keeps such a body in place then reverses its velocity.
  virtual bool uses_mean_velocity() const { return false; }
  /// Lets `h` [s] pass with the body at rest where it is, if no other motion is possible.
  virtual void block(double h) = 0;
  /// Lets `h` [s] pass with the tool rigid, as if it had reached the end of its range, if no other motion is possible
  /// and nothing can be in the way. Adds no energy while the hand rests.
  virtual void follow_rigidly(double h) { block(h); }
};

}  // namespace spring_workbench::bodies
