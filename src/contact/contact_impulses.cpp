// The impulses of `ContactStepper`: what takes effect at once, between two pieces of a step.
#include <algorithm>
#include <cmath>

#include "constants.h"
#include "spring_workbench/contact/contact_stepper.h"
#include "spring_workbench/scene/constants.h"

namespace spring_workbench::contact {
void ContactStepper::collide(bodies::SteppedBody& body, const std::vector<ContactRow>& rows, Bounce bounce,
                             double h) const {
  if (rows.empty()) return;
  const motion::MotionState s = body.object();
  std::vector<ContactRow> impulses;
  for (const ContactRow& row : rows) {
    ContactRow impulse = row;
    impulse.lever_W = row.point.p_W - s.X.translation();
    impulse.load_W.setZero();
    const Vector3d v = s.velocity.linear + s.velocity.angular.cross(impulse.lever_W);
    const double approach = v.dot(row.point.n_W);
    const double may_approach = std::max(0.0, row.gap) / h;
    const bool hits = approach < -std::max(scene::rest_speed, may_approach);
    const double restitution =
        bounce == Bounce::of_materials && hits
            ? std::sqrt(material(body.index()).restitution * material(row.point.other).restitution)
            : 0.0;
    impulse.gap = restitution > 0.0 ? (1.0 + restitution) * approach : approach + may_approach;
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
    const bool rolls = std::abs((of_point - impulse.lever_W).dot(n)) > touching;
    if (!rolls) impulse.lever_W = of_point;
    const Vector3d v = s.velocity.linear + s.velocity.angular.cross(impulse.lever_W);
    impulse.load_W *= h;
    impulse.gap = v.dot(n) + std::max(0.0, impulse.gap) / h;
    impulse.slip_W = v - n * v.dot(n);
  }
  const Wrench given = total_load(impulses);
  solve_contacts(body.mobility(), impulses);
  body.add_impulse(total_load(impulses) - given);
}

}  // namespace spring_workbench::contact
