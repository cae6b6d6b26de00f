#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "spring_workbench/math/state_archive.h"
#include "spring_workbench/motion/motion_segment.h"

namespace spring_workbench::dynamics {

/// Pose and velocity of a frame B in a frame A, in the axes of A: at one moment (`S` double) or several.
template <typename S>
struct RelativeMotion {
  math::ThreeByThree<S> R_AB;
  math::Three<S> p_AB;  ///< [m]
  math::Three<S> v_AB;  ///< [m/s]
  math::Three<S> w_AB;  ///< [rad/s]
};

/// The object with its velocity, from a frame A.
RelativeMotion<double> seen_from(const motion::OwnAxesMotion& A, const motion::MotionState& O);

/// A force [N] and a moment about O [N·m].
template <typename S>
struct Pull {
  math::Three<S> force, moment;
};

/// Springs and dampers without mass between a frame A with prescribed motion and the held body, O: the action of a
/// further tool on it. Axes are those of A.
class Coupling {
 public:
  /// At the object, where it is: 6 × 6 [linear; angular], symmetric, ≥ 0.
  struct Springs {
    Matrix6d stiffness = Matrix6d::Zero(), damping = Matrix6d::Zero();
    double energy = 0.0;      ///< [J]
    double dissipated = 0.0;  ///< [W]
  };
  /// Identifies the equation of motion with it: when the tool took hold [s], and how often its law has changed since.
  struct Key {
    double since = 0.0;
    long version = 0;
    bool operator==(const Key& o) const { return since == o.since && version == o.version; }
    void exchange(math::StateArchive& state) { state(since, version); }
  };

  virtual ~Coupling() = default;
  virtual Key key() const = 0;
  /// On the object, at time `t` [s].
  virtual void pull(const double& t, const RelativeMotion<double>& A_O, Pull<double>& pull) const = 0;
  virtual void pull(const math::Pack& t, const RelativeMotion<math::Pack>& A_O, Pull<math::Pack>& pull) const = 0;
  virtual Springs springs(double t, const RelativeMotion<double>& A_O) const = 0;
  /// A step begins: forgets the starting points from which the pulls were searched.
  virtual void begin_step() const {}
};

/// A coupling and how its frame A moves.
struct Attached {
  const Coupling* coupling;
  const motion::FrameMotion* frame;
  /// The handle that goes with this frame, where it is not the one that the body is told of: A is then as far from that
  /// one as `frame` is from this.
  const motion::FrameMotion* handle = nullptr;
};

/// The couplings of a held body. Keeps pointers to what it is given.
class Couplings {
 public:
  static constexpr std::size_t most = 2;
  /// The handle H as seen from each frame A.
  template <typename S>
  struct Seen {
    std::size_t count = 0;
    double distance = 0.0;  ///< of the frames from the origin of world, whose rounding they have from there [m]
    std::array<RelativeMotion<S>, most> from;
  };

  /// Returns whether they are others than before, or others by their law. Throws std::length_error for more than
  /// `most`.
  bool attach(const std::vector<Attached>& couplings);
  /// Detaches all but the first `kept` until they are attached again: the equation of motion still includes them.
  void detach(std::size_t kept) { attached_.resize(std::min(kept, attached_.size())); }
  bool empty() const { return attached_.empty(); }

  void look(const motion::FrameMotion& handle, double t, Seen<double>& seen) const;
  void look(const motion::FrameMotion& handle, const math::Pack& t, Seen<math::Pack>& seen) const;
  static Seen<double> lane(const Seen<math::Pack>& seen, int i);
  /// All pulls together, axes of H, for the object's motion in H.
  template <typename S>
  Pull<S> pull(const S& t, const Seen<S>& seen, const RelativeMotion<S>& H_O) const;
  /// All springs together, axes of H; the frames' power [W] is what they put in, less what the dampers take.
  struct Reading {
    Coupling::Springs springs;
    Wrench pull_W;  ///< on the object at its centre, world axes
    double power = 0.0;
  };
  /// `W_H`: the handle in world, its velocities in its own axes.
  Reading read(double t, const Seen<double>& seen, const RelativeMotion<double>& H_O,
               const RelativeMotion<double>& W_H) const;

  void exchange(math::StateArchive& state) { state(keys_); }

 private:
  std::vector<Attached> attached_;
  std::vector<Coupling::Key> keys_;  ///< of those that were attached last
};

}  // namespace spring_workbench::dynamics
