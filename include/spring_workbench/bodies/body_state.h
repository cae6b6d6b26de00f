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
  std::string name;                                  ///< the name of its URDF link
  RigidTransform X_WO = RigidTransform::Identity();  ///< pose
  Twist V_WO_W;                                      ///< [m/s, rad/s]
  bool held = false;                                 ///< whether a hand holds it
  bool highlighted = false;                          ///< whether a press of the button would grasp it
  bool in_contact = false;                           ///< whether it touches another body or the bench
  bool asleep = true;  ///< whether it is at rest, and not simulated until something moves it

  /// Saves or restores all but the name.
  void exchange(math::StateArchive& state) { state(X_WO, V_WO_W, held, highlighted, in_contact, asleep); }
};

/// Whether all numbers are the same, bit by bit.
bool same_bits(const BodyState& a, const BodyState& b);
/// Initial state of a body of a scene: at rest at its start pose, asleep.
BodyState at_start(const scene::Body& body);

/// Records which objects have changed since a given revision, so that a copy updates only these; a query costs as much
/// as has changed. It is not part of the objects' state: it only saves work.
class Changes {
 public:
  /// A point in the history of these objects; the default precedes all of it.
  struct Revision {
    std::shared_ptr<const void> of;  ///< identifies the record
    std::uint64_t count = 0;         ///< number of changes until then
  };

  Changes() { reset(0); }  ///< a record of no objects
  Changes(const Changes&) = delete;
  Changes& operator=(const Changes&) = delete;

  /// Resets the record to `objects` objects, all of which count as changed.
  void reset(std::size_t objects);
  void note(std::size_t object);                    ///< records that the object has changed
  Revision now() const { return {self_, count_}; }  ///< the current point
  /// The objects that have changed since `then`, in ascending order; all if `then` was taken from
  /// another `Changes`.
  std::vector<std::size_t> since(const Revision& then) const;

  /// The objects that may differ from their counterparts in `other`, in ascending order: those that have changed, here
  /// or there, since the last mark_equal_to(other).
  std::vector<std::size_t> differing(const Changes& other) const;
  /// To be called when all objects have been made equal to those of `other`.
  void mark_equal_to(const Changes& other) {
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
