#pragma once

#include <array>
#include <memory>

#include "spring_workbench/dynamics/held_body.h"
#include "spring_workbench/rod/tip_fit.h"

namespace spring_workbench::tools {

/// A fork on an object that another tool leads: the springs and dampers of its six coordinates act between its handle
/// and the object, by inverse kinematics (doc/model.md, "Several tools on one object"). DOFs that are off are replaced
/// by critically damped springs on which the object has a natural frequency of 10³ rad/s.
class ForkCoupling final : public dynamics::Coupling {
 public:
  /// Keeps a reference to `held`. `since`: time of the grasp [s].
  ForkCoupling(const dynamics::HeldBody& held, double since);

  /// Sets the current strain, in all coordinates of the held body's shape, from which the inverse kinematics starts.
  void set_strain(const rod::StrainVector& strain);
  Key key() const override { return {since_, held_.version()}; }
  void pull(const double& t, const dynamics::RelativeMotion<double>& A_O, dynamics::Pull<double>& pull) const override;
  void pull(const math::Pack& t, const dynamics::RelativeMotion<math::Pack>& A_O,
            dynamics::Pull<math::Pack>& pull) const override;
  Springs springs(double t, const dynamics::RelativeMotion<double>& A_O) const override;
  void begin_step() const override;
  void archive(math::StateArchive& state) { state(since_); }
  /// State of the fork for a motion of the object relative to its handle.
  struct Following {
    dynamics::StrainState strain;
    RigidTransform X_HP;  ///< proxy handle P from which it holds the object; equal to H if the fork reaches the object
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
  /// Strain and rate without the return motion of a DOF that was switched off.
  template <typename S>
  void take_returns(const S& t, S* q, S* q_dot) const;
  void stiffen();

  const dynamics::HeldBody& held_;
  double since_;
  std::shared_ptr<const rod::ShapeModel> shape_;  ///< of six coordinates
  std::array<int, n> in_shape_{};                 ///< indices of the held body's coordinates among the six
  math::Mat3x3<double> R_OE_;
  math::Vec3<double> p_OE_;
  long version_ = -1;  ///< version of the held body for which the next two are valid
  Coordinates<double> K_{};
  Eigen::Matrix<double, n, n> D_;
  Coordinates<double> start_{};
  mutable Coordinates<math::Pack> warm_{};  ///< warm start: solution of the last evaluation in this step
};

}  // namespace spring_workbench::tools
