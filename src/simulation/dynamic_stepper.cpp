#include "dynamic_stepper.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "spring_workbench/engines/contact_engines.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench {
namespace {

constexpr double longest_piece = 2e-3;     ///< [s] where something is touched
constexpr double shortest_step = 1e-9;     ///< [s]; of a step shorter than this contact takes no notice
constexpr double least_travel = 2e-4;      ///< [m] towards something that is touched, in a piece
constexpr double as_free = 0.9;            ///< of a piece, for which it is taken
constexpr double as_possible = 0.8;        ///< of a piece gone, for which it is taken
constexpr double growth = 2.0;             ///< from one piece to the next, at most
constexpr int most_pieces = 5000;          ///< of one step
/// Contact keeps clear the way over a piece for the most part, and for this part the way that the velocity at its end would
/// make. Of the way alone, the velocity of a soft fork would change its sign with every piece, for ever; of the velocity
/// alone, a stiff fork would not answer. Both errors shrink by a half in a piece with this share.
constexpr double velocity_share = 0.1;
constexpr double margin_near = 2e-3;       ///< [m]
constexpr double same_point = 2e-3;        ///< [m]

}  // namespace

DynamicStepper::DynamicStepper(const Scene& scene) : scene_(scene), world_(open_rigid_world(scene)) {}

RigidWorld::Freedom DynamicStepper::freedom(const SteppedBody& body, const MotionState& begin, const MotionState& end,
                                            double h) const {
  if (!others_awake() && !world_->may_touch(body.index(), begin.X, end.X, margin_near)) return {h, h, false};
  Twist mean;
  mean.linear = (end.X.translation() - begin.X.translation()) / h;
  mean.angular = begin.X.linear() * log_so3(begin.X.linear().transpose() * end.X.linear()) / h;
  return world_->freedom(body.index(), begin.X, {mean, end.velocity}, least_travel, h);
}

DynamicStepper::Candidate DynamicStepper::try_piece(SteppedBody& body, double h) const {
  Candidate c;
  c.begin = body.object();
  c.answer = body.answer(h);
  const auto load = load_W_.find(body.index());
  if (load != load_W_.end()) c.load_W = load->second;
  body.remember();
  c.possible = body.advance(h, c.load_W);
  c.end = c.possible ? body.object() : c.begin;
  if (!c.possible) c.end.velocity = Twist();
  c.freedom = freedom(body, c.begin, c.end, h);
  return c;
}

std::vector<DynamicStepper::Candidate> DynamicStepper::try_pieces(const std::vector<SteppedBody*>& held,
                                                                  double& h) const {
  const double shortest = std::min(h, shortest_piece_);
  for (;;) {
    std::vector<Candidate> candidates;
    double wanted = others_awake() ? std::min(h, longest_piece) : h;
    for (SteppedBody* body : held) {
      candidates.push_back(try_piece(*body, h));
      const RigidWorld::Freedom& freedom = candidates.back().freedom;
      wanted = std::min({wanted, freedom.until_near, freedom.near ? longest_piece : wanted});
    }
    wanted = std::max(wanted, shortest);
    if (wanted >= as_free * h) return candidates;
    for (SteppedBody* body : held) body->go_back();
    h = wanted;
  }
}

void DynamicStepper::go_freely(const std::vector<SteppedBody*>& held, const std::vector<Candidate>& candidates, double h,
                               Outcome& outcome) {
  for (std::size_t i = 0; i < held.size(); ++i) {
    if (!candidates[i].possible) {
      held[i]->go_back();
      held[i]->stay(h);
      outcome.refused = true;
    }
    held[i]->accept();
    load_W_.erase(held[i]->index());
    const MotionState s = held[i]->object();
    world_->place(held[i]->index(), s.X, s.velocity, false);
  }
}

DynamicStepper::Outcome DynamicStepper::step(const std::vector<SteppedBody*>& held, double h) {
  contacts_.clear();
  held_.clear();
  std::map<std::size_t, Wrench> loads;
  for (const SteppedBody* body : held) {
    held_.push_back(body->index());
    loads[body->index()] = load_W_[body->index()];
  }
  load_W_ = std::move(loads);
  shortest_piece_ = h / most_pieces;
  Outcome outcome;
  double left = h, piece = h;
  while (left > 1e-9 * h) {
    piece = std::min(piece, left);
    if (left < growth * piece && left > piece) piece = 0.5 * left;  // no small last one
    const std::vector<Candidate> candidates = try_pieces(held, piece);
    const bool near = std::any_of(candidates.begin(), candidates.end(), [](const auto& c) { return c.freedom.near; });
    ++outcome.pieces;
    if (h <= shortest_step || !(near || others_awake())) {
      go_freely(held, candidates, piece, outcome);
    } else if (!go_in_contact(held, candidates, piece, outcome)) {
      continue;
    }
    left -= piece;
    piece *= growth;
  }
  return outcome;
}

bool DynamicStepper::go_in_contact(const std::vector<SteppedBody*>& held, const std::vector<Candidate>& candidates,
                                   double& h, Outcome& outcome) {
  std::vector<DrivenBody> driven;
  for (std::size_t i = 0; i < held.size(); ++i) driven.push_back(driven_body(held[i]->index(), candidates[i], h));
  world_->remember();
  world_->step(h, driven);
  double possible = h;
  for (std::size_t i = 0; i < held.size(); ++i) {
    const Wrench& contact = driven[i].contact_W;
    const Candidate& c = candidates[i];
    if (contact.force != c.load_W.force || contact.moment != c.load_W.moment || !c.possible) {
      held[i]->go_back();
      if (!held[i]->advance(h, contact)) {
        held[i]->stay(h);
        outcome.held_back = true;
      }
    }
    const RigidWorld::Freedom freely = freedom(*held[i], c.begin, held[i]->object(), h);
    possible = std::min({possible, freely.until_near, freely.towards_near});
  }
  if (possible < as_possible * h && h > shortest_piece_) {
    world_->go_back();
    for (SteppedBody* body : held) body->go_back();
    h = std::max(possible, shortest_piece_);
    return false;
  }
  for (std::size_t i = 0; i < held.size(); ++i) {
    held[i]->accept();
    load_W_[held[i]->index()] = driven[i].contact_W;
    const MotionState s = held[i]->object();
    world_->place(held[i]->index(), s.X, s.velocity, true);
  }
  add_contacts();
  return true;
}

DrivenBody DynamicStepper::driven_body(std::size_t body, const Candidate& c, double h) {
  DrivenBody d;
  d.body = body;
  d.compliance = (1.0 - velocity_share) * c.answer.displacement + velocity_share * h * c.answer.velocity;
  d.X_WO = c.begin.X;
  const Vector3d moved = c.end.X.translation() - c.begin.X.translation();
  const Vector3d turned = c.begin.X.linear() * log_so3(c.begin.X.linear().transpose() * c.end.X.linear());
  d.displacement_W.linear = (1.0 - velocity_share) * moved + velocity_share * h * c.end.velocity.linear;
  d.displacement_W.angular = (1.0 - velocity_share) * turned + velocity_share * h * c.end.velocity.angular;
  Vector6d load;
  load << c.load_W.force, c.load_W.moment;
  const Vector6d by_load = d.compliance * load;
  d.displacement_W.linear -= by_load.head<3>();
  d.displacement_W.angular -= by_load.tail<3>();
  return d;
}

void DynamicStepper::set_free(std::size_t body, const RigidTransform& X_WO, const Twist& V_WO_W) {
  world_->place(body, X_WO, V_WO_W, true);
  held_.erase(std::remove(held_.begin(), held_.end(), body), held_.end());
}

bool DynamicStepper::others_awake() const {
  const std::vector<std::size_t>& near = world_->bodies_near();
  return std::any_of(near.begin(), near.end(), [&](std::size_t body) {
    return world_->awake(body) && std::find(held_.begin(), held_.end(), body) == held_.end();
  });
}

bool DynamicStepper::comes_first(std::size_t body, std::size_t other) const {
  const auto rank = [&](std::size_t b) {
    if (b == RigidWorld::bench || !scene_.bodies[b].movable) return 2;
    return std::find(held_.begin(), held_.end(), b) != held_.end() ? 0 : 1;
  };
  return rank(body) <= rank(other);
}

void DynamicStepper::add_contacts() {
  for (WorldContact& known : contacts_) known.depth = 0.0;
  for (WorldContact c : world_->contacts()) {
    if (!comes_first(c.body, c.other)) {
      std::swap(c.body, c.other);
      c.n_W = -c.n_W;
      c.impulse_W = -c.impulse_W;
    }
    const auto same = std::find_if(contacts_.begin(), contacts_.end(), [&](const WorldContact& known) {
      return known.body == c.body && known.other == c.other && known.n_W.dot(c.n_W) > 0.99 &&
             (known.p_W - c.p_W).norm() < same_point;
    });
    if (same == contacts_.end()) {
      contacts_.push_back(c);
      continue;
    }
    const Vector3d sum = same->impulse_W + c.impulse_W;
    *same = c;
    same->impulse_W = sum;
  }
}

}  // namespace spring_workbench
