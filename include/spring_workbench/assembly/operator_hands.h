#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "spring_workbench/assembly/operator_settings.h"
#include "spring_workbench/assembly/standard_normal.h"
#include "spring_workbench/motion/stylus_source.h"

namespace spring_workbench::assembly {

/// The hands of the simulated operator, numbered from 0: the pose of each, its current reach, and the noise of its
/// tracker. Reaches are minimum-jerk motions whose duration follows Fitts' law (J. Exp. Psychology 47, 1954); each
/// misses its goal by a small random amount.
class OperatorHands {
 public:
  using Numbers = std::vector<std::size_t>;

  /// Starts with the hands at rest at `X_WH`, one pose per hand. Throws InputError if a setting is out of range.
  OperatorHands(const std::vector<RigidTransform>& X_WH, const OperatorSettings& settings);

  std::size_t size() const { return hands_.size(); }
  const RigidTransform& X_WH_start(std::size_t hand) const { return hands_[hand].X_WH_start; }
  /// End pose of a hand's current reach.
  const RigidTransform& X_WH_goal(std::size_t hand) const { return hands_[hand].X_WH_goal; }
  /// Poses of the hands at their newest samples.
  std::vector<RigidTransform> X_WH() const;
  bool pressed(std::size_t hand) const { return hands_[hand].pressed; }
  /// The hand, not counting `others`, whose start pose is horizontally nearest to the point `p_W` [m]. At least one
  /// hand must be left.
  std::size_t nearest(const Vector3d& p_W, const Numbers& others) const;

  void press(std::size_t hand, bool pressed) { hands_[hand].pressed = pressed; }
  /// Starts a joint reach of these hands at `t_from` [s]. Each goes to its `X_WH` from the end of its last reach or, if
  /// it is still moving, from its current pose. All take as long as the slowest one; returns the time at which they
  /// arrive [s].
  double reach(const Numbers& hands, const std::function<RigidTransform(std::size_t)>& X_WH, double t_from);
  /// Moves a hand along its reach to time `t` [s] and returns its sample.
  motion::StylusSample sample(std::size_t hand, double t);

 private:
  struct Hand {
    RigidTransform X_WH_start, X_WH, X_WH_from, X_WH_goal;
    double t_from = 0.0, t_to = 0.0;
    bool pressed = false;
  };
  static double arrival(const Hand& hand, const RigidTransform& X_WH, double t_from);

  const OperatorSettings settings_;
  std::vector<Hand> hands_;
  StandardNormal random_;
};

}  // namespace spring_workbench::assembly
