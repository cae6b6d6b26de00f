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

/// Returns pose and velocity of the object O relative to a frame A.
RelativeMotion<double> relative_motion(const motion::OwnAxesMotion& A, const motion::MotionState& O);

/// Force [N] and moment about O [N·m] on the object.
template <typename S>
struct Pull {
  math::Three<S> force, moment;
};

/// Springs and dampers without mass between a frame A with prescribed motion and the held body, O: the action of a
/// further tool on it. Axes are those of A.
class Coupling {
 public:
  /// Stiffness and damping at the object at its present pose: 6 × 6 [linear; angular], symmetric, ≥ 0.
  struct Springs {
    Matrix6d stiffness = Matrix6d::Zero(), damping = Matrix6d::Zero();
    double energy = 0.0;      ///< elastic energy of the springs [J]
    double dissipated = 0.0;  ///< power that the dampers take up [W]
  };
  /// Identifies the equation of motion that includes this coupling: the time of the grasp [s], and how often the law
  /// has changed since.
  struct Key {
    double since = 0.0;
    long version = 0;
    bool operator==(const Key& o) const { return since == o.since && version == o.version; }
    void exchange(math::StateArchive& state) { state(since, version); }
  };

  virtual ~Coupling() = default;
  virtual Key key() const = 0;
  /// Computes the pull on the object at time `t` [s].
  virtual void pull(const double& t, const RelativeMotion<double>& A_O, Pull<double>& pull) const = 0;
  virtual void pull(const math::Pack& t, const RelativeMotion<math::Pack>& A_O, Pull<math::Pack>& pull) const = 0;
  virtual Springs springs(double t, const RelativeMotion<double>& A_O) const = 0;
  /// Begins a step: forgets the starting points of the searches for the pulls.
  virtual void begin_step() const {}
};

/// Coupling with the motion of its frame A.
struct Attached {
  const Coupling* coupling = nullptr;
  const motion::FrameMotion* frame = nullptr;
  /// Reference handle for `frame`; null: the handle passed to find_relative_motions(). If it is set, A keeps the same
  /// pose relative to the handle passed to find_relative_motions() as `frame` has relative to this reference handle.
  const motion::FrameMotion* handle = nullptr;
};

/// Couplings of a held body. Keeps pointers to the couplings and motions that are attached.
class Couplings {
 public:
  /// Motion of the handle H relative to the frame A of each coupling. The first few are not on the heap.
  template <typename S>
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): only the first `count` elements are used, in each step
  struct RelativeMotions {
    /// Largest distance of the frames from the origin of the world, which scales their rounding errors [m].
    double distance = 0.0;
    std::size_t count = 0;
    std::array<RelativeMotion<S>, 3> first;
    std::vector<RelativeMotion<S>> more;

    void resize(std::size_t frames) {
      count = frames;
      more.resize(frames - std::min(frames, first.size()));
    }
    RelativeMotion<S>& in_frame(std::size_t i) { return i < first.size() ? first[i] : more[i - first.size()]; }
    const RelativeMotion<S>& in_frame(std::size_t i) const { return const_cast<RelativeMotions*>(this)->in_frame(i); }
  };

  /// Attaches these couplings in place of the present ones. Returns whether they, or their laws, differ from those
  /// before.
  bool attach(const std::vector<Attached>& couplings);
  /// Detaches all but the first `kept` until attach(). Their keys stay: attaching the same ones again is no change.
  void detach(std::size_t kept) { attached_.resize(std::min(kept, attached_.size())); }
  bool empty() const { return attached_.empty(); }

  void find_relative_motions(const motion::FrameMotion& handle, double t, RelativeMotions<double>& A_H) const;
  void find_relative_motions(const motion::FrameMotion& handle, const math::Pack& t,
                             RelativeMotions<math::Pack>& A_H) const;
  static RelativeMotions<double> lane(const RelativeMotions<math::Pack>& A_H, int i);
  /// Returns the sum of all pulls, in the axes of H, for the motion of the object in H.
  template <typename S>
  Pull<S> pull(const S& t, const RelativeMotions<S>& A_H, const RelativeMotion<S>& H_O) const;
  /// Sum of all springs, in the axes of H. `power` [W]: what the frames put in, less what the dampers dissipate.
  struct Reading {
    Coupling::Springs springs;
    Wrench pull_W;  ///< on the object at its centre, world axes
    double power = 0.0;
  };
  /// `W_H`: the handle in the world, with its velocities in its own axes.
  Reading read(double t, const RelativeMotions<double>& A_H, const RelativeMotion<double>& H_O,
               const RelativeMotion<double>& W_H) const;

  void exchange(math::StateArchive& state) { state(keys_); }

 private:
  std::vector<Attached> attached_;
  std::vector<Coupling::Key> keys_;  ///< keys of the couplings that were attached last
};

}  // namespace spring_workbench::dynamics
