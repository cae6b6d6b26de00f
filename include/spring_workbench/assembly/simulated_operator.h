#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "spring_workbench/assembly/operator_hands.h"
#include "spring_workbench/assembly/operator_job.h"
#include "spring_workbench/assembly/operator_view.h"
#include "spring_workbench/motion/stylus_source.h"
#include "spring_workbench/scene/scene.h"

namespace spring_workbench::assembly {

/// A simulated person who assembles the scene: takes each object that is not at its target with the tool in the hand,
/// carries it there and sets it down, by looking at where the object is and correcting, whatever the tool does. It
/// perceives everything with a delay. It knows of a tool where its tip is at rest, and whether it turns what it holds:
/// with one that does not, it carries objects as they are, and leaves alone one that is in its place but turned. It has
/// as many hands as the scene has starts of a handle. An object whose target names several grips is carried by one hand
/// at each, together; any other one by the hand that begins nearest to it, which hands it over midway if another begins
/// nearer to the target. It is not a person: no learning, no tiring, no second thoughts.
class SimulatedOperator final : public motion::StylusSource {
 public:
  using Look = std::function<OperatorView()>;

  /// `look` is asked for the present state once per moment. Each hand starts at the scene's start of its handle, and
  /// keeps that attitude for taking up objects. Throws InputError when a setting is out of its range.
  SimulatedOperator(const scene::Scene& scene, const OperatorSettings& settings, Look look);

  std::size_t hands() const { return hands_.size(); }
  /// The next sample: at each moment one of each hand, in their order; nothing when every object is in place or has
  /// been tried often enough.
  std::optional<motion::StylusSample> next() override;

 private:
  enum class Phase { choose, above, insert, grip, lift, carry, lower, release, over };
  struct Percept {
    double t = 0.0;
    OperatorView view;
    std::vector<RigidTransform> X_WH;  ///< poses of the hands at that time
  };
  /// A hand that is to take hold of the object, and where: in the object's frame.
  struct Taker {
    std::size_t hand = 0;
    Vector3d p_OG = Vector3d::Zero();
  };
  using Numbers = OperatorHands::Numbers;
  using Place = std::function<RigidTransform(std::size_t)>;

  void begin_moment();
  void decide();
  void choose();
  void assign();
  void take_next();
  void insert();
  void grip();
  void carry();
  void lower();
  void let_go();

  const OperatorView& view() const { return percepts_.front().view; }
  const bodies::BodyState& object() const { return view().object(job_->object()); }  ///< the object of the present job
  bool holds(std::size_t hand) const { return view().tools[hand].held_object == job_->object(); }
  Vector3d grip_point() const;  ///< where the next hand takes the object, in world
  RigidTransform hand_lifted(std::size_t hand) const;
  RigidTransform carry_goal() const;  ///< of the object: above its target, or between the hand and the receiver
  /// Moves hands together; `look` says whether what comes then waits until the end of the reach is seen.
  void reach(const Numbers& hands, const Place& X_WH, Phase then, bool look = true);
  void take_to(const Vector3d& p_WE, Phase then);         ///< moves the tip of the hand that takes
  void bring_to(const RigidTransform& X_WO, Phase then);  ///< moves the hands, and along with them the object
  void wait(double seconds, Phase then);

  const OperatorSettings settings_;
  const Look look_;
  OperatorHands hands_;
  std::vector<OperatorJob> jobs_;
  OperatorJob* job_ = nullptr;
  std::deque<Taker> takers_;             ///< still to take hold of the object; the first one is at it
  std::optional<std::size_t> receiver_;  ///< gets the object from the hand that carries it
  Numbers engaged_;                      ///< hold the object or, the last one, take hold of it
  double carry_height_;                  ///< how far objects are lifted above their target to be carried [m]
  std::deque<Percept> percepts_;         ///< the first is old enough for the operator to be aware of it
  Phase phase_ = Phase::choose;
  long moments_ = 0;
  std::size_t next_hand_ = 0;  ///< whose sample comes next
  double t_ = 0.0;
  double t_decide_ = 0.0;
  int corrections_ = 0;
};

}  // namespace spring_workbench::assembly
