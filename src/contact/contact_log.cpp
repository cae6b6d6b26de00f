#include "spring_workbench/contact/contact_log.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "constants.h"

namespace spring_workbench::contact {
namespace {

/// Whether the list has a contact of the same two bodies.
bool contains_pair(const std::vector<ContactState>& list, const ContactState& c) {
  return std::any_of(list.begin(), list.end(),
                     [&](const ContactState& other) { return other.object == c.object && other.other == c.other; });
}

Vector3d velocity_at(const bodies::BodyState& body, const Vector3d& p_W) {
  return body.V_WO_W.linear + body.V_WO_W.angular.cross(p_W - body.X_WO.translation());
}

}  // namespace

ContactRow row_of(const rigid_bodies::WorldContact& contact, double h) {
  ContactRow row;
  row.point = {contact.other, contact.p_W, contact.n_W, contact.depth};
  row.gap = -contact.depth;
  row.impulse_W = contact.impulse_W;
  row.load_W = row.impulse_W / h;
  return row;
}

ContactLog::ContactLog(const scene::Scene& scene) : scene_(scene) {
  std::size_t objects = 0;
  for (const scene::Body& body : scene.bodies) object_of_.push_back(body.movable ? objects++ : objects);
}

void ContactLog::reset(std::size_t objects) {
  touching_.assign(objects, {});
  with_contacts_.clear();
  recent_.clear();
  before_.clear();
  ended_.clear();
  reported_.clear();
}

void ContactLog::note(std::size_t object, const std::vector<bodies::BodyState>& states,
                      const std::vector<ContactRow>& rows, double h) {
  std::vector<ContactState> now_touching;
  for (const ContactRow& row : rows) {
    ContactState c;
    c.object = states[object].name;
    c.other = row.point.other == collision::CollisionWorld::bench ? "workbench" : scene_.bodies[row.point.other].name;
    c.p_W = row.point.p_W;
    c.n_W = row.point.n_W;
    c.depth = std::max(0.0, -row.gap);
    c.impulse = std::max(0.0, row.impulse_W.dot(row.point.n_W));
    Vector3d v = velocity_at(states[object], c.p_W);
    if (c.other != "workbench" && scene_.bodies[row.point.other].movable)
      v -= velocity_at(states[object_of_[row.point.other]], c.p_W);
    c.slip_speed = (v - c.n_W * v.dot(c.n_W)).norm();
    now_touching.push_back(c);
  }
  if (!now_touching.empty()) set_forces(object, h, now_touching);
  // What was touched and is no more, until it has been reported.
  for (ContactState& c : touching_[object]) {
    if (contains_pair(now_touching, c)) continue;
    c.impulse = 0.0;
    ended_.push_back(c);
  }
  touching_[object] = std::move(now_touching);
  if (touching_[object].empty()) {
    with_contacts_.erase(object);
  } else {
    with_contacts_.insert(object);
  }
}

void ContactLog::begin_step(double h) {
  for (auto of_object = recent_.begin(); of_object != recent_.end();) {
    std::vector<PastImpulse>& recent = of_object->second;
    for (PastImpulse& past : recent) past.age += h;
    const auto is_over = [](const PastImpulse& past) { return past.age >= force_window; };
    recent.erase(std::remove_if(recent.begin(), recent.end(), is_over), recent.end());
    const bool is_done = recent.empty() && with_contacts_.count(of_object->first) == 0;
    of_object = is_done ? recent_.erase(of_object) : std::next(of_object);
  }
}

void ContactLog::set_forces(std::size_t object, double h, std::vector<ContactState>& contacts) {
  std::vector<PastImpulse>& recent = recent_[object];
  for (auto first = contacts.begin(); first != contacts.end(); ++first) {
    const auto of_pair = [&](const ContactState& c) { return c.other == first->other; };
    if (std::any_of(contacts.begin(), first, of_pair)) continue;  // done with the first contact of the pair
    double impulse = 0.0, force = 0.0;
    int points = 0;
    for (auto c = first; c != contacts.end(); ++c) {
      if (!of_pair(*c)) continue;
      impulse += c->impulse;
      ++points;
    }
    recent.push_back({first->other, impulse, h, 0.0});
    for (const PastImpulse& past : recent) {
      if (past.other != first->other) continue;
      force += past.impulse * std::min(1.0, (force_window - past.age) / past.h) / force_window;
    }
    for (auto c = first; c != contacts.end(); ++c) {
      if (of_pair(*c)) c->force = force * (impulse > 0.0 ? c->impulse / impulse : 1.0 / points);
    }
  }
}

void ContactLog::copy(std::size_t object, const ContactLog& from, std::size_t its) {
  touching_[object].clear();
  for (const ContactState& c : from.touching_[its]) {
    if (c.other == "workbench" || scene::find_body(scene_, c.other)) touching_[object].push_back(c);
  }
  if (!touching_[object].empty()) with_contacts_.insert(object);
  if (const auto recent = from.recent_.find(its); recent != from.recent_.end()) recent_[object] = recent->second;
}

void ContactLog::archive(math::StateArchive& state) {
  for (const std::size_t object : with_contacts_) {
    if (state.is_restoring()) touching_[object].clear();
  }
  state(with_contacts_);
  for (const std::size_t object : with_contacts_) state(touching_.at(object));
  state(recent_, ended_, reported_);
}

std::vector<ContactState> ContactLog::all() const {
  std::vector<ContactState> list;
  for (const std::size_t object : with_contacts_) {
    list.insert(list.end(), touching_[object].begin(), touching_[object].end());
  }
  return list;
}

void ContactLog::begin_call() { before_ = all(); }

void ContactLog::end_call() {
  reported_ = all();
  for (ContactState& c : reported_) {
    c.phase = contains_pair(before_, c) ? ContactPhase::persisting : ContactPhase::started;
  }
  for (ContactState& c : ended_) {
    if (contains_pair(reported_, c)) continue;
    c.phase = ContactPhase::ended;
    reported_.push_back(c);
  }
  ended_.clear();
}

}  // namespace spring_workbench::contact
