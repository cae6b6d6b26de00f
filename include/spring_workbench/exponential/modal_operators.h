#pragma once

#include <algorithm>
#include <array>

#include "spring_workbench/exponential/cluster_operator.h"
#include "spring_workbench/exponential/collocation.h"

namespace spring_workbench::exponential {

/// Four functions of a linear part, one in each lane, in the coordinates of its modes (ModalRates): a number for a
/// single mode, a 2 × 2 block for a pair, so that x ↦ own x + other x', where x' is x with the members of each pair
/// exchanged, and a matrix for clusters.
template <int modes>
struct ModalOperator {
  using Packs = std::array<math::Pack, static_cast<std::size_t>(modes)>;
  static constexpr std::size_t at(int m) { return static_cast<std::size_t>(m); }

  Packs own{}, other{};  ///< zero for the modes of clusters
  ClusterOperator clusters;

  /// Applies each function to its lane of `x`, or all functions to the same modes.
  template <typename Modes>
  SPRING_WORKBENCH_INLINE Packs applied(const Modes& x) const {
    Packs y;
    for (int m = 0; m < modes; ++m) {
      const auto i = static_cast<decltype(x.size())>(m);
      y[at(m)] = own[at(m)] * x[i] + other[at(m)] * x[i ^ 1];
    }
    if (clusters.size() > 0) add_clusters(x, y);
    return y;
  }
  template <typename Modes>
  SPRING_WORKBENCH_INLINE void add_clusters(const Modes& x, Packs& y) const {
    Packs in_lanes;
    for (int m = 0; m < modes; ++m) in_lanes[at(m)] = x[static_cast<decltype(x.size())>(m)] + math::Pack{};
    const std::size_t first = at(modes - clusters.size());
    clusters.add_applied(&in_lanes[first], &y[first]);
  }

  void set(std::size_t lane, int m, double value) {
    own[at(m)][lane] = value;
    other[at(m)][lane] = 0.0;
  }
  void set(std::size_t lane, int m, const GeneralComplex& value) {
    own[at(m)][lane] = own[at(m + 1)][lane] = value.re;
    other[at(m)][lane] = value.im;
    other[at(m + 1)][lane] = value.square * value.im;
  }
};

/// The functions of a linear part that a step needs (Collocation::Weights), times the step.
/// Lane i belongs to node i of Collocation, or to sample i.
template <int modes>
struct ModalOperators {
  static constexpr std::size_t count = Collocation::count;
  using Operator = ModalOperator<modes>;
  using Packs = typename Operator::Packs;
  using PerNode = std::array<Operator, count>;

  // Effects on the modes:
  Operator constant, sample_constant;  ///< of a constant derivative, at the nodes and at the samples
  PerNode node, sample;                ///< of the residual at each node, at the nodes and at the samples
  PerNode defect;                      ///< of the residual's defect at each sample, at the nodes
  Operator end_defect;                 ///< of the defect at the sample of each lane, at the end of the step

  ModalOperators() {
    std::size_t next = 0;
    each([&](Operator& f) { f.clusters.keep_in(rows_[next++]); });
  }
  ModalOperators(const ModalOperators&) = delete;
  ModalOperators& operator=(const ModalOperators&) = delete;

  /// Computes all for steps of `h` [s], unless they are known already: a restored history usually continues with the
  /// same step.
  void compute(double h, const ModalRates& rates) {
    if (h == h_ && rates == rates_) return;
    h_ = h;
    rates_ = rates;
    for (int m = 0; m < 2 * rates.pairs; m += 2) set(h, m, Collocation::weights(h * rates.of[Operator::at(m)]));
    for (int m = 2 * rates.pairs; m < rates.unclustered(); ++m) {
      set(h, m, Collocation::weights(h * rates.of[Operator::at(m)].re));
    }
    const int first = rates.unclustered();
    each([&](Operator& f) { f.clusters.set_zero(modes - first); });
    for (int m = first; m < modes; ++m) set(h, m, Collocation::Weights<double>{});
    int begin = 0;
    for (const int size : rates.cluster_sizes) {
      if (size > 0) set_cluster(h, begin, cluster_weights(h * rates.clusters.block(begin, begin, size, size)));
      begin += size;
    }
  }

  /// x = from + Σ_j by[j] residual_j, where residual_j is lane j of the residual.
  SPRING_WORKBENCH_INLINE static void drive(const PerNode& by, const Packs& from, const Packs& residual, Packs& x) {
    for (int m = 0; m < modes; ++m) {
      const math::Pack own = residual[Operator::at(m)], other = residual[Operator::at(m ^ 1)];
      math::Pack sum = from[Operator::at(m)];
      for (std::size_t j = 0; j < count; ++j) {
        sum += by[j].own[Operator::at(m)] * own[j] + by[j].other[Operator::at(m)] * other[j];
      }
      x[Operator::at(m)] = sum;
    }
    if (by[0].clusters.size() == 0) return;
    for (std::size_t j = 0; j < count; ++j) {
      std::array<double, static_cast<std::size_t>(modes)> at_node{};
      for (std::size_t i = 0; i < at_node.size(); ++i) at_node[i] = residual[i][j];
      by[j].add_clusters(at_node, x);
    }
  }

 private:
  template <typename Visit>
  void each(const Visit& visit) {
    for (Operator* f : {&constant, &sample_constant, &end_defect}) visit(*f);
    for (PerNode* all : {&node, &sample, &defect}) {
      for (Operator& f : *all) visit(f);
    }
  }
  template <typename Weights>
  void set(double h, int m, const Weights& w) {
    for (std::size_t i = 0; i < count; ++i) {
      constant.set(i, m, h * w.constant[i]);
      sample_constant.set(i, m, h * w.sample_constant[i]);
      for (std::size_t j = 0; j < count; ++j) {
        node[j].set(i, m, h * w.node[i][j]);
        sample[j].set(i, m, h * w.sample[i][j]);
        defect[j].set(i, m, h * w.defect[i][j]);
        if (i + 1 == count) end_defect.set(j, m, h * w.defect[i][j]);
      }
    }
  }

  void set_cluster(double h, int begin, const ClusterWeights& w) {
    constant.clusters.set(begin, h, w.constant);
    sample_constant.clusters.set(begin, h, w.sample_constant);
    for (std::size_t j = 0; j < count; ++j) {
      node[j].clusters.set(begin, h, w.node[j]);
      sample[j].clusters.set(begin, h, w.sample[j]);
      defect[j].clusters.set(begin, h, w.defect[j]);
      end_defect.clusters.set_lane(static_cast<int>(j), begin, h, w.defect[j], math::pack_size - 1);
    }
  }

  double h_ = 0.0;
  ModalRates rates_;
  std::array<ClusterOperator::Rows, 3 * count + 3> rows_;  ///< apart from what every step reads
};

}  // namespace spring_workbench::exponential
