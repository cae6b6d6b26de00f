#pragma once

#include <functional>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

#include "benchmark/contact/pair_depth.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::benchmark {

/// One case of a contact trial: a scene, the motion of a hand, and settings.
struct ContactTrial {
  std::string trial, name;  ///< e.g. "pile", "5x5x4"
  scene::Scene scene;
  simulation::SimulationSettings settings;
  std::function<RigidTransform(double t)>
      X_WH;               ///< motion of the hand, sampled at 50 Hz or once per step if that is longer
  double duration = 0.0;  ///< [s]
  double rests_from = std::numeric_limits<double>::infinity();  ///< time from which the hand is at rest [s]
  double max_seconds = 60.0;  ///< limit of processor time, after which the run is given up [s]
  double woken_until = 0.0;   ///< without `grasp.object`: until this time, the object that the tip is in is grasped for
                              ///< 20 ms every 0.14 s [s]
};

/// Measurements common to all cases. Depths are measured at the ends of steps, the finest resolution visible to a user
/// of Simulation.
struct Measured {
  bool finite = true;
  bool to_the_end = false;  ///< whether the run was completed
  double simulated = 0.0;   ///< simulated time, less than the trial's duration if it was given up [s]
  DeepestPair deepest;
  int looks = 0;
  int steps_blocked = 0, steps_unsolved = 0;
  double time_lost = 0.0;  ///< [s]
  int steps_rejected = 0;
  double cpu_mean = 0.0, cpu_99 = 0.0, cpu_most = 0.0;  ///< processor time per 20 ms [s]
  /// Largest growth of the energy of all objects and the fork while the hand rests [J], and the same divided by the
  /// weights plus the largest sum of contact forces [m].
  double energy_gained = 0.0, gained_height = 0.0;
};

/// A measured value and its required bound.
struct Bar {
  std::string what, unit;
  double measured = 0.0, most = 0.0;
  bool at_least = false;  ///< whether the bound is a minimum
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

/// Bounds common to all trials.
Bar at_most(const std::string& what, double measured, double most, const std::string& unit = "");
Bar at_least(const std::string& what, double measured, double least, const std::string& unit = "");
Bar depth_bar(const Measured& m, double most = 1e-4);
Bar blocked_bar(const Measured& m);
Bar unsolved_bar(const Measured& m);
Bar rejected_bar(const Measured& m);

/// Runs a case sample by sample.
class TrialRun {
 public:
  explicit TrialRun(const ContactTrial& trial);
  TrialRun(const TrialRun&) = delete;
  TrialRun& operator=(const TrialRun&) = delete;

  /// Advances by one sample of the hand. Returns false at the end, if a state is not finite, or after `max_seconds` of
  /// processor time; the case then fails, with the time reached in `Measured::simulated`.
  bool advance();
  double time() const { return time_; }
  const simulation::Simulation& simulation() const { return simulation_; }
  /// Present poses of all bodies of the scene.
  std::vector<RigidTransform> poses() const;
  const RigidTransform& pose(const std::string& body) const;
  /// Initial states of the movable bodies, in the simulation's order.
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

/// Summary of many cases: maxima of the measured values, sums of the counts, means of the times.
class TrialSum {
 public:
  /// Adds a row and returns it.
  const TrialRow& add(const TrialRow& row);
  const Measured& measured() const { return sum_.measured; }
  int count() const { return count_; }
  /// Summary row of the trial "… in all", "N NAME", with these bounds and those for depth, blocked and rejected steps.
  TrialRow row(const std::string& name, std::vector<Bar> bars) const;

 private:
  TrialRow sum_;
  int count_ = 0;
};

void print_trial_header(std::ostream& out);
void print(const TrialRow& row, std::ostream& out);

/// Pose of the hand for a fork that points down with its tip at `p_WE`.
RigidTransform hand_above(const Vector3d& p_WE, double length);
/// Minimum-jerk profile from 0 to 1 for u = 0 … 1, at rest at both ends.
double minimum_jerk(double u);
/// Settings with these stiffnesses of stretch and bend [N/m] and torsion [N·m/rad].
simulation::SimulationSettings settings_with(double stiffness, double torsion, double step, const std::string& grasped);
scene::Scene scene_with(const std::string& name, scene::ContactMode contact, std::vector<scene::Body> bodies,
                        double bench_friction = 0.5);

}  // namespace spring_workbench::benchmark
