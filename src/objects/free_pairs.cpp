#include "free_pairs.h"

#include <algorithm>

#include "constants.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::objects {

FreePairs::FreePairs(const scene::Scene& scene, const collision::CollisionWorld& collision,
                     contact::ContactStepper& stepper)
    : stepper_(stepper), around_(scene, collision, margin_near) {}

void FreePairs::begin(double h) {
  around_.clear();
  h_ = h;
}

void FreePairs::add_moving(std::size_t body, const RigidTransform& X_WO, const Twist& V_WO_W) {
  RigidTransform X1_WO = X_WO;
  X1_WO.translation() += h_ * V_WO_W.linear;
  X1_WO.linear() = math::exp_so3(h_ * V_WO_W.angular) * X_WO.linear();
  around_.add_moving(body, X_WO, X1_WO);
}

bool FreePairs::alone(const bodies::BodyPair& pair) const {
  const std::size_t first = pair.first().index(), second = pair.second().index();
  const auto these = [&](std::size_t body) { return body == first || body == second; };
  const auto none_else = [&](const std::vector<std::size_t>& found) {
    return std::all_of(found.begin(), found.end(), these);
  };
  const auto& path = pair.path();
  for (std::size_t i = 1; i < path.size(); ++i) {
    // The stepper works in the frame of the second body, in which everything else is at rest.
    if (!none_else(around_.inside(around_.box(first, path[i - 1].X_W1, path[i].X_W1))) ||
        !none_else(around_.inside(around_.box(second, path[i - 1].X_W2, path[i].X_W2))) ||
        !none_else(around_.standing(around_.box(first, path[i - 1].X_F1, path[i].X_F1))))
      return false;
  }
  return true;
}

bool FreePairs::step(bodies::BodyPair& pair, std::vector<contact::ContactRow>& rows,
                     contact::ContactOutcome& outcome) const {
  const auto anywhere = [](const RigidTransform&, const RigidTransform&) { return true; };
  stepper_.step(pair, h_, anywhere, rows, outcome);
  const RigidTransform X_WF = pair.X_WF();
  for (std::vector<contact::ContactRow>* of : {&rows, &outcome.rows}) {
    for (contact::ContactRow& row : *of) {
      row.point.p_W = X_WF * row.point.p_W;
      for (Vector3d* v : {&row.point.n_W, &row.lever_W, &row.slip_W, &row.load_W, &row.impulse_W}) {
        *v = X_WF.linear() * *v;
      }
    }
  }
  return alone(pair);
}

}  // namespace spring_workbench::objects
