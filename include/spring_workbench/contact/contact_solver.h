#pragma once

#include <vector>

#include "spring_workbench/collision/collision_world.h"
#include "spring_workbench/friction/contact_problem.h"
#include "spring_workbench/math/spatial.h"
#include "spring_workbench/math/state_archive.h"

namespace spring_workbench::contact {

/// A contact as the solver sees it. The body's motion at its centre of mass is [displacement; rotation] or, for
/// impulses, [velocity; angular velocity], in world axes.
struct ContactRow {
  collision::ContactPoint point;
  Vector3d lever_W = Vector3d::Zero();  ///< from the body's centre of mass to the point
  double friction = 0.0;                ///< friction coefficient of the pair
  double compliance = 0.0;  ///< motion along the normal per load due to the pair's materials; 0 if they are rigid
  bool round = false;       ///< one of the two is curved, so that it can roll
  double gap = 0.0;         ///< along the normal, for the load assumed so far: must not become negative
  Vector3d slip_W = Vector3d::Zero();     ///< across the normal, for the load assumed so far: friction opposes it
  Vector3d load_W = Vector3d::Zero();     ///< force (impulse) on the body; in: assumed, out: solved
  Vector3d impulse_W = Vector3d::Zero();  ///< on the body in this step so far, of loads and impacts [N·s]

  void archive(math::StateArchive& state) {
    state(point.other, point.p_W, point.n_W, point.depth, lever_W, friction, compliance, gap, slip_W, load_W,
          impulse_W);
  }
};

/// Finds the loads of Signorini's and Coulomb's laws: gap ≥ 0 ⊥ normal load ≥ 0, and either the slip is zero or the
/// friction opposes it with μ times the normal load. `response` (6 × 6, ≥ 0): change of the body's motion per wrench at
/// the centre of mass. `enough`: see friction::ContactProblem, whose memory is used.
void solve_contacts(friction::ContactProblem& problem, const Matrix6d& response, double enough,
                    std::vector<ContactRow>& rows);

/// Sum of the rows' loads as a wrench at the centre of mass, world axes.
Wrench total_load(const std::vector<ContactRow>& rows);

}  // namespace spring_workbench::contact
