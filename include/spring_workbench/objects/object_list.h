#pragma once

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "spring_workbench/bodies/body_state.h"
#include "spring_workbench/scene/scene.h"

namespace spring_workbench::objects {

/// The movable objects of a scene and their states. Objects are identified by their index in `states()`.
class ObjectList {
 public:
  /// Keeps a reference to `scene`.
  explicit ObjectList(const scene::Scene& scene);

  const std::vector<bodies::BodyState>& states() const { return states_; }
  /// State of an object for writing; records it as changed.
  bodies::BodyState& state(std::size_t object) {
    changes_.note(object);
    return states_[object];
  }
  /// Record of changes of the objects' states and of the other data on each object.
  bodies::ChangeLog& changes() { return changes_; }
  std::size_t scene_index(std::size_t object) const { return in_scene_[object]; }
  const scene::Body& body(std::size_t object) const { return scene_.bodies[in_scene_[object]]; }
  bool massless(std::size_t object) const { return !(body(object).mass_properties.mass > 0.0); }
  std::optional<std::size_t> find(const std::string& name) const;
  void clear_highlights();
  void highlight(std::size_t object) {
    state(object).highlighted = true;
    highlighted_.push_back(object);
  }
  /// Kinetic and potential energy of all objects [J]; the latter is zero at z = 0.
  double energy() const;
  bool with_contact() const { return scene_.contact != scene::ContactMode::none; }

 protected:
  /// Returns all objects to their start poses, asleep.
  void return_to_start();

  const scene::Scene& scene_;
  std::vector<bodies::BodyState> states_;
  bodies::ChangeLog changes_;
  bodies::ChangeLog::Revision reset_revision_;
  std::vector<std::size_t> object_of_;    ///< object by index in the scene; valid for movable bodies
  std::vector<std::size_t> highlighted_;  ///< the objects that are highlighted

 private:
  std::vector<std::size_t> in_scene_;                   ///< index in the scene, by object
  std::unordered_map<std::string, std::size_t> named_;  ///< object by name
};

}  // namespace spring_workbench::objects
