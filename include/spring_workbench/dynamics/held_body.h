#pragma once

#include <array>
#include <functional>
#include <memory>
#include <utility>

#include "spring_workbench/dynamics/active_coordinates.h"
#include "spring_workbench/dynamics/coupling.h"
#include "spring_workbench/motion/pose_track.h"
#include "spring_workbench/rod/settings.h"
#include "spring_workbench/rod/shape_model.h"

namespace spring_workbench::dynamics {

/// Rigid body that the tip E holds; its frame O is at the centre of mass.
struct BodyInertia {
  double mass = 1.0;                                 ///< mass [kg], > 0
  Matrix3d inertia_O = Matrix3d::Identity();         ///< inertia about O, axes of O [kg·m²], positive definite
  RigidTransform X_OE = RigidTransform::Identity();  ///< pose of the tip in the body: the grasp G
};

/// Motion of the handle frame H at one moment.
struct HandleState {
  double t = 0.0;                                    ///< time [s]
  RigidTransform X_WH = RigidTransform::Identity();  ///< pose of the handle in world
  Vector3d v_WH_W = Vector3d::Zero();                ///< velocity of the origin, world axes [m/s]
  Vector3d w_WH_H = Vector3d::Zero();                ///< angular velocity, axes of H [rad/s]
  Vector3d alpha_WH_H = Vector3d::Zero();            ///< angular acceleration, axes of H [rad/s²]
  /// Acceleration of the origin less gravity, as an accelerometer would measure it, axes of H [m/s²].
  Vector3d proper_acceleration_H = Vector3d::Zero();
  Couplings::RelativeMotions<double> relative_motions;  ///< motions of H relative to the frames of the couplings
};

/// Motion of the handle without its position, at one moment (`S` double) or several (a math::Pack).
template <typename S>
// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): HeldBody::state_at sets all of it, in each step
struct HandleRates {
  S t;                                             ///< time [s]
  motion::BodyFrameRates<S> of_H;                  ///< velocities and accelerations of the handle, in its own axes
  Couplings::RelativeMotions<S> relative_motions;  ///< motions of H relative to the frames of the couplings
};

/// Motion of the handle at several moments, for integrators that use packs.
struct HandleStates : HandleRates<math::Pack> {
  HandleState at(int i) const;  ///< the motion in lane `i`
};

/// Energy of held body and springs at several moments, with the power that should change it.
struct EnergyBalance {
  /// Energy as seen from the moving handle [J]: elastic, kinetic and potential energy − p·v − L·ω, with the body's
  /// momenta p, L about the handle's origin and its velocities v, ω. Constant at rest without damping and contact.
  math::Pack energy;
  math::Pack power;  ///< power of the handle's acceleration, of contact and of the dampers in that frame [W]
};

/// The equation of motion of doc/model.md for a rigid body on a rod on a moving handle, in the active coordinates:
/// `M(q) q̈ = −K q − D q̇ − (inertial, gravity and contact forces)`. A DOF that is off has no active coordinates. A DOF
/// that is being switched off has none either: it follows a prescribed motion to zero. Not thread-safe.
class HeldBody {
 public:
  /// Puts `body` on an unstrained rod of `shape`. `gravity` [m/s²] acts along −z of world.
  HeldBody(std::shared_ptr<const rod::ShapeModel> shape, const BodyInertia& body, double gravity);

  const rod::ShapeModel& shape() const { return *shape_; }                               ///< the rod
  const std::shared_ptr<const rod::ShapeModel>& shared_shape() const { return shape_; }  ///< the rod, to be shared
  const BodyInertia& body() const { return body_; }                                      ///< the body at its tip
  double gravity() const { return gravity_; }  ///< gravity along −z of world [m/s²]
  /// Increases with every change of the equations. Results derived from the equations are valid for one version only.
  long version() const { return version_; }
  /// Increases with every change of the load. A load does not change the linear part of the equations.
  long load_version() const { return load_version_; }

  /// Sets stiffness [N/m, N/m, N·m/rad] ≥ 0 and damping ratio ≥ 0 (Kelvin–Voigt; doc/model.md) per DOF.
  void set_springs(const rod::PerDof& stiffness, const rod::PerDof& damping_ratio);
  /// Sets stiffness k [N/m, N/m, N·m/rad] and damping coefficients c [N·s/m, N·s/m, N·m·s/rad]: `D = (c / k) K`.
  void set_coefficients(const rod::PerDof& stiffness, const rod::PerDof& damping);
  /// Sets the same damping ratio ≥ 0 for every mode of the active coordinates: `D = 2 ζ M^½ (M^-½ K M^-½)^½ M^½`, with
  /// the mass matrix M of the unstrained fork. D is recomputed by set_dofs().
  void set_springs_with_modal_damping(const rod::PerDof& stiffness, double damping_ratio);
  void set_springs(const rod::ForkSettings& fork);  ///< sets stiffness, damping values and damping law of `fork`
  double axial_inertia() const;  ///< the body's moment of inertia about the fork's axis, through the tip [kg·m²]
  const rod::PerDof& dof_stiffness() const { return stiffness_; }  ///< stiffness per DOF [N/m, N/m, N·m/rad]
  /// Damping coefficients per DOF [N·s/m, N·s/m, N·m·s/rad]. With modal damping, these are the coefficients that would
  /// give each DOF alone the ratio of the modes.
  const rod::PerDof& dof_damping() const { return damping_; }

  /// Switches DOFs on and off. A DOF that is switched off while strained returns to zero, critically damped, from time
  /// `t` [s] on with the time constant `return_time` [s]; `full` is the state in all coordinates at `t`. Returns the
  /// new active state, in which the body has the same pose and twist.
  StrainState set_dofs(const rod::ForkDofs& dofs, double t, double return_time, const StrainState& full);
  /// Ends the prescribed returns that have reached zero by time `t` [s]. Returns whether one ended.
  bool drop_finished_returns(double t);
  bool returning() const { return coordinates_.returning(); }  ///< whether a DOF that was switched off still returns

  /// Sets the constant load [N, N·m] on the body at its centre of mass, world axes: contact and measured wrenches.
  void set_load(const Wrench& load_W);
  const Wrench& load() const { return load_W_; }  ///< the load that was set
  bool loaded() const { return loaded_; }         ///< whether the load is not zero

  /// Returns true if the object can move in a straight line between two poses without touching anything. Used only by
  /// `paper`, in the next step. An empty function means that nothing is in the way. Not saved with the state.
  using PathCheck = std::function<bool(const RigidTransform& X0_WO, const RigidTransform& X1_WO)>;
  void set_path_check(PathCheck check) { path_check_ = std::move(check); }  ///< sets the check for the next step
  const PathCheck& path_check() const { return path_check_; }               ///< the check for the next step

  void attach(const std::vector<Attached>& couplings);                ///< sets the further tools; see Couplings::attach
  void detach_beyond(std::size_t n) { couplings_.detach_beyond(n); }  ///< see Couplings::detach_beyond
  bool coupled() const { return !couplings_.empty(); }                ///< whether further tools are attached
  /// Returns the sum over all couplings for a state of the body.
  Couplings::Reading read_couplings(const HandleState& handle, const StrainState& state) const;

  int size() const { return coordinates_.size(); }                                  ///< number of active coordinates
  const ActiveCoordinates& coordinates() const { return coordinates_; }             ///< which coordinates are active
  StrainState zero_state() const;                                                   ///< state without strain, at rest
  rod::StrainVector units() const { return coordinates_.gather(shape_->units()); }  ///< scales of active coordinates
  rod::StrainVector stiffness() const;  ///< diagonal of the stiffness matrix K, active coordinates
  rod::StrainMatrix damping() const;    ///< damping matrix D, active coordinates
  /// K and D with the springs and dampers of the couplings.
  struct Springs {
    rod::StrainMatrix K;  ///< stiffness, active coordinates
    rod::StrainMatrix D;  ///< damping, active coordinates
  };
  /// Returns K and D, with the couplings linearised at the strain `q`.
  Springs springs(const HandleState& handle, const rod::StrainVector& q) const;

  /// Returns the motion of the handle at time `t` [s], in world and relative to the frames of the couplings.
  HandleState state_at(const motion::Trajectory& handle, double t) const;
  /// Returns the motions of the handle at several times, one in each lane.
  HandleStates state_at(const motion::Trajectory& handle, const math::Pack& t) const;
  /// Returns the acceleration q̈ of the active coordinates.
  rod::StrainVector acceleration(const HandleState& handle, const rod::StrainVector& q,
                                 const rod::StrainVector& q_dot) const;
  /// Returns q̈ for `n` = size(), 1 … 6, known at compile time: for integrators.
  template <int n>
  Eigen::Matrix<double, n, 1> acceleration(const HandleState& handle, const Eigen::Matrix<double, n, 1>& q,
                                           const Eigen::Matrix<double, n, 1>& q_dot) const;
  /// Computes q̈ at several moments. Each array has `n` packs.
  template <int n>
  void acceleration(const HandleStates& handle, const math::Pack* q, const math::Pack* q_dot, math::Pack* q_ddot) const;
  /// Returns energy and power at several moments, for arrays of size() packs, without a DOF that returns to zero.
  EnergyBalance energy_balance(const HandleStates& handle, const math::Pack* q, const math::Pack* q_dot) const;
  rod::StrainMatrix mass_matrix(double t, const rod::StrainVector& q) const;  ///< M(q) of the active coordinates
  bool rechart(StrainState& state) const;  ///< ShapeModel::rechart, active coordinates; not while a DOF returns
  /// Returns an active state at time `t` [s] in all coordinates of the shape model.
  StrainState full_state(double t, const StrainState& state) const { return coordinates_.full_state(t, state); }

  /// Returns pose, velocity and, if `q_ddot` is given, acceleration of the object frame O, in world axes.
  motion::MotionState object(const HandleState& handle, const StrainState& state,
                             const rod::StrainVector* q_ddot = nullptr) const;
  /// Returns the Jacobian of O's velocity [linear; angular], axes of H, in the active coordinates: 6 × size().
  rod::TwistJacobian object_jacobian(double t, const rod::StrainVector& q) const;
  /// Returns the strain rate at the strain `q` that is closest, in kinetic energy, to a twist of O (world axes).
  rod::StrainVector project_twist(const HandleState& handle, const rod::StrainVector& q, const Twist& V_WO_W) const;

  double elastic_energy(double t, const StrainState& state) const;              ///< elastic energy U of the rod [J]
  rod::StrainVector elastic_force(double t, const rod::StrainVector& q) const;  ///< ∂U/∂q of the active coordinates
  double kinetic_energy(const Twist& V_WO_W, const Matrix3d& R_WO) const;       ///< kinetic energy of the body [J]

  /// Saves or restores springs, DOFs, load and versions; shape, body and gravity must be the same. The history of an
  /// integrator is valid only for these versions, so it is saved together with them.
  void archive(math::StateArchive& state);

 private:
  /// Jacobians of the velocity of O and of the angular velocity, axes of H, all coordinates.
  struct Kinematics {
    Matrix3d R_HO;
    rod::StrainJacobian linear, angular;
  };
  template <typename S>
  void find_tip(const S* q, const S* q_dot, rod::TipOf<S>& tip) const;  ///< for strain and rates of all coordinates
  /// Computes the tip for strain and strain rates of all coordinates, or returns the last result if it was for the same
  /// ones. Without `needs_rates`, only what depends on the strain alone is valid.
  const rod::TipOf<double>& tip(const double* q, const double* q_dot, bool needs_rates) const;
  template <typename S>
  struct Rigid;  // src/dynamics/equation_of_motion.h
  template <typename S>
  Rigid<S> without_strain_acceleration(const HandleRates<S>& handle, const rod::TipOf<S>& tip, const S* q_dot,
                                       const S* q_ddot) const;
  template <typename S>
  Rigid<S> rigid(const HandleRates<S>& handle, const S* q, const S* q_dot, rod::TipOf<S>& tip) const;
  /// Forces of springs and dampers along the active coordinates.
  template <int n, typename S>
  void spring_forces(const S* q, const S* q_dot, S* forces) const;
  template <int n, typename S>
  void accelerate(const HandleRates<S>& handle, const S* q, const S* q_dot, S* q_ddot) const;
  template <int n>
  void balance(const HandleStates& handle, const math::Pack* q, const math::Pack* q_dot, EnergyBalance& out) const;
  /// Returns the kinematics for the strain of all coordinates, or for that of the active ones at time `t`.
  Kinematics kinematics(const StrainState& full) const;
  Kinematics kinematics(double t, const rod::StrainVector& q) const;
  rod::StrainMatrix mass_matrix(const Kinematics& k, Matrix3d& I_H) const;
  /// Returns the coefficients of the DOFs' dampers for these damping ratios.
  rod::PerDof damping_of(const rod::PerDof& stiffness, const rod::PerDof& ratio) const;
  void changed();
  void derive();  ///< what follows from springs and DOFs

  std::shared_ptr<const rod::ShapeModel> shape_;
  rod::StraightRod straight_;
  bool bends_ = true;  ///< whether the bend is on, or a DOF returns to zero
  BodyInertia body_;
  Vector3d p_OE_, p_EO_;  ///< grasp in O; centre of mass in E
  Matrix3d R_EO_;
  double gravity_;
  long version_ = 0;
  long load_version_ = 0;
  rod::PerDof stiffness_, damping_;  ///< values per DOF
  rod::StrainVector K_, D_;          ///< all coordinates; with modal damping D_ is zero
  bool modal_ = false;
  double modal_ratio_ = 0.0;
  rod::StrainMatrix D_modal_;  ///< active coordinates; valid if modal_
  ActiveCoordinates coordinates_;
  Couplings couplings_;
  Wrench load_W_;
  bool loaded_ = false;  ///< the load is not zero
  PathCheck path_check_;
  /// Result of the last tip(): a step asks for pose, Jacobian and mass matrix of one state repeatedly. Not thread-safe.
  struct LastTip {
    bool known = false;
    std::array<double, rod::max_strain_coordinates> q{}, q_dot{};
    rod::TipOf<double> tip{};
  };
  mutable LastTip last_tip_;
};

}  // namespace spring_workbench::dynamics
