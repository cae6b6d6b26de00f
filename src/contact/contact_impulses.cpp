// The impulses of `ContactStepper`: what takes effect at once, between two pieces of a step.
#include <algorithm>
#include <cmath>

#include "spring_workbench/contact/contact_stepper.h"

namespace spring_workbench::contact {
namespace {

constexpr double rest_speed = 0.02;  ///< [m/s]; a slower approach does not bounce
constexpr double stays_on = 1e-6;    ///< [m] along the normal; a point that has gone further has rolled off the contact

}  // namespace

void ContactStepper::collide(bodies::SteppedBody& body, const std::vector<ContactRow>& rows, Bounce bounce) const {
  const motion::MotionState s = body.object();
  std::vector<ContactRow> impulses;
  for (const ContactRow& row : rows) {
    ContactRow impulse = row;
    impulse.lever_W = row.point.p_W - s.X.translation();
    impulse.load_W.setZero();
    const Vector3d v = s.velocity.linear + s.velocity.angular.cross(impulse.lever_W);
    const double approach = v.dot(row.point.n_W);
    const scene::Material& a = scene_.bodies[body.index()].material;
    const scene::Material& b = row.point.other == collision::CollisionWorld::bench
                                   ? scene_.bench_material
                                   : scene_.bodies[row.point.other].material;
    const bool bounces = bounce == Bounce::of_materials && approach < -rest_speed;
    const double restitution = bounces ? std::sqrt(a.restitution * b.restitution) : 0.0;
    impulse.gap = (1.0 + restitution) * approach;
    impulse.slip_W = v - approach * row.point.n_W;
    impulses.push_back(impulse);
  }
  solve_contacts(body.mobility(), impulses);
  body.add_impulse(total_load(impulses));
}

void ContactStepper::settle(bodies::SteppedBody& body, const std::vector<ContactRow>& rows, double h) const {
  const motion::MotionState s = body.object();
  std::vector<ContactRow> impulses = rows;
  for (ContactRow& impulse : impulses) {
    const Vector3d& n = impulse.point.n_W;
    const Vector3d of_point = impulse.point.p_W - s.X.translation();
    const bool rolls = std::abs((of_point - impulse.lever_W).dot(n)) > stays_on;
    if (!rolls) impulse.lever_W = of_point;
    const Vector3d v = s.velocity.linear + s.velocity.angular.cross(impulse.lever_W);
    impulse.load_W *= h;
    impulse.gap = std::min(0.0, v.dot(n));
    impulse.slip_W = v - n * v.dot(n);
  }
  const Wrench given = total_load(impulses);
  solve_contacts(body.mobility(), impulses);
  const Wrench right = total_load(impulses);
  body.add_impulse({right.force - given.force, right.moment - given.moment});
}

}  // namespace spring_workbench::contact
