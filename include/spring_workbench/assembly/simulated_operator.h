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

/// A simulated person who assembles the scene. It picks up each object that is not at its target, carries it there and
/// sets it down, and corrects its motion by the perceived pose of the object, whatever the tool. It perceives
/// everything with a delay. All that it knows of a tool is the rest pose of the tip and whether the tool turns the held
/// object. With a tool that does not, it keeps the orientation of objects, and ignores an object that is in position
/// but turned. It has one hand for each start pose of a handle in the scene. An object whose target lists several grips
/// is carried by that many hands together; any other object by the hand that starts nearest to it, which hands it over
/// midway if another hand starts nearer to the target. Learning, fatigue and changes of mind are not modelled.
class SimulatedOperator final : public motion::StylusSource {
 public:
  using Observe = std::function<OperatorView()>;

  /// `look` is called once per sample time and returns the current state. Each hand starts at the scene's start pose of
  /// its handle, and grasps objects in that orientation. Throws InputError if a setting is out of range.
  SimulatedOperator(const scene::Scene& scene, const OperatorSettings& settings, Observe look);

  std::size_t hands() const { return hands_.size(); }
  /// The next sample: at each sample time one for each hand, in order. Nothing once every object is in place or has
  /// been given up after several attempts.
  std::optional<motion::StylusSample> next() override;

 private:
  enum class Phase { choose, above, insert, grip, lift, carry, lower, release, over };
  struct Percept {
    double t = 0.0;
    OperatorView view;
    std::vector<RigidTransform> X_WH;  ///< poses of the hands at that time
  };
  /// A hand that is to grasp the object, and the point at which, in the object's frame [m].
  struct Grasper {
    std::size_t hand = 0;
    Vector3d p_OG = Vector3d::Zero();
  };
  using Numbers = OperatorHands::Numbers;
  using PoseOfHand = std::function<RigidTransform(std::size_t)>;

  void begin_sample();
  void decide();
  void choose();
  void assign();
  void choose_next_grasper();
  void insert();
  void grip();
  void carry();
  void lower();
  void let_go();

  const OperatorView& view() const { return percepts_.front().view; }
  const bodies::BodyState& object() const { return view().object(job_->object()); }  ///< the object of the current job
  bool holds(std::size_t hand) const { return view().tools[hand].held_object == job_->object(); }
  Vector3d grasp_point() const;  ///< point at which the next hand grasps the object, in world [m]
  RigidTransform hand_lifted(std::size_t hand) const;
  RigidTransform carry_goal()
      const;  ///< goal pose of the object: above its target, or between the hand and the receiving hand
  /// Moves hands together, then enters the phase `then`; with `look`, only after the end of the reach has been
  /// perceived.
  void reach(const Numbers& hands, const PoseOfHand& X_WH, Phase then, bool look = true);
  void move_tip_to(const Vector3d& p_WE, Phase then);           ///< moves the tip of the grasping hand
  void move_object_to(const RigidTransform& X_WO, Phase then);  ///< moves the hands such that the object goes to `X_WO`
  void wait(double seconds, Phase then);

  const OperatorSettings settings_;
  const Observe observe_;
  OperatorHands hands_;
  std::vector<OperatorJob> jobs_;
  OperatorJob* job_ = nullptr;
  std::deque<Grasper> graspers_;         ///< hands that have yet to grasp the object; the first is grasping now
  std::optional<std::size_t> receiver_;  ///< hand to which the carrying hand gives the object
  Numbers engaged_;                      ///< hands that hold the object; the last one may still be grasping it
  double carry_height_;                  ///< height above their targets at which objects are carried [m]
  std::deque<Percept> percepts_;         ///< the first is one reaction time old
  Phase phase_ = Phase::choose;
  long moments_ = 0;
  std::size_t next_hand_ = 0;  ///< hand whose sample is returned next
  double t_ = 0.0;
  double t_decide_ = 0.0;
  int corrections_ = 0;
};

}  // namespace spring_workbench::assembly
