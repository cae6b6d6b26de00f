#include "spring_workbench/objects/object_list.h"

namespace spring_workbench::objects {

ObjectList::ObjectList(const scene::Scene& scene) : scene_(scene) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    object_of_.push_back(in_scene_.size());
    if (!scene.bodies[i].movable) continue;
    named_.emplace(scene.bodies[i].name, in_scene_.size());
    in_scene_.push_back(i);
  }
}

void ObjectList::return_to_start() {
  states_.clear();
  for (std::size_t i = 0; i < in_scene_.size(); ++i) states_.push_back(bodies::at_start(body(i)));
  highlighted_.clear();
  changes_.reset(states_.size());
  reset_revision_ = changes_.now();
}

std::optional<std::size_t> ObjectList::find(const std::string& name) const {
  const auto found = named_.find(name);
  return found == named_.end() ? std::nullopt : std::make_optional(found->second);
}

double ObjectList::energy() const {
  double energy = 0.0;
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const auto& [mass, inertia_O] = body(i).mass_properties;
    const Twist& V = states_[i].V_WO_W;
    const Vector3d w_O = states_[i].X_WO.linear().transpose() * V.angular;
    energy += 0.5 * (mass * V.linear.squaredNorm() + w_O.dot(inertia_O * w_O)) +
              mass * scene_.gravity * states_[i].X_WO.translation().z();
  }
  return energy;
}

void ObjectList::clear_highlights() {
  for (const std::size_t object : highlighted_) state(object).highlighted = false;
  highlighted_.clear();
}

}  // namespace spring_workbench::objects
