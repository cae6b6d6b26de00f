#include "benchmark/dense_output.h"

#include <algorithm>
#include <limits>

namespace spring_workbench::benchmark {
namespace {

Pack pack(const Vector3d& v) { return Pack{v[0], v[1], v[2], 0.0}; }

}  // namespace

DenseOutput::DenseOutput() { t_.fill(-std::numeric_limits<double>::infinity()); }

void DenseOutput::push(const Moment& end) {
  double per_time[ends];
  for (std::size_t i = 0; i < ends; ++i) per_time[i] = 1.0 / (end.t - t_[3 * i]);
  const Pack of_equal_times[] = {pack(end.value), pack(end.rate), 0.5 * pack(end.acceleration)};
  std::array<Pack, terms>& d = divided_differences_;
  for (std::size_t again = 0; again < 3; ++again) {
    Pack last_of_before = d[0];
    d[0] = of_equal_times[0];
    for (std::size_t i = 1; i < terms; ++i) {
      const Pack of_before = d[i];
      d[i] = i <= again ? of_equal_times[i] : (d[i - 1] - last_of_before) * per_time[(i - 1 - again) / 3];
      last_of_before = of_before;
    }
  }
  std::copy_backward(t_.begin(), t_.end() - 3, t_.end());
  std::fill_n(t_.begin(), 3, end.t);
  ++count_;
}

Vector3d DenseOutput::at(double t) const {
  Pack sum = divided_differences_[terms - 1];
  for (std::size_t i = terms - 1; i-- > 0;) sum = sum * (t - t_[i]) + divided_differences_[i];
  return {sum[0], sum[1], sum[2]};
}

}  // namespace spring_workbench::benchmark
