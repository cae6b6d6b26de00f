// Selection: the body that a hand points at, that its tip is in, or that its probe touches.
#include <limits>
#include <utility>

#include "constants.h"
#include "hand.h"
#include "spring_workbench/geometry/shape_queries.h"

namespace spring_workbench::simulation {

void Hand::select(double now) {
  if (tool_ == tools::Tool::spring_probe) {
    inserted_.reset();
    return touch_with_probe(now);
  }
  if (hold_ || !stylus_.known(now)) return inserted_.reset();
  select_pierced();
}

void Hand::select_pierced() {
  const std::optional<std::size_t> before = std::exchange(inserted_, std::nullopt);
  const bool picks = tool_ == tools::Tool::ray;
  // The nearest body in front of the hand, ignoring the objects that the tip is in.
  const tools::AxisHit front =
      tools::first_on_axis(scene_, objects_.states(), around_, stylus_.X_WS(), picks ? longest_ray : reach(),
                           [&](const scene::Body& body, const RigidTransform& X_OH) {
                             return !picks && geometry::contains(body.collision, X_OH * Vector3d(0.0, 0.0, reach()));
                           });
  ray_length_ = front.distance;
  const Vector3d tip = stylus_.X_WS() * Vector3d(0.0, 0.0, reach());
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < objects_.states().size(); ++i) {
    const RigidTransform& X_WO = objects_.states()[i].X_WO;
    const Vector3d away = X_WO.translation() - tip;
    const bool pierced = picks ? front.body == &objects_.body(i)
                               : front.body == nullptr && around_.may_contain(objects_.scene_index(i), away) &&
                                     geometry::contains(objects_.body(i).collision, X_WO.inverse() * tip);
    const double distance = away.norm() * (before == i ? switch_ratio : 1.0);
    if (!pierced || distance >= nearest) continue;
    nearest = distance;
    inserted_ = i;
  }
  if (inserted_ && settings_.grasp.object.empty()) objects_.highlight(*inserted_);
}

void Hand::touch_with_probe(double now) {
  if (!stylus_.known(now)) return end_touch(now);
  const double length = fork_.length;
  tools::AxisHit front = tools::first_on_axis(scene_, objects_.states(), around_, stylus_.X_WS(), length,
                                              [](const scene::Body&, const RigidTransform&) { return false; });
  const double down = -stylus_.X_WS().linear()(2, 2), height = stylus_.X_WS().translation().z() - scene_.bench_height;
  if (height > 0.0 && down * front.distance > height) front = {height / down, nullptr, &scene_.bench_material};
  const bool touches = front.material != nullptr && front.distance > 0.0;  // at 0 the hand itself is inside the body
  if (probe_ && (!touches || front.body != probe_->body())) end_touch(now);
  if (!touches) return;
  if (probe_) {
    probe_->touch(front);
  } else {
    probe_ = std::make_unique<tools::Probe>(length, fork_, front, now);
    const std::optional<std::size_t> object = front.body != nullptr ? objects_.find(front.body->name) : std::nullopt;
    pushes_ = object && !objects_.massless(*object);
    if (pushes_) objects_.hold(grasp_.object = *object, objects::Objects::Grip::push, now);
  }
  if (!pushes_) probe_->press();
}

void Hand::end_touch(double now) {
  if (pushes_) objects_.let_go(grasp_.object, objects::Objects::Grip::push, true, now);
  pushes_ = false;
  probe_.reset();
}

}  // namespace spring_workbench::simulation
