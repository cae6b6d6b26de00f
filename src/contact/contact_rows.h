#pragma once

#include <vector>

#include "constants.h"
#include "spring_workbench/contact/contact_solver.h"

namespace spring_workbench::contact {

/// Position of a point `p_W` of a body at `X0` when the body is at `X1`.
Vector3d moved(const RigidTransform& X0, const RigidTransform& X1, const Vector3d& p_W);
/// Upper bound of the distance that a point within `radius` of the origin moves between two poses [m].
double extent(const RigidTransform& X0, const RigidTransform& X1, double radius);

/// The point at which the body is touched: of a round one its own, at its radius; `point` is on the other body.
inline Vector3d own_point(const ContactRow& row) {
  return row.round ? Vector3d(row.point.p_W + row.gap * row.point.n_W) : row.point.p_W;
}
/// Returns whether no contact pushes against another, so that the body has room to move.
bool leave_room(const std::vector<ContactRow>& rows);
/// Upper bound of the distance that a point within `radius` of the body's centre moves by a load [m].
double motion_by(const Wrench& load, const Matrix6d& response, double radius);
/// Returns whether a body of the scene, or the bench, has a surface that is curved, so that what it touches can roll.
bool is_round(const scene::Scene& scene, std::size_t body);

bool is_same(const collision::ContactPoint& a, const collision::ContactPoint& b, double within = same_point);
inline bool has_impulse(const ContactRow& row) { return row.impulse_W != Vector3d::Zero(); }
/// Returns whether a row is compliant and there is a contact with the same other body.
bool is_of_indented(const ContactRow& row, const std::vector<ContactRow>& rows);

/// Adds to the rows seen with a body pushed in those that it has met and that are not among them: past an edge, it may
/// touch other faces alone so deep.
void keep_met(const std::vector<ContactRow>& met, std::vector<ContactRow>& seen);

/// Axes [normal, across, across] of a contact, in world.
Matrix3d axes_of(const ContactRow& row);
/// Motion of a contact's point along its axes per motion of the body.
Eigen::Matrix<double, 3, 6> jacobian(const Matrix3d& axes, const ContactRow& row);

/// Returns, for each row, the first one with the same body on the same side: such contacts indent one surface.
std::vector<std::size_t> surfaces_of(const std::vector<ContactRow>& rows);
/// Returns by how much the materials at each contact are indented along its normal: their compliance times the normal
/// loads of all contacts that indent the same surface.
std::vector<double> indentations(const std::vector<ContactRow>& rows);

/// Sets the compliance of rows to impulses over a substep of `h` [s]. Materials that carry no load yet are rigid if one
/// of their contacts hits; those that yield give nothing back.
void set_impulse_compliance(std::vector<ContactRow>& rows, const std::vector<bool>& hits, double h,
                            std::vector<double>& restitution);

/// Depths admissible on a path: that of a rigid contact, and in compliant ones that of the rows at both ends, with the
/// chord deviation of the path [m].
collision::Tolerance admissible_depths(const std::vector<ContactRow>& at_start, const std::vector<ContactRow>& at_end,
                                       double chord_deviation);

}  // namespace spring_workbench::contact
