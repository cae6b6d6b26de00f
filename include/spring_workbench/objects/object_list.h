#pragma once

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "spring_workbench/bodies/body_state.h"
#include "spring_workbench/scene/scene.h"

namespace spring_workbench::objects {

/// The movable objects of a scene and their states. An object is given by its index in `states()`.
class ObjectList {
 public:
  /// Keeps a reference to `scene`.
  explicit ObjectList(const scene::Scene& scene);

  const std::vector<bodies::BodyState>& states() const { return states_; }
  /// To be changed.
  bodies::BodyState& state(std::size_t object) {
    changes_.note(object);
    return states_[object];
  }
  /// Of the objects' states, and of what else is kept of each.
  bodies::Changes& changes() { return changes_; }
  std::size_t scene_index(std::size_t object) const { return in_scene_[object]; }
  const scene::Body& body(std::size_t object) const { return scene_.bodies[in_scene_[object]]; }
  bool massless(std::size_t object) const { return !(body(object).mass_properties.mass > 0.0); }
  std::optional<std::size_t> find(const std::string& name) const;
  void clear_highlights();
  void highlight(std::size_t object) {
    state(object).highlighted = true;
    highlighted_.push_back(object);
  }
  bool with_contact() const { return scene_.contact != scene::ContactMode::none; }

 protected:
  /// Puts all objects back to their start poses, asleep.
  void put_back();

  const scene::Scene& scene_;
  std::vector<bodies::BodyState> states_;
  bodies::Changes changes_;
  bodies::Changes::Moment put_back_;
  std::vector<std::size_t> object_of_;    ///< object by index in the scene; valid for movable bodies
  std::vector<std::size_t> highlighted_;  ///< the objects that are highlighted

 private:
  std::vector<std::size_t> in_scene_;                   ///< index in the scene, by object
  std::unordered_map<std::string, std::size_t> named_;  ///< object by name
};

}  // namespace spring_workbench::objects
