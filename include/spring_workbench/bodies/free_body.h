#pragma once

#include "spring_workbench/bodies/stepped_body.h"
#include "spring_workbench/motion/pose_track.h"
#include "spring_workbench/scene/scene.h"

namespace spring_workbench::bodies {

/// A free body: its centre of mass on a parabola, its rotation torque-free except for contact.
class FreeBody final : public SteppedBody {
 public:
  /// Keeps a reference to `body`. `gravity` [m/s²] along −z.
  FreeBody(std::size_t index, const scene::Body& body, double gravity, const RigidTransform& X_WO, const Twist& V_WO_W);

  std::size_t index() const override { return index_; }
  motion::MotionState object() const override;
  bool advance(double h, const Wrench& contact_W) override;
  void save(TrialStart& start) const override { start.keep(state_); }
  void restore(const TrialStart& start) override { state_ = start.kept<State>(); }
  Response response(double h) const override { return {0.5 * h * h * mobility(), h * mobility()}; }
  void correct(double h, const Wrench& change_W) override;
  Matrix6d mobility() const override;
  void add_impulse(const Wrench& impulse_W) override;
  bool uses_mean_velocity() const override { return true; }
  void block(double h) override;

  void archive(math::StateArchive& state) { state(state_.X_WO, state_.velocity, state_.angular_momentum); }

 private:
  struct State {
    RigidTransform X_WO;
    Vector3d velocity;          ///< world axes
    Vector3d angular_momentum;  ///< about the centre of mass, world axes: constant without contact
  };
  Vector3d angular_velocity(const Matrix3d& R_WO, const Vector3d& angular_momentum) const;

  std::size_t index_;
  double mass_;
  Matrix3d inertia_O_, inverse_inertia_O_;
  double gravity_;
  State state_;
};

}  // namespace spring_workbench::bodies
