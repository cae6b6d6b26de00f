#include "benchmark/dense_strain.h"

#include <limits>

namespace spring_workbench::benchmark {

DenseStrain::DenseStrain() { t_.fill(-std::numeric_limits<double>::infinity()); }

void DenseStrain::push(double t, const dynamics::StrainState& state) {
  size_ = static_cast<std::size_t>(state.q.size());
  double per_time[ends];
  for (std::size_t i = 0; i < ends; ++i) per_time[i] = 1.0 / (t - t_[2 * i]);
  for (std::size_t p = 0; p * math::pack_size < size_; ++p) {
    math::Pack q{}, q_dot{};
    for (std::size_t i = 0; i < math::pack_size && p * math::pack_size + i < size_; ++i) {
      const auto c = static_cast<Eigen::Index>(p * math::pack_size + i);
      q[i] = state.q[c];
      q_dot[i] = state.q_dot[c];
    }
    const auto d = [this, p](std::size_t i) -> math::Pack& { return divided_differences_[i][p]; };
    // The end comes twice, each time before all others.
    math::Pack last_of_before = d(0);
    d(0) = q;
    for (std::size_t i = 1; i < terms; ++i) {
      const math::Pack of_before = d(i);
      d(i) = (d(i - 1) - last_of_before) * per_time[(i - 1) / 2];
      last_of_before = of_before;
    }
    last_of_before = d(0);
    for (std::size_t i = 1; i < terms; ++i) {
      const math::Pack of_before = d(i);
      d(i) = i == 1 ? q_dot : (d(i - 1) - last_of_before) * per_time[(i - 2) / 2];
      last_of_before = of_before;
    }
  }
  std::copy_backward(t_.begin(), t_.end() - 2, t_.end());
  t_[0] = t_[1] = t;
  ++count_;
}

double DenseStrain::known_until() const {
  return count_ < ends ? -std::numeric_limits<double>::infinity() : t_[terms / 2 - 2];
}

SPRING_WORKBENCH_WIDE void DenseStrain::at(const math::Pack& t, math::Pack* q) const {
  for (std::size_t c = 0; c < size_; ++c) {
    const auto coefficient = [this, c](std::size_t i) {
      return divided_differences_[i][c / math::pack_size][static_cast<int>(c % math::pack_size)];
    };
    math::Pack sum = math::Pack{} + coefficient(terms - 1);
    for (std::size_t i = terms - 1; i-- > 0;) sum = (t - t_[i]) * sum + coefficient(i);
    q[c] = sum;
  }
}

}  // namespace spring_workbench::benchmark
