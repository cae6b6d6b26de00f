#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "spring_workbench/assembly/operator_settings.h"
#include "spring_workbench/assembly/standard_normal.h"
#include "spring_workbench/motion/stylus_source.h"

namespace spring_workbench::assembly {

/// The hands of the simulated operator, numbered from 0: where each is, the reach that it makes, and how it is tracked.
/// Reaches are minimum-jerk motions whose duration follows Fitts' law (J. Exp. Psychology 47, 1954); each ends a little
/// off its goal.
class OperatorHands {
 public:
  using Numbers = std::vector<std::size_t>;

  /// At rest at `X_WH`, one pose per hand. Throws InputError if a setting is out of its range.
  OperatorHands(const std::vector<RigidTransform>& X_WH, const OperatorSettings& settings);

  std::size_t size() const { return hands_.size(); }
  const RigidTransform& X_WH_start(std::size_t hand) const { return hands_[hand].X_WH_start; }
  /// Where the reach of a hand ends.
  const RigidTransform& X_WH_to(std::size_t hand) const { return hands_[hand].X_WH_to; }
  /// Where the hands are, as of their newest samples.
  std::vector<RigidTransform> X_WH() const;
  bool pressed(std::size_t hand) const { return hands_[hand].pressed; }
  /// The hand, but for the `others`, that started nearest to a point, seen from above; there must be one.
  std::size_t nearest(const Vector3d& p_W, const Numbers& others) const;

  void press(std::size_t hand, bool pressed) { hands_[hand].pressed = pressed; }
  /// Begins a reach of these hands together at `t_from` [s], each from the end of its last one, or from where it is on
  /// its way there, to its `X_WH`. Returns when the reach ends [s]: the longest one's time is that of all.
  double reach(const Numbers& hands, const std::function<RigidTransform(std::size_t)>& X_WH, double t_from);
  /// Moves a hand to where it is at `t` [s], and returns its sample.
  motion::StylusSample sample(std::size_t hand, double t);

 private:
  struct Hand {
    RigidTransform X_WH_start, X_WH, X_WH_from, X_WH_to;
    double t_from = 0.0, t_to = 0.0;
    bool pressed = false;
  };
  static double arrival(const Hand& hand, const RigidTransform& X_WH, double t_from);

  const OperatorSettings settings_;
  std::vector<Hand> hands_;
  StandardNormal random_;
};

}  // namespace spring_workbench::assembly
