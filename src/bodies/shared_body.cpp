#include "spring_workbench/bodies/shared_body.h"

#include <Eigen/Cholesky>
#include <utility>

#include "spring_workbench/math/so3.h"

namespace spring_workbench::bodies {
namespace {

RigidTransform displaced(const RigidTransform& X, const Vector6d& by) {
  RigidTransform moved = X;
  moved.linear() = Quaterniond(math::exp_so3(by.tail<3>()) * X.linear()).normalized().toRotationMatrix();
  moved.translation() += by.head<3>();
  return moved;
}

}  // namespace

/// (A + Pᵀ B P) f = relaxed − Pᵀ d, with the displacement d without tools and B = h² mobility.
struct SharedBody::Pulls {
  Matrix6d B;
  Eigen::MatrixXd P, A;  ///< of all tools, side by side
  Eigen::VectorXd relaxed;
  std::vector<Eigen::Index> begin;  ///< of each tool's columns, and the end
  std::vector<bool> pushes_only;    ///< by tool

  Eigen::VectorXd solve(const Vector6d& d) const {
    Eigen::MatrixXd left = A + P.transpose() * B * P;
    Eigen::VectorXd right = relaxed - P.transpose() * d;
    Eigen::VectorXd f;
    for (std::size_t tries = 0; tries <= pushes_only.size(); ++tries) {
      f = left.ldlt().solve(right);
      if (!drop_what_would_pull(f, left, right)) break;
    }
    return f;
  }
  /// A tool that can only push and would pull is off the object. False when there is none.
  bool drop_what_would_pull(Eigen::VectorXd& f, Eigen::MatrixXd& left, Eigen::VectorXd& right) const {
    for (std::size_t i = 0; i < pushes_only.size(); ++i) {
      const Eigen::Index c = begin[i];
      if (!pushes_only[i] || f[c] >= 0.0) continue;
      left.row(c).setZero();
      left.col(c).setZero();
      left(c, c) = 1.0;
      right[c] = 0.0;
      return true;
    }
    return false;
  }
};

SharedBody::SharedBody(std::size_t index, const scene::Body& body, double gravity, const RigidTransform& X_WO,
                       const Twist& V_WO_W, std::vector<CoupledTool*> tools)
    : free_(index, body, gravity, X_WO, V_WO_W), tools_(std::move(tools)) {}

SharedBody::Pulls SharedBody::pulls(double h) const {
  Pulls all;
  all.B = h * h * free_.mobility();
  std::vector<Coupling> couplings;
  all.begin.push_back(0);
  for (const CoupledTool* tool : tools_) {
    couplings.push_back(tool->coupling(h, free_.object().X, free_.mobility()));
    all.begin.push_back(all.begin.back() + couplings.back().relaxed.size());
    all.pushes_only.push_back(couplings.back().pushes_only);
  }
  const Eigen::Index n = all.begin.back();
  all.P.resize(6, n);
  all.A = Eigen::MatrixXd::Zero(n, n);
  all.relaxed.resize(n);
  for (std::size_t i = 0; i < couplings.size(); ++i) {
    const Eigen::Index c = all.begin[i], size = all.begin[i + 1] - c;
    all.P.middleCols(c, size) = couplings[i].directions;
    all.A.block(c, c, size, size) = couplings[i].compliance;
    all.relaxed.segment(c, size) = couplings[i].relaxed;
  }
  return all;
}

bool SharedBody::advance(double h, const Wrench& contact_W) {
  const motion::MotionState begin = free_.object();
  FreeBody alone = free_;
  if (!alone.advance(h, contact_W)) return false;
  const Vector6d velocity = to_vector(alone.object().velocity);
  const Pulls all = pulls(h);
  const Eigen::VectorXd f = all.solve(h * velocity);
  const Vector6d pull = all.P * f;
  const Vector6d displacement = h * velocity + all.B * pull;
  if (!displacement.allFinite()) return false;
  motion::MotionState end;
  end.X = displaced(begin.X, displacement);
  end.velocity = to_twist(displacement / h);
  free_.set_motion(end);
  for (std::size_t i = 0; i < tools_.size(); ++i) {
    const Eigen::Index c = all.begin[i], size = all.begin[i + 1] - c;
    const Vector6d of_tool = all.P.middleCols(c, size) * f.segment(c, size);
    tools_[i]->follow(h, end, to_wrench(of_tool));
  }
  return true;
}

void SharedBody::save(TrialStart& start) const {
  State state{{}, std::vector<TrialStart>(tools_.size())};
  free_.save(state.free);
  for (std::size_t i = 0; i < tools_.size(); ++i) tools_[i]->save(state.tools[i]);
  start.keep(state);
}

void SharedBody::restore(const TrialStart& start) {
  const State& state = start.kept<State>();
  free_.restore(state.free);
  for (std::size_t i = 0; i < tools_.size(); ++i) tools_[i]->restore(state.tools[i]);
}

SteppedBody::Response SharedBody::response(double h) const {
  const Pulls all = pulls(h);
  // What a tool that can only push does to a load is asked as if it stayed on the object.
  const Eigen::MatrixXd BP = all.B * all.P;
  const Eigen::MatrixXd left = all.A + all.P.transpose() * BP;
  const Matrix6d displacement = all.B - BP * left.ldlt().solve(BP.transpose());
  return {displacement, displacement / h};
}

void SharedBody::block(double h) {
  free_.block(h);
  const motion::MotionState here = free_.object();
  for (CoupledTool* tool : tools_) tool->follow(h, here, Wrench());
}

}  // namespace spring_workbench::bodies
