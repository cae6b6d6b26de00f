#include "spring_workbench/stepping/load_response.h"

#include <Eigen/Cholesky>

#include "range_stop.h"

namespace spring_workbench::stepping {

dynamics::Integrator::Response LoadResponse::response(dynamics::Integrator& integrator, const dynamics::HeldBody& body,
                                                      const dynamics::HandleState& handle, double h,
                                                      const dynamics::StrainState& state) const {
  dynamics::Integrator::Response r = integrator.response(body, handle, h, state);
  const rod::StrainMatrix symmetric = 0.5 * (r.q + r.q.transpose());
  if (!(r.q.allFinite() && r.q_dot.allFinite() && symmetric.llt().info() == Eigen::Success)) {
    rod::StrainMatrix resists = body.mass_matrix(handle.t, state.q) + h * body.damping();
    resists.diagonal() += h * h * body.stiffness();
    r.q_dot = h * resists.llt().solve(rod::StrainMatrix::Identity(body.size(), body.size()));
    r.q = h * r.q_dot;
  }
  for (Eigen::Index i = 0; i < stops_.cols(); ++i) {
    const rod::StrainVector out = stops_.col(i), path = r.q * out;
    if (!(out.dot(path) > 0.0)) continue;
    const rod::StrainVector stop = r.q.transpose() * out / out.dot(path);  // its force, by load
    r.q_dot -= r.q_dot * out * stop.transpose();
    r.q -= path * stop.transpose();
  }
  return r;
}

void LoadResponse::correct(dynamics::Integrator& integrator, const dynamics::HeldBody& body,
                           const dynamics::HandleState& handle, double h, const rod::StrainVector& change,
                           dynamics::StrainState& state) {
  const dynamics::Integrator::Response response_now = response(integrator, body, handle, h, state);
  dynamics::StrainState next{state.q + response_now.q * change, state.q_dot + response_now.q_dot * change};
  if (!body.shape().admissible(body.full_state(handle.t, next).q)) {
    stop_at_range(body, handle, h, state, next);
    // Compression has nothing in common with turning, whose slope turns with it.
    const rod::StrainVector slope = range_slope(body, handle.t, next.q);
    Eigen::Index known = 0;
    while (known < stops_.cols() && stops_.col(known).dot(slope) == 0.0) ++known;
    if (known == stops_.cols()) stops_.conservativeResize(slope.size(), known + 1);
    stops_.col(known) = slope;
  }
  state = next;
}

}  // namespace spring_workbench::stepping
