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

/// Where a body on trial has come from: what a step changes of its motion, kept by who may have to take the step again.
/// Filled again without allocation. Less than a saved simulation: what a step has derived on its way stays for the next
/// try.
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
  /// Of the same body.
  template <typename State>
  const State& kept() const {
    return *std::any_cast<State>(&state_);
  }

 private:
  std::any state_;
};

/// A body that contact can carry over a step again and again until its load fits: the held body on its fork, or a free
/// one.
class SteppedBody {
 public:
  virtual ~SteppedBody() = default;

  virtual std::size_t index() const = 0;  ///< in the scene
  /// Pose and velocity of the object frame at present, world axes.
  virtual motion::MotionState object() const = 0;

  /// Goes `h` [s] on under a constant wrench at the centre of mass, world axes; false where the result is not one to go
  /// on from (not finite, or out of bounds), and then nothing has changed.
  virtual bool advance(double h, const Wrench& contact_W) = 0;
  /// Whether the body meets nothing on its straight path between two poses of the object frame.
  using PathCheck = std::function<bool(const RigidTransform& X0_WO, const RigidTransform& X1_WO)>;
  /// advance() without contact, of a body that may aim for a pose first and look what is in the way there.
  virtual bool advance_freely(double h, const PathCheck&) { return advance(h, Wrench()); }
  /// The last advance() was not a trial: the body stays there.
  virtual void accept() {}
  /// What to come back to before a trial, and coming back to it, bit by bit.
  virtual void save(TrialStart& start) const = 0;
  virtual void restore(const TrialStart& start) = 0;

  /// How a constant wrench over a step changes the displacement and the velocity at its end; 6 × 6 [linear; angular].
  struct Response {
    Matrix6d displacement, velocity;
  };
  virtual Response response(double h) const = 0;
  /// How an impulse changes the velocity.
  virtual Matrix6d mobility() const = 0;
  virtual void add_impulse(const Wrench& impulse_W) = 0;
  /// Whether its way over a step is the mean of the velocities at both ends, times the step: what holds it in its place
  /// then leaves it with its velocity turned round.
  virtual bool reverses() const { return false; }
  /// Lets `h` [s] pass at rest where it is: the way out when nothing else fits.
  virtual void block(double h) = 0;
  /// Lets `h` [s] pass with its tool rigid, as one that has come to the end of its way: the way out where nothing can
  /// be in the way. Adds no energy while the hand rests.
  virtual void follow_rigidly(double h) { block(h); }
};

}  // namespace spring_workbench::bodies
