#pragma once

#include <array>
#include <memory>

#include "spring_workbench/dynamics/held_body.h"
#include "spring_workbench/rod/tip_fit.h"

namespace spring_workbench::tools {

/// A fork on an object that another tool leads: the springs and dampers of its six coordinates between its handle and
/// the object, by inverse kinematics (doc/model.md, "Several tools on one object"). What is off is as stiff as a body
/// that swings on it with 10³ rad/s, critically damped.
class ForkCoupling final : public dynamics::Coupling {
 public:
  /// Keeps a reference to `held`; `since`: when the fork took hold [s].
  ForkCoupling(const dynamics::HeldBody& held, double since);

  /// The strain at present, all coordinates of the held body's shape: what is near to it is looked for.
  void set_strain(const rod::StrainVector& strain);
  Key key() const override { return {since_, held_.version()}; }
  void pull(const double& t, const dynamics::RelativeMotion<double>& A_O, dynamics::Pull<double>& pull) const override;
  void pull(const math::Pack& t, const dynamics::RelativeMotion<math::Pack>& A_O,
            dynamics::Pull<math::Pack>& pull) const override;
  Springs springs(double t, const dynamics::RelativeMotion<double>& A_O) const override;
  void begin_step() const override;
  void exchange(math::StateArchive& state) { state(since_); }
  /// What the fork is like for the object's motion as seen from its handle.
  struct Following {
    dynamics::StrainState strain;
    RigidTransform X_HP;  ///< the handle from which it holds the object, P; where it reaches it, H
  };
  Following follow(const dynamics::RelativeMotion<double>& A_O) const;

 private:
  static constexpr int n = rod::max_strain_coordinates;
  template <typename S>
  using Coordinates = std::array<S, n>;
  template <typename S>
  struct Tip;
  template <typename S>
  Tip<S> tip(const dynamics::RelativeMotion<S>& A_O, const Coordinates<S>& start) const;
  template <typename S>
  void pull_of(const S& t, const dynamics::RelativeMotion<S>& A_O, Coordinates<S>& warm, dynamics::Pull<S>& pull) const;
  /// Strain and rate without the motion on which a DOF that was switched off goes back to none.
  template <typename S>
  void take_returns(const S& t, S* q, S* q_dot) const;
  void stiffen();

  const dynamics::HeldBody& held_;
  double since_;
  std::shared_ptr<const rod::ShapeModel> shape_;  ///< of six coordinates
  std::array<int, n> in_shape_{};                 ///< where the held body's coordinates are among the six
  math::ThreeByThree<double> R_OE_;
  math::Three<double> p_OE_;
  long version_ = -1;  ///< of the held body, that the next two are of
  Coordinates<double> K_{};
  Eigen::Matrix<double, n, n> D_;
  Coordinates<double> start_{};
  mutable Coordinates<math::Pack> warm_{};  ///< of the last evaluation in this step, where the next one starts
};

}  // namespace spring_workbench::tools
