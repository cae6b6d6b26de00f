#pragma once

#include <memory>
#include <set>
#include <vector>

#include "spring_workbench/objects/free_objects.h"

namespace spring_workbench::objects {

class FreePairs;

/// A body that a tool moves in a step.
struct Carried {
  std::size_t object;  ///< index in states()
  bodies::SteppedBody* body;
};

/// The movable objects of a scene (held, in free flight or asleep) and their contacts. A tool takes an object by
/// `hold`, moves it in `step`, and gives it back by `let_go`.
class Objects : public FreeObjects {
 public:
  /// Keeps a reference to `scene`. `impact_bisections`: of the search for the first contact.
  Objects(const scene::Scene& scene, int impact_bisections);
  ~Objects();

  /// Returns all objects to their initial poses, asleep unless they would fall from there.
  void reset();
  /// Copies the states of the objects with the same names from `before`, the objects of another scene; all others start
  /// at their start poses.
  void continue_from(const Objects& before, double now);

  enum class Grip { grasp, push };
  /// A tool grasps the object, or begins to push it, at time `now` [s]. Wakes the objects that lie on it.
  void hold(std::size_t object, Grip grip, double now);
  /// A tool releases the object or stops pushing it. Released by the last tool, the object continues with its twist
  /// (`thrown`) or from rest; a massless one stays in place.
  void let_go(std::size_t object, Grip grip, bool thrown, double now);
  /// Places an object that no tool holds or pushes at `X_WO`, at rest; it falls from there.
  void place(std::size_t object, const RigidTransform& X_WO, double now);

  /// Returns whether everything that the held object could touch is at rest.
  bool rests(std::size_t object) const;

  /// Advances held and free objects by `h` [s] from `now`, with the contact mode of the scene. Objects that have been
  /// slow for long enough are put to sleep.
  void step(const std::vector<Carried>& held, double now, double h, StepCounts& counts);

  /// Saves or restores the state between two calls of step(). Objects that are still as after reset() add nothing to
  /// it.
  class Archive {
   public:
    explicit Archive(Objects& of) : of_(of) {}
    void archive(math::StateArchive& state);
    /// Saves or restores only the states of the objects `some`, and the part of the state that belongs to no object.
    void archive(math::StateArchive& state, const std::vector<std::size_t>& some);

   private:
    std::vector<std::size_t> moved() const;
    Objects& of_;
  };

 private:
  /// Contact mode `dynamic`: objects with only fixed bodies nearby are stepped as in mode `stop`, all others together
  /// in one rigid-body world.
  void step_among_movable(const std::vector<Carried>& held, double now, double h, StepCounts& counts);
  void step_together(const std::vector<Carried>& held, const std::vector<std::size_t>& moving, double now, double h,
                     StepCounts& counts);
  void note_world_contacts(double h);
  /// Finds the moving bodies of this step: those that are carried (`carried`, indices in the scene) and those of the
  /// rigid-body world.
  void find_moving_bodies(const std::vector<std::size_t>& carried, double h);
  /// Steps a free object and the only movable object that it comes near as a pair. Returns false, and does nothing, if
  /// the other object is held or part of a larger group, or if either comes near anything else. `stepped_objects`:
  /// objects that have already been stepped.
  bool carry_pair(std::size_t object, std::size_t other, std::set<std::size_t>& stepped_objects, double now, double h,
                  StepCounts& counts);

  std::unique_ptr<FreePairs> pairs_;  ///< only with contact mode `dynamic`
  std::set<std::size_t> in_contact_;  ///< likewise
};

}  // namespace spring_workbench::objects
