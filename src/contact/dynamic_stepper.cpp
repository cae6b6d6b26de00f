#include "spring_workbench/contact/dynamic_stepper.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "constants.h"
#include "spring_workbench/contact/contact_engines.h"
#include "spring_workbench/math/so3.h"
#include "world_results.h"

namespace spring_workbench::contact {
DynamicStepper::DynamicStepper(const scene::Scene& scene)
    : scene_(scene), world_(open_rigid_world(scene)), substep_(rough_substep) {}

DynamicStepper::Candidate DynamicStepper::try_substep(bodies::SteppedBody& body, double h) const {
  Candidate c;
  c.body = &body;
  c.begin = body.object();
  if (const auto load = load_W_.find(body.index()); load != load_W_.end()) c.load_W = load->second;
  body.save(c.start);
  c.possible = body.advance(h, c.load_W) && bodies::is_finite(body.object());
  c.end = c.possible ? body.object() : c.begin;
  if (!c.possible) c.end.velocity = Twist();
  return c;
}

bool DynamicStepper::all_free(const std::vector<Candidate>& candidates) const {
  if (others_awake()) return false;
  return std::all_of(candidates.begin(), candidates.end(), [&](const Candidate& c) {
    return is_zero(c.load_W) && (!world_->may_touch(c.body->index(), c.begin.X, c.end.X, margin_near) ||
                                 world_->collision_free_fraction(c.body->index(), c.begin.X, c.end.X) >= 1.0);
  });
}

void DynamicStepper::step_freely(const std::vector<Candidate>& candidates, double h, Outcome& outcome) {
  for (const Candidate& c : candidates) {
    if (!c.possible) {
      c.body->restore(c.start);
      c.body->block(h);
      outcome.refused = true;
      outcome.time_lost += h;
    }
    c.body->accept();
    load_W_.erase(c.body->index());
    const motion::MotionState s = c.body->object();
    world_->place(c.body->index(), s.X, s.velocity, false);
  }
}

DynamicStepper::Outcome DynamicStepper::step(const std::vector<bodies::SteppedBody*>& held, double h) {
  contacts_.clear();
  std::vector<std::size_t> now_held;
  std::map<std::size_t, Wrench> loads;
  for (const bodies::SteppedBody* body : held) {
    now_held.push_back(body->index());
    loads[body->index()] = load_W_[body->index()];
  }
  load_W_ = std::move(loads);
  if (now_held != held_) substep_ = rough_substep;
  held_ = std::move(now_held);
  min_substep_ = min_substep * std::min(1.0, h / rough_substep);
  Outcome outcome;
  double left = h, substep = h;
  while (left > min_substep_share * h) {
    substep = std::min(substep, left);
    if (left < max_growth * substep && left > substep) substep = 0.5 * left;  // no small last one
    std::vector<Candidate> candidates;
    for (bodies::SteppedBody* body : held) candidates.push_back(try_substep(*body, substep));
    ++outcome.substeps;
    if (h <= min_step || all_free(candidates)) {
      step_freely(candidates, substep, outcome);
    } else {
      const Result result = step_in_contact(std::move(candidates), substep);
      if (result == Result::too_long) continue;
      if (result == Result::done_unsolved) ++outcome.unsolved;
      outcome.path_error = std::max(outcome.path_error, world_->path_error());
      if (result == Result::stuck) {
        substep = std::min(blocked_substep, left);
        block(held, substep, outcome);
      }
    }
    left -= substep;
    substep *= max_growth;
  }
  return outcome;
}

DynamicStepper::Result DynamicStepper::step_in_contact(std::vector<Candidate> candidates, double& h) {
  const auto start_again = [&] {
    for (const Candidate& c : candidates) c.body->restore(c.start);
  };
  start_again();
  if (h > substep_) {
    h = substep_;
    return Result::too_long;
  }
  const auto repeat = [&](double shorter) {
    world_->undo_step();
    start_again();
    h = shorter;
    return Result::too_long;
  };
  const auto shorten = [&](double admissible) {
    return repeat(std::max(std::clamp(safety * admissible, min_retry, max_retry) * h, min_substep_));
  };
  std::vector<rigid_bodies::DrivenBody> driven = solve(candidates, h);
  if (const double substep = admissible_substep(h); substep < h) return repeat(substep);
  const double free_admissible = world_->admissible_fraction_of_free();
  if (free_admissible < 1.0 && h > min_substep_) return shorten(free_admissible);
  double admissible = admissible_fraction(candidates, driven, h);
  double before = 0.0;
  for (int solution = 1; admissible < 1.0 && admissible > before && solution < max_dynamic_solutions; ++solution) {
    if (predicted_admissible_fraction(driven) < 1.0) break;
    before = admissible;
    // The fork responds to this load otherwise than to the one assumed: solve again, about this one.
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      candidates[i].end = candidates[i].body->object();
      candidates[i].load_W = driven[i].contact_W;
      candidates[i].impact_W = driven[i].impact_W;
    }
    start_again();
    world_->undo_step();
    driven = solve(candidates, h);
    admissible = admissible_fraction(candidates, driven, h);
  }
  if (admissible < 1.0) {
    const bool is_min = h <= min_substep_;
    shorten(admissible);
    return is_min ? Result::stuck : Result::too_long;
  }
  for (std::size_t i = 0; i < candidates.size(); ++i) take(*candidates[i].body, driven[i].contact_W);
  add_contacts();
  return free_admissible < 1.0 || !world_->solved() ? Result::done_unsolved : Result::done;
}

double DynamicStepper::admissible_substep(double h) {
  if (world_->first_bounce() < h) return world_->first_bounce();
  const double error = world_->path_error();
  substep_ = std::max(rough_substep, h * std::clamp(safety * std::sqrt(max_path_error / error), min_retry, max_growth));
  return error > max_path_error ? std::min(substep_, h) : h;
}

std::vector<rigid_bodies::DrivenBody> DynamicStepper::solve(const std::vector<Candidate>& candidates, double h) {
  std::vector<rigid_bodies::DrivenBody> driven;
  for (const Candidate& c : candidates) driven.push_back(driven_body(c, h));
  world_->step(h, driven);
  return driven;
}

double DynamicStepper::admissible_fraction(const std::vector<Candidate>& candidates,
                                           const std::vector<rigid_bodies::DrivenBody>& driven, double h) const {
  double admissible = 1.0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    bodies::SteppedBody& body = *candidates[i].body;
    if (!is_zero(driven[i].impact_W)) body.add_impulse(driven[i].impact_W);
    if (!body.advance(h, driven[i].contact_W) || !bodies::is_finite(body.object())) return 0.0;
    admissible =
        std::min(admissible, world_->admissible_fraction(body.index(), candidates[i].begin.X, body.object().X));
  }
  return admissible;
}

double DynamicStepper::predicted_admissible_fraction(const std::vector<rigid_bodies::DrivenBody>& driven) const {
  double admissible = 1.0;
  for (const rigid_bodies::DrivenBody& d : driven) {
    admissible = std::min(admissible, world_->admissible_fraction(d.body, d.X_WO, predicted_end(d)));
  }
  return admissible;
}

void DynamicStepper::block(const std::vector<bodies::SteppedBody*>& held, double& h, Outcome& outcome) {
  std::vector<rigid_bodies::DrivenBody> driven(held.size());
  for (std::size_t i = 0; i < held.size(); ++i) {
    driven[i].body = held[i]->index();
    driven[i].X_WO = held[i]->object().X;
  }
  h = step_until_bounce(*world_, h, driven);
  for (bodies::SteppedBody* body : held) {
    body->block(h);
    take(*body, Wrench());
  }
  add_contacts();
  outcome.time_lost += h;
}

void DynamicStepper::take(bodies::SteppedBody& body, const Wrench& contact_W) {
  body.accept();
  load_W_[body.index()] = contact_W;
  const motion::MotionState s = body.object();
  world_->place(body.index(), s.X, s.velocity, true);
}

rigid_bodies::DrivenBody DynamicStepper::driven_body(const Candidate& c, double h) {
  const bodies::SteppedBody::Response response = c.body->response(h);
  rigid_bodies::DrivenBody d;
  d.body = c.body->index();
  d.X_WO = c.begin.X;
  d.V_WO_W = c.begin.velocity;
  d.compliance = 0.5 * (response.displacement + response.displacement.transpose());
  d.mobility = c.body->mobility();
  d.displacement_by_impulse = response.by_impulse;
  const Vector6d by_load = d.compliance * to_vector(c.load_W) + d.displacement_by_impulse * to_vector(c.impact_W);
  d.displacement_W.linear = c.end.X.translation() - c.begin.X.translation() - by_load.head<3>();
  d.displacement_W.angular = c.begin.X.linear() * math::turn_between(c.begin.X, c.end.X) - by_load.tail<3>();
  return d;
}

void DynamicStepper::archive(math::StateArchive& state) { state(contacts_, held_, load_W_, substep_, *world_); }

void DynamicStepper::set_free(std::size_t body, const RigidTransform& X_WO, const Twist& V_WO_W) {
  world_->place(body, X_WO, V_WO_W, true);
  held_.erase(std::remove(held_.begin(), held_.end(), body), held_.end());
  substep_ = rough_substep;
}

std::vector<std::size_t> DynamicStepper::alone(const std::vector<std::size_t>& moving, double h) const {
  std::vector<std::size_t> alone;
  for (const std::size_t body : world_->bodies_near()) {
    const bool held = std::find(held_.begin(), held_.end(), body) != held_.end();
    if (held || !world_->awake(body) || !(scene_.bodies[body].mass_properties.mass > 0.0)) continue;
    const RigidTransform& X0 = world_->pose(body);
    RigidTransform X1 = X0;
    X1.translation() += h * world_->velocity(body).linear;
    X1.linear() = math::exp_so3(h * world_->velocity(body).angular) * X0.linear();
    if (world_->movable_near(body, X0, X1, h, moving, 1).empty()) alone.push_back(body);
  }
  return alone;
}

bool DynamicStepper::others_awake() const {
  const std::vector<std::size_t>& near = world_->bodies_near();
  return std::any_of(near.begin(), near.end(), [&](std::size_t body) {
    return world_->awake(body) && std::find(held_.begin(), held_.end(), body) == held_.end();
  });
}

bool DynamicStepper::has_priority(std::size_t body, std::size_t other) const {
  const auto rank = [&](std::size_t b) {
    if (b == rigid_bodies::RigidWorld::bench || !scene_.bodies[b].movable) return 2;
    return std::find(held_.begin(), held_.end(), b) != held_.end() ? 0 : 1;
  };
  return rank(body) <= rank(other);
}

void DynamicStepper::add_contacts() {
  for (rigid_bodies::WorldContact& known : contacts_) known.depth = 0.0;
  for (rigid_bodies::WorldContact c : world_->contacts()) {
    if (!has_priority(c.body, c.other)) swap_bodies(c);
    add_contact(c, contacts_);
  }
}

}  // namespace spring_workbench::contact
