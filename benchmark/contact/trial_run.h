#pragma once

#include <functional>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

#include "benchmark/contact/pair_depth.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::benchmark {

/// A scene, a hand and what they are run with: one case of a contact trial.
struct ContactTrial {
  std::string trial, name;  ///< e.g. "pile", "5x5x4"
  scene::Scene scene;
  simulation::SimulationSettings settings;
  std::function<RigidTransform(double t)> X_WH;  ///< the hand; sampled at 50 Hz, or at the step where that is longer
  double duration = 0.0;                         ///< [s]
  double rests_from = std::numeric_limits<double>::infinity();  ///< the hand does not move any more [s]
  double most_seconds = 60.0;                                   ///< of processor time; after them it is given up
  double woken_until = 0.0;  ///< with no `grasp.object`: what the tip is in is taken for 20 ms every 0.14 s [s]
};

/// What every case is measured by. Depths are taken at the ends of steps, the finest that a user of Simulation sees.
struct Measured {
  bool finite = true;
  bool to_the_end = false;  ///< not given up
  double simulated = 0.0;   ///< of the trial's duration; less where it was given up, [s]
  DeepestPair deepest;
  int looks = 0;
  int steps_blocked = 0, steps_unsolved = 0;
  double time_lost = 0.0;  ///< [s]
  int steps_rejected = 0;
  double cpu_mean = 0.0, cpu_99 = 0.0, cpu_most = 0.0;  ///< processor time per 20 ms [s]
  /// Largest growth of the energy of all objects and the fork while the hand rests [J], and over the weights and the
  /// largest sum of contact forces: as many metres.
  double energy_gained = 0.0, gained_height = 0.0;
};

/// A figure beside its bar.
struct Bar {
  std::string what, unit;
  double measured = 0.0, most = 0.0;
  bool at_least = false;  ///< the bar is the least
  bool holds() const { return at_least ? measured >= most : measured <= most; }
};

struct TrialRow {
  std::string trial, name, contact;
  double step = 0.0;
  Measured measured;
  std::vector<Bar> bars;
  bool holds() const;
};
using TakeRow = std::function<void(const TrialRow&)>;

/// Bars that all trials share.
Bar at_most(const std::string& what, double measured, double most, const std::string& unit = "");
Bar at_least(const std::string& what, double measured, double least, const std::string& unit = "");
Bar depth_bar(const Measured& m, double most = 1e-4);
Bar blocked_bar(const Measured& m);
Bar unsolved_bar(const Measured& m);
Bar rejected_bar(const Measured& m);

/// A case that is run sample by sample.
class TrialRun {
 public:
  explicit TrialRun(const ContactTrial& trial);
  TrialRun(const TrialRun&) = delete;
  TrialRun& operator=(const TrialRun&) = delete;

  /// One more sample of the hand; false at the end, where a state is not finite, and after `most_seconds` of processor
  /// time: what takes as long is told in `Measured::simulated` and does not hold.
  bool advance();
  double time() const { return time_; }
  const simulation::Simulation& simulation() const { return simulation_; }
  /// Of every body of the scene, as placed there or as it has moved.
  std::vector<RigidTransform> poses() const;
  const RigidTransform& pose(const std::string& body) const;
  /// Poses of movable ones at the start, as the simulation numbers them.
  const std::vector<bodies::BodyState>& start() const { return start_; }
  Measured measured() const;
  TrialRow row(std::vector<Bar> bars) const;

 private:
  void look();
  double energy() const;

  ContactTrial trial_;
  simulation::Simulation simulation_;
  PairDepth depth_;
  std::vector<bodies::BodyState> start_;
  std::vector<double> seconds_;
  Measured measured_;
  double interval_, time_ = 0.0, spent_ = 0.0, weight_ = 0.0, hardest_ = 0.0,
                    lowest_ = std::numeric_limits<double>::infinity();
  int sample_ = 0;
};

/// The largest figures of many cases, the sums of their counts, and the mean of their times.
class TrialSum {
 public:
  /// The same row, which has been added.
  const TrialRow& add(const TrialRow& row);
  const Measured& measured() const { return sum_.measured; }
  int count() const { return count_; }
  /// Of the trial "… in all", "N NAME", with these bars and those of depth, blocked and rejected steps.
  TrialRow row(const std::string& name, std::vector<Bar> bars) const;

 private:
  TrialRow sum_;
  int count_ = 0;
};

void print_trial_header(std::ostream& out);
void print(const TrialRow& row, std::ostream& out);

/// Of a fork that points down, whose tip is at `p_WE`.
RigidTransform hand_above(const Vector3d& p_WE, double length);
/// 0 … 1 for `u` of 0 … 1, at rest at both ends.
double minimum_jerk(double u);
/// With these stiffnesses of stretch and bend [N/m] and torsion [N·m/rad].
simulation::SimulationSettings settings_with(double stiffness, double torsion, double step, const std::string& grasped);
scene::Scene scene_with(const std::string& name, scene::ContactMode contact, std::vector<scene::Body> bodies,
                        double bench_friction = 0.5);

}  // namespace spring_workbench::benchmark
