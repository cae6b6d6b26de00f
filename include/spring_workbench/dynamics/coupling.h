#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "spring_workbench/math/state_archive.h"
#include "spring_workbench/motion/motion_segment.h"

namespace spring_workbench::dynamics {

/// Pose and velocity of a frame B in a frame A, in the axes of A, at one moment (`S` double) or several (a math::Pack).
template <typename S>
struct RelativeMotion {
  math::Mat3x3<S> R_AB;  ///< rotation: columns are the axes of B in A
  math::Vec3<S> p_AB;    ///< origin of B [m]
  math::Vec3<S> v_AB;    ///< velocity of the origin of B [m/s]
  math::Vec3<S> w_AB;    ///< angular velocity of B [rad/s]
};

/// Returns pose and velocity of the object O relative to a frame A.
RelativeMotion<double> relative_motion(const motion::BodyRateState& A, const motion::MotionState& O);

/// Force and moment of a coupling on the object, in the axes of the frame that the function names.
template <typename S>
struct Pull {
  math::Vec3<S> force;   ///< force [N]
  math::Vec3<S> moment;  ///< moment about the origin of O [N·m]
};

/// The action of a further tool on the held body O: springs and dampers without mass between O and a frame A with
/// prescribed motion. Vectors are in the axes of A.
class Coupling {
 public:
  /// The coupling, linearised about the present pose of the object: 6 × 6 [linear; angular], symmetric, ≥ 0.
  struct Springs {
    Matrix6d stiffness = Matrix6d::Zero();  ///< stiffness [N/m, N/rad; N, N·m/rad]
    Matrix6d damping = Matrix6d::Zero();    ///< damping, in the units of the stiffness times s
    double energy = 0.0;                    ///< elastic energy of the springs [J]
    double dissipated_power = 0.0;          ///< power that the dampers dissipate [W]
  };
  /// Identifies the law of a coupling's springs and dampers.
  struct Key {
    double since = 0.0;  ///< time of the grasp [s]
    long version = 0;    ///< number of changes of the law since the grasp
    /// Whether two keys identify the same law.
    bool operator==(const Key& o) const { return since == o.since && version == o.version; }
    void archive(math::StateArchive& state) { state(since, version); }  ///< saves or restores both
  };

  virtual ~Coupling() = default;
  virtual Key key() const = 0;  ///< key of the present law; it changes whenever the law does
  /// Computes the pull on the object at time `t` [s], in the axes of A. Like springs(), it must not allocate memory.
  virtual void pull(const double& t, const RelativeMotion<double>& A_O, Pull<double>& pull) const = 0;
  /// Computes the pulls at several times, one in each lane.
  virtual void pull(const math::Pack& t, const RelativeMotion<math::Pack>& A_O, Pull<math::Pack>& pull) const = 0;
  /// Returns stiffness, damping and energy at time `t` [s], linearised at this motion of the object, in the axes of A.
  virtual Springs springs(double t, const RelativeMotion<double>& A_O) const = 0;
  /// Optional. Called at the start of a step, to forget results of the last one. If not overridden: does nothing.
  virtual void begin_step() const {}
};

/// A coupling with the motion of its frame A.
struct Attached {
  const Coupling* coupling = nullptr;         ///< springs and dampers; never null when attached
  const motion::Trajectory* frame = nullptr;  ///< motion of A; never null when attached
  /// Motion of the handle relative to which `frame` is defined. If set, A keeps its pose relative to the handle: when
  /// the handle is displaced, A is displaced with it. If null, `frame` is used as it is.
  const motion::Trajectory* handle = nullptr;
};

/// The couplings of a held body. It keeps pointers to couplings and motions, which must outlive their attachment.
class Couplings {
 public:
  /// Motion of the handle H relative to the frame A of each coupling. Up to three couplings need no heap.
  template <typename S>
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): only the first `count` elements are used, in each step
  struct RelativeMotions {
    /// Largest distance of the frames from the origin of the world [m]. Rounding errors are in proportion to it.
    double distance = 0.0;
    std::size_t count = 0;                   ///< number of frames
    std::array<RelativeMotion<S>, 3> first;  ///< motions in the first three frames
    std::vector<RelativeMotion<S>> more;     ///< motions in all further frames

    /// Makes room for this number of frames.
    void resize(std::size_t frames) {
      count = frames;
      more.resize(frames - std::min(frames, first.size()));
    }
    /// Motion of H in the frame of coupling `i` < count.
    RelativeMotion<S>& in_frame(std::size_t i) { return i < first.size() ? first[i] : more[i - first.size()]; }
    /// Motion of H in the frame of coupling `i` < count.
    const RelativeMotion<S>& in_frame(std::size_t i) const { return const_cast<RelativeMotions*>(this)->in_frame(i); }
  };

  /// Attaches these couplings in place of the present ones. Returns whether the couplings or their laws have changed.
  bool attach(const std::vector<Attached>& couplings);
  /// Detaches all but the first `n` couplings until the next attach(). Attaching them again is no change.
  void detach_beyond(std::size_t n) { attached_.resize(std::min(n, attached_.size())); }
  bool empty() const { return attached_.empty(); }  ///< whether no coupling is attached

  /// Computes the motions of the handle relative to the frames at time `t` [s].
  void find_relative_motions(const motion::Trajectory& handle, double t, RelativeMotions<double>& A_H) const;
  /// Computes the motions of the handle relative to the frames at several times, one in each lane.
  void find_relative_motions(const motion::Trajectory& handle, const math::Pack& t,
                             RelativeMotions<math::Pack>& A_H) const;
  /// Returns lane `i` of motions at several times.
  static RelativeMotions<double> lane(const RelativeMotions<math::Pack>& A_H, int i);
  /// Returns the sum of all pulls, in the axes of H, for the motion of the object in H.
  template <typename S>
  Pull<S> pull(const S& t, const RelativeMotions<S>& A_H, const RelativeMotion<S>& H_O) const;
  /// Sum over all couplings.
  struct Reading {
    Coupling::Springs springs;  ///< stiffness, damping and energy, axes of H
    Wrench pull_W;              ///< wrench on the object at its centre, world axes [N, N·m]
    double power = 0.0;         ///< power put in by the motions of the frames, less the dissipated power [W]
  };
  /// Returns the sum over all couplings at time `t` [s]. `W_H`: the handle in world, with velocities in its own axes.
  Reading read(double t, const RelativeMotions<double>& A_H, const RelativeMotion<double>& H_O,
               const RelativeMotion<double>& W_H) const;

  void archive(math::StateArchive& state) { state(keys_); }  ///< saves or restores the keys

 private:
  std::vector<Attached> attached_;
  std::vector<Coupling::Key> keys_;  ///< keys of the couplings that were attached last
};

}  // namespace spring_workbench::dynamics
