#pragma once

#include <vector>

#include "spring_workbench/bodies/free_body.h"

namespace spring_workbench::bodies {

/// Two free bodies that touch nothing but each other, as one body: the first, as seen in the frame F that is fixed to
/// the second and coincides with the world at the start. A wrench on it acts on the first body and, opposite and along
/// the same line, on the second, so that their total momentum and angular momentum do not change, and an impulse
/// changes their energy exactly as it changes that of the combined body. Poses, velocities and wrenches are in F.
class BodyPair final : public SteppedBody {
 public:
  BodyPair(FreeBody first, FreeBody second);

  const FreeBody& first() const { return bodies_.first; }
  const FreeBody& second() const { return bodies_.second; }
  RigidTransform X_WF() const;
  /// The poses in F and in the world, at the start and after each substep that was accepted.
  struct Place {
    RigidTransform X_F1, X_W1, X_W2;
  };
  const std::vector<Place>& path() const { return path_; }

  std::size_t index() const override { return bodies_.first.index(); }
  motion::MotionState object() const override;
  bool advance(double h, const Wrench& contact_F) override;
  void accept() override;
  void save(TrialStart& start) const override { start.keep(bodies_); }
  void restore(const TrialStart& start) override { bodies_ = start.kept<Bodies>(); }
  Response response(double h) const override { return {0.5 * h * h * mobility(), h * mobility()}; }
  void correct(double h, const Wrench& change_F) override;
  Matrix6d mobility() const override;
  void add_impulse(const Wrench& impulse_F) override;
  bool uses_mean_velocity() const override { return true; }
  /// Lets both continue from here like one rigid body.
  void block(double h) override;

 private:
  struct Bodies {
    FreeBody first, second;
  };
  struct Wrenches {
    Wrench first_W, second_W;
  };
  /// A wrench on the first body, and the opposite one on the second, whose centre is `apart_W` away from that of the
  /// first. `rotation_W`: by how much F will have turned from now on.
  Wrenches on_both(const Wrench& wrench_F, const Vector3d& apart_W, const Vector3d& rotation_W) const;

  Bodies bodies_;
  RigidTransform X_2F_;
  std::vector<Place> path_;
};

}  // namespace spring_workbench::bodies
