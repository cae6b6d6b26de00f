#include "benchmark/dense_output.h"

#include <algorithm>

namespace spring_workbench::benchmark {
namespace {

Pack pack(const Vector3d& v) { return Pack{v[0], v[1], v[2], 0.0}; }

}  // namespace

void DenseOutput::push(const Moment& end) {
  if (count_ >= ends) std::rotate(ends_.begin(), ends_.begin() + 1, ends_.end());
  ends_[std::min(count_, ends - 1)] = end;
  ++count_;
  if (known()) fit();
}

void DenseOutput::fit() {
  // Divided differences on the ends, each three times: of equal moments they are derivatives.
  double per_time[ends][ends]{};
  for (std::size_t a = 0; a < ends; ++a) {
    for (std::size_t b = 0; b < a; ++b) per_time[a][b] = 1.0 / (ends_[a].t - ends_[b].t);
  }
  std::array<Pack, terms>& d = divided_differences_;
  for (std::size_t i = 0; i < terms; ++i) d[i] = pack(ends_[i / 3].value);
  for (std::size_t order = 1; order < terms; ++order) {
    for (std::size_t i = terms; i-- > order;) {
      const std::size_t a = i / 3, b = (i - order) / 3;
      if (a != b) {
        d[i] = (d[i] - d[i - 1]) * per_time[a][b];
      } else {
        d[i] = order == 1 ? pack(ends_[a].rate) : 0.5 * pack(ends_[a].acceleration);
      }
    }
  }
}

Vector3d DenseOutput::at(double t) const {
  Pack sum = divided_differences_[terms - 1];
  for (std::size_t i = terms - 1; i-- > 0;) sum = sum * (t - ends_[i / 3].t) + divided_differences_[i];
  return {sum[0], sum[1], sum[2]};
}

}  // namespace spring_workbench::benchmark
