#include "spring_workbench/exponential/real_modes.h"

#include <Eigen/LU>

#include "separation.h"
#include "spring_workbench/exponential/oscillator_modes.h"

namespace spring_workbench::exponential {
namespace {

using Matrix = RealModes::Matrix;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// One invariant subspace of a separation.
struct Subspace {
  std::array<int, ModalRates::max_modes> columns{};
  int size = 0;
  Matrix block;  ///< A in these columns

  Subspace(const Separation& parts, int cluster) {
    for (int i = 0; i < parts.columns.cols(); ++i) {
      if (parts.cluster[at(i)] == cluster) columns[at(size++)] = i;
    }
    block.resize(size, size);
    for (int a = 0; a < size; ++a) {
      for (int b = 0; b < size; ++b) block(a, b) = parts.blocks(columns[at(a)], columns[at(b)]);
    }
  }
};

/// Takes subspaces as the next modes.
class Modes {
 public:
  Modes(const Separation& parts, RealModes& modes) : parts_(parts), modes_(modes) {}

  void add_single(const Subspace& space) {
    ++modes_.rates.singles;
    modes_.rates.of[at(next_)] = space.block(0, 0);
    take(space, Matrix::Identity(1, 1), Matrix::Identity(1, 1));
  }
  void add_oscillator(const Subspace& space, const OscillatorModes& own) {
    (own.pair ? modes_.rates.pairs : modes_.rates.singles) += own.pair ? 1 : 2;
    for (int i = 0; i < 2; ++i) modes_.rates.of[at(next_ + i)] = own.rates[i];
    take(space, own.vectors, own.vectors.inverse());
  }
  void add_cluster(const Subspace& space) {
    ModalRates& rates = modes_.rates;
    const auto before = static_cast<int>(rates.clusters.rows()), all = before + space.size;
    Matrix clusters = Matrix::Zero(all, all);
    clusters.topLeftCorner(before, before) = rates.clusters;
    clusters.bottomRightCorner(space.size, space.size) = space.block;
    rates.clusters = clusters;
    rates.cluster_sizes[at(clusters_++)] = space.size;
    for (int i = 0; i < space.size; ++i) rates.of[at(next_ + i)] = eigenvalue(space.block, i);
    take(space, Matrix::Identity(space.size, space.size), Matrix::Identity(space.size, space.size));
  }

 private:
  /// Of the quasi-triangular block, the one that belongs to its row `i`.
  static GeneralComplex eigenvalue(const Matrix& block, int i) {
    const bool first = i + 1 < block.rows() && block(i + 1, i) != 0.0, second = i > 0 && block(i, i - 1) != 0.0;
    if (!first && !second) return block(i, i);
    return OscillatorModes(block.block<2, 2>(first ? i : i - 1, first ? i : i - 1)).rates[0];
  }
  /// The columns of the subspace times `from_modes`, and the rows of the inverse.
  void take(const Subspace& space, const Matrix& from_modes, const Matrix& to_modes) {
    for (int k = 0; k < space.size; ++k, ++next_) {
      for (int i = 0; i < space.size; ++i) {
        modes_.vectors.col(next_) += from_modes(i, k) * parts_.columns.col(space.columns[at(i)]);
        modes_.inverse.row(next_) += to_modes(k, i) * parts_.inverse.row(space.columns[at(i)]);
      }
    }
  }

  const Separation& parts_;
  RealModes& modes_;
  int next_ = 0, clusters_ = 0;
};

}  // namespace

RealModes::RealModes(const Matrix& A) : vectors(Matrix::Zero(A.rows(), A.rows())), inverse(vectors) {
  const Separation parts = separated(A);
  Modes modes(parts, *this);
  enum { pairs, singles, clusters };
  for (const int kind : {pairs, singles, clusters}) {
    for (int cluster = 0; cluster < A.rows(); ++cluster) {
      const Subspace space(parts, cluster);
      if (space.size > 2) {
        if (kind == clusters) modes.add_cluster(space);
      } else if (space.size == 2) {
        const OscillatorModes own(space.block);
        if (kind == (own.pair ? pairs : singles)) modes.add_oscillator(space, own);
      } else if (space.size == 1) {
        if (kind == singles) modes.add_single(space);
      }
    }
  }
}

RealModes::Matrix RealModes::blocks() const {
  Matrix B = Matrix::Zero(vectors.rows(), vectors.rows());
  for (int i = 0; i < rates.unclustered(); ++i) B(i, i) = rates.of[at(i)].re;
  for (int i = 0; i < 2 * rates.pairs; i += 2) {
    B(i, i + 1) = rates.of[at(i)].im;
    B(i + 1, i) = rates.of[at(i)].square * rates.of[at(i)].im;
  }
  B.bottomRightCorner(rates.clusters.rows(), rates.clusters.rows()) = rates.clusters;
  return B;
}

}  // namespace spring_workbench::exponential
