#include "spring_workbench/contact/contact_stepper.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "constants.h"
#include "contact_rows.h"
#include "spring_workbench/geometry/shape_queries.h"
#include "spring_workbench/math/so3.h"
#include "spring_workbench/scene/constants.h"

namespace spring_workbench::contact {
ContactStepper::ContactStepper(const scene::Scene& scene, collision::CollisionWorld& collision, int impact_bisections)
    : scene_(scene), collision_(collision), levels_(impact_bisections) {
  for (const scene::Body& body : scene.bodies) radius_.push_back(geometry::bounding_radius(body.collision));
}

const scene::Material& ContactStepper::material(std::size_t body) const {
  return body == collision::CollisionWorld::bench ? scene_.bench_material : scene_.bodies[body].material;
}

void ContactStepper::add_contacts(std::size_t body, const RigidTransform& X_WO, double tolerance,
                                  std::vector<ContactRow>& rows, ContactOutcome& outcome) const {
  std::vector<collision::ContactPoint> found;
  collision_.find_contacts(body, X_WO, tolerance, found);
  ++outcome.queries;
  rows.reserve(rows.size() + found.size());
  // Of those that count as one, the deepest comes last and is the one.
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.depth < b.depth; });
  for (const collision::ContactPoint& point : found) {
    const auto same =
        std::find_if(rows.begin(), rows.end(), [&](const ContactRow& row) { return is_same(row.point, point); });
    ContactRow& row = same == rows.end() ? rows.emplace_back() : *same;
    row.point = point;
    row.friction = std::sqrt(material(body).friction * material(point.other).friction);
    row.compliance = scene::contact_compliance(material(body), material(point.other));
    row.gap = -point.depth;
    row.round = is_round(scene_, body) || is_round(scene_, point.other);
  }
}

void ContactStepper::refresh(const bodies::SteppedBody& body, std::vector<ContactRow>& rows, double depth,
                             ContactOutcome& outcome) const {
  if (rows.empty()) return;
  std::vector<ContactRow> before = std::move(rows);
  rows.clear();
  rows.reserve(before.size());
  const RigidTransform X_WO = body.object().X;
  std::vector<Vector3d> directions;
  std::vector<ContactRow> seen;
  for (const ContactRow& row : before) {
    const Vector3d& n = row.point.n_W;
    if (std::any_of(directions.begin(), directions.end(), [&](const Vector3d& d) { return d.dot(n) > one_normal; }))
      continue;
    directions.push_back(n);
    RigidTransform pushed = X_WO;
    pushed.translation() -= depth * n;
    seen.clear();
    add_contacts(body.index(), pushed, touching, seen, outcome);
    for (ContactRow& row_seen : seen) {
      if (row_seen.point.n_W.dot(n) < one_side) continue;
      row_seen.gap += depth * row_seen.point.n_W.dot(n);
      row_seen.point.depth = -row_seen.gap;
      rows.push_back(row_seen);
    }
  }
  // Loads of the last step are where the search for the new ones starts.
  for (ContactRow& row : rows) {
    const auto old = std::find_if(before.begin(), before.end(),
                                  [&](const ContactRow& o) { return is_same(o.point, row.point, 5.0 * same_point); });
    if (old == before.end()) continue;
    row.load_W = old->load_W;
    row.impulse_W = std::exchange(old->impulse_W, Vector3d::Zero());
  }
  std::copy_if(before.begin(), before.end(), std::back_inserter(outcome.rows), has_impulse);
}

bool ContactStepper::advance_in_contact(bodies::SteppedBody& body, double h, std::vector<ContactRow>& rows,
                                        ContactOutcome& outcome) const {
  const motion::MotionState begin = body.object();
  const RigidTransform& X0 = begin.X;
  std::vector<ContactRow> work = rows;
  std::vector<Start> starts;
  for (ContactRow& row : work) {
    row.lever_W = own_point(row) - X0.translation();
    starts.push_back({row.gap, row.lever_W});
  }
  Matrix6d C = body.response(h).displacement;
  const double radius = radius_[body.index()];
  double by_load = motion_by(total_load(work), C, radius);
  if (!body.advance(h, total_load(work))) return false;
  for (int solution = 1; solution <= max_solutions; ++solution) {
    look_at_end(body, X0, small_change * by_load, work, starts, outcome);
    std::vector<ContactRow> assumed = work;
    const std::vector<double> depths = indentations(assumed);
    const double room = body.uses_mean_velocity() && leave_room(work) ? std::min(slack, solved_share * by_load) : slack;
    double worst = 0.0;
    for (std::size_t i = 0; i < work.size(); ++i) {
      // What is deeper comes out slowly: at once it would be thrown out. Compliant materials push it out by their law.
      const bool complies = work[i].compliance > 0.0;
      work[i].gap += complies ? slack : std::max(room, -starts[i].gap * std::exp(-h / recovery_time));
      if (complies) work[i].gap += depths[i];
      worst = std::max(worst, -work[i].gap);
    }
    solve_contacts(problem_, C, touching, work);
    // Done when solving again would not move the body, however the contacts share what they carry.
    const Wrench load = total_load(work), corrects = load - total_load(assumed);
    const double change = motion_by(corrects, C, radius), path = extent(X0, body.object().X, radius);
    by_load = motion_by(load, C, radius);
    const double known = std::clamp(small_change * by_load, 1e-3 * touching, 0.1 * touching);
    if (worst < std::clamp(solved_share * path, slack, 3.0 * touching) &&
        change < std::max(known, std::min(solved_share * std::min(path, by_load), 10.0 * touching))) {
      rows = std::move(assumed);
      return true;
    }
    if (change * change > touching * radius) {
      body.restore(start_);
      if (!body.advance(h, load)) return false;
    } else {
      body.correct(h, corrects);
      if (solution > 1) C = body.response(h).displacement;
    }
  }
  return false;
}

void ContactStepper::look_at_end(const bodies::SteppedBody& body, const RigidTransform& X0, double fine,
                                 std::vector<ContactRow>& work, std::vector<Start>& starts,
                                 ContactOutcome& outcome) const {
  const RigidTransform X1 = body.object().X;
  const Vector3d moved_on = X1.translation() - X0.translation();
  const Vector3d rotation = X0.linear() * math::turn_between(X0, X1);
  // A point that stays on the surface slips by its path; one of a body that rolls comes or goes, and slips by what the
  // contact, which stays under the body, does.
  const auto set_slip = [&](ContactRow& row, const Vector3d& path, bool rolls) {
    const bool comes = rolls || std::abs(path.dot(row.point.n_W)) > touching;
    const Vector3d slip = comes ? Vector3d(moved_on + rotation.cross(row.lever_W)) : path;
    row.slip_W = slip - row.point.n_W * slip.dot(row.point.n_W);
  };
  std::vector<ContactRow> seen;  // at first what has rolled off: another point touches there, though it is not deep
  for (std::size_t i = 0; i < work.size(); ++i) {
    ContactRow& row = work[i];
    const Vector3d start = X0.translation() + starts[i].lever_W, path = moved(X0, X1, start) - start;
    const double along = path.dot(row.point.n_W);
    row.gap = starts[i].gap + along;
    row.point.p_W = start + path - (row.round ? row.gap : 0.0) * row.point.n_W;
    // The second order of a turn lifts a corner off; what is round lies on another of its points instead.
    const double lift = along - (moved_on + rotation.cross(starts[i].lever_W)).dot(row.point.n_W);
    starts[i].rolls = lift > fine && row.round;
    set_slip(row, path, starts[i].rolls);
    if (starts[i].rolls || along > touching) seen.push_back(row);
  }
  for (ContactRow& row : seen) row.impulse_W.setZero();
  refresh(body, seen, probe_depth, outcome);
  add_contacts(body.index(), X1, touching, seen, outcome);
  for (const ContactRow& row : seen) {
    std::size_t at = work.size();
    double nearest = 5.0 * same_point;
    for (std::size_t i = 0; i < work.size(); ++i) {
      const collision::ContactPoint& w = work[i].point;
      const double distance = (w.p_W - row.point.p_W).norm();
      if (w.other != row.point.other || w.n_W.dot(row.point.n_W) < scene::same_face || distance >= nearest) continue;
      nearest = distance;
      at = i;
    }
    const bool known = at < work.size();
    if (known && work[at].gap <= row.gap + (starts[at].rolls ? 0.0 : 0.1 * touching)) continue;
    const ContactRow before = known ? work[at] : ContactRow();
    const Vector3d start = moved(X1, X0, own_point(row)), path = own_point(row) - start;
    // One that is open at first is for the sweep to find: what reverses would bounce from a load that holds it.
    // A surface that is indented already holds it by the force of its depth.
    const bool is_open = row.gap - path.dot(row.point.n_W) > closed;
    if (!known && body.uses_mean_velocity() && is_open && !is_of_indented(row, work)) continue;
    if (!known) {
      work.emplace_back();
      starts.emplace_back();
    }
    work[at] = row;
    work[at].load_W = before.load_W;
    work[at].impulse_W = before.impulse_W;
    // It presses there when it has come: at its own point, which an unloaded substep carries deep into the other.
    work[at].lever_W = row.point.p_W + row.gap * row.point.n_W - X1.translation();
    set_slip(work[at], path, starts[at].rolls);
    starts[at] = {row.gap - path.dot(row.point.n_W), start - X0.translation(), starts[at].rolls};
  }
}

double ContactStepper::chord_deviation(std::size_t body, const motion::MotionState& begin,
                                       const motion::MotionState& end, double h) const {
  return h / 8.0 *
         ((end.velocity.linear - begin.velocity.linear).norm() +
          radius_[body] * (end.velocity.angular - begin.velocity.angular).norm());
}

ContactStepper::Obstruction ContactStepper::sweep(std::size_t body, const motion::MotionState& begin,
                                                  const motion::MotionState& end, double h,
                                                  const collision::Tolerance& admissible) const {
  const auto rates = [](const motion::MotionState& s) {
    return Vector3d(s.X.linear().transpose() * s.velocity.angular);
  };
  const motion::MotionSegment path({0.0, begin.X}, begin.velocity.linear, rates(begin), {h, end.X}, end.velocity.linear,
                                   rates(end));
  const int count = static_cast<int>(std::ceil(std::sqrt(chord_deviation(body, begin, end, h) / max_chord_deviation)));
  std::vector<collision::ContactPoint> inside;  // what it is in already, it may not go deeper into
  collision::Tolerance tolerance = admissible;
  collision_.find_contacts(body, begin.X, tolerance, inside);
  for (const collision::ContactPoint& point : inside) tolerance.raise(point.depth + 1e-3 * touching);
  RigidTransform from = begin.X;
  for (int i = 0; i < std::max(count, 1); ++i) {
    const RigidTransform to = i + 1 < count ? path.at(h * (i + 1) / count).X : end.X;
    const collision::SweepResult result = collision_.sweep(body, from, to, tolerance, sweep_resolution, levels_);
    if (result.hit) {
      return {true, (i + result.free_fraction) / std::max(count, 1),
              math::between(from, to, math::turn_between(from, to), result.touching_fraction)};
    }
    from = to;
  }
  return {};
}

ContactStepper::Substep ContactStepper::try_substep(bodies::SteppedBody& body, double h, const MotionCheck& is_allowed,
                                                    std::vector<ContactRow>& rows, ContactOutcome& outcome) const {
  const std::size_t index = body.index();
  const motion::MotionState begin = body.object();
  const bool in_contact = !rows.empty();
  std::vector<ContactRow> solved = rows;
  body.save(start_);
  const auto is_free = [this, index](const RigidTransform& X0_WO, const RigidTransform& X1_WO) {
    return !collision_.may_touch(index, X0_WO, X1_WO, max_chord_deviation) ||
           !collision_.sweep(index, X0_WO, X1_WO, touching, sweep_resolution, 1).hit;
  };
  const bool possible = in_contact ? advance_in_contact(body, h, solved, outcome) : body.advance_freely(h, is_free);
  if (!possible || !bodies::is_finite(body.object())) {
    body.restore(start_);
    outcome.refused = outcome.refused || !in_contact;
    return {false, in_contact ? reduction : 0.0, {}};
  }
  const motion::MotionState end = body.object();
  if (!is_allowed(begin.X, end.X)) {
    body.restore(start_);
    return {false, 0.0, {}, false};
  }
  const double deviation = chord_deviation(index, begin, end, h);
  const double straight = safety * std::sqrt(max_segments * max_segments * max_chord_deviation /
                                             std::max(deviation, 1e-3 * max_chord_deviation));
  if (in_contact || collision_.may_touch(index, begin.X, end.X, std::max(deviation, max_chord_deviation))) {
    if (straight < safety) {
      body.restore(start_);
      return {false, straight, {}};
    }
    const Obstruction found =
        sweep(index, begin, end, h, in_contact ? admissible_depths(rows, solved, deviation) : touching);
    ++outcome.queries;
    if (found.hit) {
      Substep substep{false, found.free, {}};
      body.restore(start_);
      add_contacts(index, found.X_WO, touching, substep.touched, outcome);
      // Between its ends it goes deeper into what it touches already: how deep is of second order.
      const bool sags = std::all_of(substep.touched.begin(), substep.touched.end(), [&](const ContactRow& at) {
        return std::any_of(rows.begin(), rows.end(), [&](const ContactRow& r) { return is_same(r.point, at.point); });
      });
      if (sags) substep.next = std::max(substep.next, reduction);
      for (ContactRow& row : substep.touched) {
        const Vector3d here = moved(found.X_WO, begin.X, row.point.p_W);
        row.gap = std::max(0.0, row.gap + (here - row.point.p_W).dot(row.point.n_W));
        row.point.p_W = here;
      }
      return substep;
    }
  }
  rows = std::move(solved);
  for (ContactRow& row : rows) row.impulse_W += h * row.load_W;
  body.accept();
  if (body.uses_mean_velocity()) correct_impulses(body, rows, h);
  return {true, in_contact ? std::clamp(straight, 0.5, max_growth) : max_growth, {}};
}

bool ContactStepper::step(bodies::SteppedBody& body, double h, const MotionCheck& is_allowed,
                          std::vector<ContactRow>& rows, ContactOutcome& outcome) {
  const MotionCheck allows_all = [](const RigidTransform&, const RigidTransform&) { return true; };
  if (const RigidTransform here = body.object().X; !is_allowed(here, here)) return false;
  double left = h, substep = h;
  bool met = false;  // since the last substep that was done
  for (ContactRow& row : rows) row.impulse_W.setZero();
  refresh(body, rows, probe_depth, outcome);
  collide(body, rows, Bounce::of_materials, h, h);
  for (int i = 0; i < max_tries && left > min_substep_share * h; ++i) {
    substep = std::min(substep, left);
    Substep tried = try_substep(body, substep, left == h ? is_allowed : allows_all, rows, outcome);
    if (!tried.allowed) return false;
    if (tried.done) {
      left -= substep;
      substep *= tried.next;
      met = false;
      if (left > min_substep_share * h) {
        refresh(body, rows, probe_depth, outcome);
        collide(body, rows, Bounce::none, h, std::min(substep, left));
      }
      continue;
    }
    double next = tried.next * substep;
    const bool meets =
        next < near_share * h && !tried.touched.empty() && meet(body, tried.touched, h, substep, rows, outcome);
    if (meets && !rows.empty()) next = std::exchange(met, true) ? reduction * substep : substep;
    if (next <= min_substep_share * h) break;
    substep = next;
  }
  if (left > min_substep_share * h) {
    body.block(left);
    outcome.time_lost += left;
    for (ContactRow& row : rows) row.load_W.setZero();  // a search from these loads has failed
  }
  const auto open =
      std::stable_partition(rows.begin(), rows.end(), [](const ContactRow& r) { return r.gap <= probe_depth; });
  std::copy_if(open, rows.end(), std::back_inserter(outcome.rows), has_impulse);
  rows.erase(open, rows.end());
  outcome.rows.insert(outcome.rows.end(), rows.begin(), rows.end());
  return true;
}

bool ContactStepper::meet(bodies::SteppedBody& body, const std::vector<ContactRow>& touched, double h, double substep,
                          std::vector<ContactRow>& rows, ContactOutcome& outcome) const {
  const motion::MotionState s = body.object();
  bool met = false;
  for (const ContactRow& row : touched) {
    const auto known =
        std::find_if(rows.begin(), rows.end(), [&](const ContactRow& r) { return is_same(r.point, row.point); });
    if (known == rows.end()) {
      rows.push_back(row);
      met = true;
      continue;
    }
    // One that the last solution has not kept open is taken as it is.
    const Vector3d v = s.velocity.linear + s.velocity.angular.cross(row.point.p_W - s.X.translation());
    met = met || v.dot(row.point.n_W) < -slow_approach;
    known->point = row.point;
    known->gap = std::min(known->gap, row.gap);
  }
  if (!met) return false;
  refresh(body, rows, landing_depth, outcome);
  keep_met(touched, rows);
  collide(body, rows, Bounce::of_materials, std::max(h, landing_time), substep);
  return true;
}

}  // namespace spring_workbench::contact
