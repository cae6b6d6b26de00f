#include "spring_workbench/contact/object_list.h"

namespace spring_workbench::contact {

ObjectList::ObjectList(const scene::Scene& scene) : scene_(scene) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    object_of_.push_back(in_scene_.size());
    if (scene.bodies[i].movable) in_scene_.push_back(i);
  }
}

void ObjectList::put_back() {
  states_.assign(in_scene_.size(), bodies::BodyState());
  highlighted_.clear();
  for (std::size_t i = 0; i < states_.size(); ++i) {
    states_[i].name = body(i).name;
    states_[i].X_WO = body(i).X_WO;
  }
}

std::optional<std::size_t> ObjectList::find(const std::string& name) const {
  for (std::size_t i = 0; i < states_.size(); ++i) {
    if (states_[i].name == name) return i;
  }
  return std::nullopt;
}

void ObjectList::clear_highlights() {
  for (const std::size_t object : highlighted_) states_[object].highlighted = false;
  highlighted_.clear();
}

void ObjectList::highlight(std::size_t object) {
  states_[object].highlighted = true;
  highlighted_.push_back(object);
}

}  // namespace spring_workbench::contact
