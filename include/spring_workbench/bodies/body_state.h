#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "spring_workbench/math/state_archive.h"
#include "spring_workbench/scene/scene.h"

namespace spring_workbench::bodies {

/// State of one movable object, at its object frame O (centre of mass), in world axes.
struct BodyState {
  std::string name;                                  ///< name of the object: the name of its URDF link
  RigidTransform X_WO = RigidTransform::Identity();  ///< pose of O in world
  Twist V_WO_W;                                      ///< velocity of O and angular velocity, world axes [m/s, rad/s]
  bool held = false;                                 ///< whether a hand holds the object
  bool highlighted = false;                          ///< whether a press of the grasp button would grasp the object
  bool in_contact = false;                           ///< whether the object touches another body or the bench
  bool asleep = true;  ///< whether the object is at rest, and not simulated until something moves it

  /// Saves or restores all fields but the name.
  void archive(math::StateArchive& state) { state(X_WO, V_WO_W, held, highlighted, in_contact, asleep); }
};

/// Returns whether all numbers of two states are the same, bit by bit.
bool same_bits(const BodyState& a, const BodyState& b);
/// Returns the initial state of a body of a scene: at rest at its start pose, asleep.
BodyState at_start(const scene::Body& body);

/// Record of the objects that have changed since a given revision. It lets a copy of the states be brought up to date
/// at a cost proportional to the number of changes. It is an optimisation only, not part of the state.
class ChangeLog {
 public:
  /// A point in the history of the objects. The default precedes the whole history.
  struct Revision {
    std::shared_ptr<const void> of;  ///< identifies the record
    std::uint64_t count = 0;         ///< number of changes up to this point
  };

  ChangeLog() { reset(0); }  ///< a record of no objects
  ChangeLog(const ChangeLog&) = delete;
  ChangeLog& operator=(const ChangeLog&) = delete;

  /// Resets the record to `objects` objects, all of which count as changed.
  void reset(std::size_t objects);
  void note(std::size_t object);                    ///< records that the object with this index has changed
  Revision now() const { return {self_, count_}; }  ///< the present point
  /// Returns the indices of the objects that have changed since `then`, in ascending order. If `then` was taken from
  /// another record, all objects count as changed.
  std::vector<std::size_t> since(const Revision& then) const;

  /// Returns the indices of the objects that may differ from their counterparts in `other`, in ascending order. These
  /// objects have changed, here or there, since the last mark_equal_to(other).
  std::vector<std::size_t> differing(const ChangeLog& other) const;
  /// Records that all objects have been made equal to the objects of `other`.
  void mark_equal_to(const ChangeLog& other) {
    own_ = now();
    others_ = other.now();
  }

 private:
  /// An object in the ring of all in the order in which they have changed, the newest first.
  struct Link {
    std::uint64_t at = 0;  ///< the count when it changed last
    std::size_t newer = 0, older = 0;
  };

  std::shared_ptr<const void> self_ = std::make_shared<char>();
  std::uint64_t count_ = 0;
  std::vector<Link> links_;  ///< by object; the last one is not an object: the newest is older than it
  Revision own_, others_;    ///< of the last mark_equal_to()
};

}  // namespace spring_workbench::bodies
