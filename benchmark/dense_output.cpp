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

SPRING_WORKBENCH_WIDE Three<Pack> DenseOutput::at(const Pack& t) const {
  const auto coefficients = [this](std::size_t i) {
    const Pack& d = divided_differences_[i];
    return Three<double>{d[0], d[1], d[2]};
  };
  Three<Pack> sum = none<Pack>() + coefficients(terms - 1);
  for (std::size_t i = terms - 1; i-- > 0;) sum = (t - t_[i]) * sum + coefficients(i);
  return sum;
}

void DenseOutput::append(const std::vector<double>& times, std::vector<Vector3d>& outputs) const {
  if (count_ < ends) return;
  const double end = t_[3] + 1e-9;
  while (outputs.size() < times.size() && times[outputs.size()] < end) {
    Pack t{};
    int count = 0;
    for (; count < pack_size && outputs.size() + count < times.size() && times[outputs.size() + count] < end; ++count) {
      t[count] = times[outputs.size() + count];
    }
    const Three<Pack> values = at(t);
    for (int i = 0; i < count; ++i) outputs.push_back(vector(values, i));
  }
}

}  // namespace spring_workbench::benchmark
