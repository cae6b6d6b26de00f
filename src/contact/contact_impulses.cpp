// The impulses of `ContactStepper`: what takes effect at once, between two substeps.
#include <algorithm>
#include <cmath>
#include <limits>

#include "constants.h"
#include "contact_rows.h"
#include "impact.h"
#include "spring_workbench/contact/contact_stepper.h"
#include "spring_workbench/scene/constants.h"

namespace spring_workbench::contact {

void ContactStepper::collide(bodies::SteppedBody& body, std::vector<ContactRow>& rows, Bounce bounce, double h,
                             double substep) const {
  const motion::MotionState s = body.object();
  std::vector<ContactRow> contacts = rows;
  std::vector<double> restitution;
  std::vector<bool> hits;
  bool approach = false;
  for (ContactRow& row : contacts) {
    row.lever_W = own_point(row) - s.X.translation();
    const Vector3d v = s.velocity.linear + s.velocity.angular.cross(row.lever_W);
    const double speed = -v.dot(row.point.n_W), may_approach = std::max(0.0, row.gap) / h;
    hits.push_back(speed > std::max(scene::rest_speed, may_approach));
    const double of_both = material(body.index()).restitution * material(row.point.other).restitution;
    restitution.push_back(bounce == Bounce::of_materials && hits.back() ? std::sqrt(of_both) : 0.0);
    approach = approach || speed > may_approach;
  }
  if (!approach) return;
  const Matrix6d mobility = body.mobility();
  const bool massless = mobility.isZero(0.0);  // takes no impulse, however long the substep
  set_impulse_compliance(contacts, hits, massless ? std::numeric_limits<double>::infinity() : substep, restitution);
  body.add_impulse(impact(problem_, mobility, to_vector(s.velocity), contacts, restitution, h));
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].impulse_W += contacts[i].load_W;
}

void ContactStepper::correct_impulses(bodies::SteppedBody& body, std::vector<ContactRow>& rows, double h) const {
  const motion::MotionState s = body.object();
  std::vector<ContactRow> impulses = rows;
  for (ContactRow& impulse : impulses) {
    const Vector3d& n = impulse.point.n_W;
    const Vector3d at = own_point(impulse) - s.X.translation();
    if (impulse.round || std::abs((at - impulse.lever_W).dot(n)) <= touching) impulse.lever_W = at;
    const Vector3d v = s.velocity.linear + s.velocity.angular.cross(impulse.lever_W);
    impulse.load_W *= h;
    impulse.compliance /= h * h;
    impulse.gap = v.dot(n) + std::max(0.0, impulse.gap) / h;
    impulse.slip_W = v - n * v.dot(n);
  }
  const Wrench given = total_load(impulses);
  solve_contacts(problem_, body.mobility(), touching / h, impulses);
  body.add_impulse(total_load(impulses) - given);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].impulse_W += impulses[i].load_W - h * rows[i].load_W;
}

}  // namespace spring_workbench::contact
