#include "spring_workbench/friction/surfaces.h"

#include <algorithm>
#include <utility>

#include "constants.h"

namespace spring_workbench::friction {

using Eigen::Vector3d;

Surfaces::Surfaces(std::vector<double> compliance)
    : compliance_(std::move(compliance)),
      none_(std::all_of(compliance_.begin(), compliance_.end(), [](double c) { return c == 0.0; })) {}

double Surfaces::compliance_of(int body) const {
  return body < 0 ? compliance_.back() : compliance_[static_cast<std::size_t>(body)];
}

void Surfaces::begin_step(double h) {
  h_ = h;
  indented_before_ = std::move(indented_);
  indented_.clear();
}

double Surfaces::indentation(std::size_t a, std::size_t b) const {
  const auto [lower, higher] = std::minmax({static_cast<int>(a), static_cast<int>(b)});
  const auto found = indented_.find(Pair{lower, higher});
  return found == indented_.end() ? 0.0 : found->second;
}

bool Surfaces::is_one(const Vector3d& n, const Vector3d& other_n) { return n.dot(other_n) > same_side; }

int Surfaces::between(int a, int b, const Vector3d& n, bool fast) {
  const double compliance = compliance_of(a) + compliance_of(b);
  if (compliance == 0.0) return -1;
  const Pair bodies{std::min(a, b), std::max(a, b)};
  auto found = std::find_if(surfaces_.begin(), surfaces_.end(),
                            [&](const Surface& s) { return s.bodies == bodies && is_one(s.n, n); });
  if (found == surfaces_.end()) found = surfaces_.insert(found, Surface{bodies, n, compliance / (h_ * h_)});
  found->collides = found->collides || (fast && indented_before_.count(bodies) == 0);
  return static_cast<int>(found - surfaces_.begin());
}

void Surfaces::stop(int surface) {
  if (surface >= 0) surfaces_[static_cast<std::size_t>(surface)].collides = false;
}

void Surfaces::add_to(ContactProblem& problem, bool unloaded) {
  for (Surface& s : surfaces_) {
    if (unloaded) s.impulse.setZero();
    const std::size_t body = problem.add_body(s.response * Eigen::Matrix3d::Identity());
    if (&s == &surfaces_.front()) first_ = body;
  }
}

void Surfaces::add_part(ContactProblem& problem, int surface, const Vector3d& n) const {
  if (complies(surface))
    problem.add_part(first_ + static_cast<std::size_t>(surface), Vector3d::UnitX() * n.transpose());
}

void Surfaces::add_load(int surface, const Vector3d& n, double impulse) {
  if (complies(surface)) surfaces_[static_cast<std::size_t>(surface)].impulse += impulse * n;
}

double Surfaces::motion(int surface, const Vector3d& n) const {
  return complies(surface) ? at(surface).response * at(surface).impulse.dot(n) : 0.0;
}

void Surfaces::note_pressed(int surface, const Vector3d& n) {
  if (surface < 0) return;
  double& depth = indented_[at(surface).bodies];
  depth = std::max(depth, h_ * motion(surface, n));
}

}  // namespace spring_workbench::friction
