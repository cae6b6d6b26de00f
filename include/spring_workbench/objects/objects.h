#pragma once

#include <memory>
#include <set>
#include <vector>

#include "spring_workbench/objects/free_objects.h"

namespace spring_workbench::objects {

class FreePairs;

/// Body that a tool carries over a step.
struct Carried {
  std::size_t object;  ///< in the workbench
  bodies::SteppedBody* body;
};

/// The movable objects of a scene, held, in free flight or asleep, and their contacts. A tool takes an object with
/// `hold`, carries it in `step`, and gives it back with `let_go`.
class Objects : public FreeObjects {
 public:
  /// Keeps a reference to `scene`. `bisection_levels`: of the search for contact.
  Objects(const scene::Scene& scene, int bisection_levels);
  ~Objects();

  /// Puts all objects back to their initial poses, asleep except for those that fall from there.
  void reset();
  /// Takes over the state of the objects of the same names in `before`, which are those of another scene; other objects
  /// begin at their start poses.
  void continue_from(const Objects& before, double now);

  enum class Grip { grasp, push };
  /// A tool takes the object, or begins to push it, at time `now` [s]; what lies on it wakes.
  void hold(std::size_t object, Grip grip, double now);
  /// A tool that took the object leaves it. After the last one it flies on with its twist (`thrown`) or from rest; a
  /// massless one stays where it is.
  void let_go(std::size_t object, Grip grip, bool thrown, double now);
  /// Places an object that no tool holds or pushes at `X_WO`, at rest; it falls from there.
  void place(std::size_t object, const RigidTransform& X_WO, double now);

  /// Returns whether everything that a held object could touch is at rest.
  bool rests(std::size_t object) const;

  /// Carries held and free objects over `h` [s] from `now` on, with the contact mode of the scene. An object that has
  /// been slow for long enough falls asleep.
  void step(const std::vector<Carried>& held, double now, double h, StepCounts& counts);

  /// Exchanges the state between two calls of `advance`. Of an object that is as reset() puts it, nothing is kept.
  class Archive {
   public:
    explicit Archive(Objects& of) : of_(of) {}
    void exchange(math::StateArchive& state);
    /// Of these objects, and what is of no object alone.
    void exchange(math::StateArchive& state, const std::vector<std::size_t>& some);

   private:
    std::vector<std::size_t> moved() const;
    Objects& of_;
  };

 private:
  /// Contact mode `dynamic`: objects that have only fixed bodies near them are carried as in mode `stop`, all others
  /// together in one rigid-body world.
  void step_among_movable(const std::vector<Carried>& held, double now, double h, StepCounts& counts);
  void step_together(const std::vector<Carried>& held, const std::vector<std::size_t>& moving, double now, double h,
                     StepCounts& counts);
  void note_world_contacts(double h);
  /// Finds what moves in this step: bodies that are carried, given by their indices in the scene, and those of the
  /// world.
  void look_around(const std::vector<std::size_t>& carried, double h);
  /// Carries a free object and the only other movable one that it comes near as a pair. Returns false, and does
  /// nothing, if that one is carried or in the world of several, or if one of the two comes near anything else. `gone`:
  /// those that have been carried in this step.
  bool carry_pair(std::size_t object, std::size_t other, std::set<std::size_t>& gone, double now, double h,
                  StepCounts& counts);

  std::unique_ptr<FreePairs> pairs_;  ///< of contact mode `dynamic` alone
  std::set<std::size_t> in_contact_;  ///< likewise
};

}  // namespace spring_workbench::objects
