#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "spring_workbench/assembly/standard_normal.h"
#include "spring_workbench/motion/stylus_source.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::assembly {

/// How the simulated operator moves. The numbers are those of people reaching for things in the literature, rounded.
struct OperatorSettings {
  unsigned seed = 1;             ///< of everything random
  double rate = 50.0;            ///< samples per second [Hz], 1 … 1000
  double reaction = 0.2;         ///< what is seen is seen this late [s], 0 … 2
  double position_noise = 1e-4;  ///< of the tracker: standard deviation per axis and sample [m], 0 … 0.1
  double angle_noise = 5e-4;     ///< the same about each axis [rad], 0 … 1
  double aim_scatter = 0.02;     ///< a reach ends off its goal by this part of its length, per axis, 0 … 0.5
};

/// What the operator sees at one moment.
struct OperatorView {
  std::vector<bodies::BodyState> objects;            ///< the movable ones
  RigidTransform X_HE = RigidTransform::Identity();  ///< the tool's tip at rest, in the handle
  bool turns = true;                                 ///< the tool turns what it holds: all but `spring` do
};

/// A simulated person who assembles the scene: takes each object that is not at its target with the tool in the hand,
/// carries it there and sets it down, by looking at where the object is and correcting, whatever the tool does. Reaches
/// are minimum-jerk motions whose duration follows Fitts' law (J. Exp. Psychology 47, 1954); each ends a little off its
/// goal, and what is seen is seen late. It knows of a tool where its tip is at rest, and whether it turns what it
/// holds: with one that does not, it carries objects as they are, and leaves alone one that is in its place but turned.
/// It is not a person: no learning, no tiring, no second thoughts.
class SimulatedOperator final : public motion::StylusSource {
 public:
  using Look = std::function<OperatorView()>;

  /// `look` is asked for the present state once per sample. The hand starts at the scene's start of the handle, and
  /// keeps that attitude for taking up objects. Throws InputError when a setting is out of its range.
  SimulatedOperator(const scene::Scene& scene, const OperatorSettings& settings, Look look);

  /// The next sample; nothing when every object is in place or has been tried often enough.
  std::optional<motion::StylusSample> next() override;

 private:
  enum class Phase { choose, above, insert, grip, lift, carry, lower, release, over };
  struct Seen {
    double t = 0.0;
    OperatorView view;
    RigidTransform X_WH;  ///< where the hand was then, as the operator feels it
  };
  struct Job {
    std::string object;
    scene::Body body;
    scene::Target target;
    int attempts = 0;
  };

  void decide();
  void choose();
  void insert();
  void grip();
  void carry();
  void lower();
  void let_go();

  const bodies::BodyState& state_of(const std::string& object) const;
  /// Where the hand has to be so that the object, moving along with it, comes to `X_WO`.
  RigidTransform hand_for(const RigidTransform& X_WO) const;
  RigidTransform hand_over(const Vector3d& p_WE) const;
  RigidTransform hand_lifted() const;
  RigidTransform goal(double lift) const;  ///< of the held object's frame O: its target, `lift` [m] above
  bool off(const RigidTransform& X_WO_goal, bool height_too) const;
  bool done(const Job& job) const;
  bool can_turn(const scene::Target& target) const;
  /// Moves the hand; `look` says whether what comes then waits until the end of the reach is seen.
  void reach(const RigidTransform& X_WH, Phase then, bool look = true);
  void wait(double seconds, Phase then);

  const OperatorSettings settings_;
  const Look look_;
  std::vector<Job> jobs_;
  Job* job_ = nullptr;
  double carry_height_;  ///< how far objects are lifted above their target to be carried [m]
  Matrix3d R_WH_;        ///< attitude of the hand that takes things up
  StandardNormal random_;
  std::deque<Seen> seen_;  ///< the first one is what the operator is aware of
  Phase phase_ = Phase::choose;
  long samples_ = 0;
  double t_ = 0.0;
  RigidTransform X_WH_;  ///< where the hand is, but for the noise
  RigidTransform X_WH_from_, X_WH_to_;
  double t_from_ = 0.0, t_to_ = 0.0, t_decide_ = 0.0;
  bool button_ = false;
  int corrections_ = 0;
};

}  // namespace spring_workbench::assembly
