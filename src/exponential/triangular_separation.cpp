#include "triangular_separation.h"

#include <Eigen/LU>

#include "constants.h"

namespace spring_workbench::exponential {
namespace {

using Matrix = ModalRates::Matrix;
using Element = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 2, 2>;

/// Solves A Y − Y C = R. Not finite, or large, if an eigenvalue of A is one of C.
Element sylvester(const Element& A, const Element& C, const Element& R) {
  const Eigen::Index p = A.rows(), q = C.rows();
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4> equations(p * q, p * q);
  equations.setZero();
  for (Eigen::Index j = 0; j < q; ++j) {
    equations.block(j * p, j * p, p, p) += A;
    for (Eigen::Index l = 0; l < q; ++l) equations.block(j * p, l * p, p, p).diagonal().array() -= C(l, j);
  }
  using Unknowns = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 4, 1>;
  const Unknowns y = equations.partialPivLu().solve(Eigen::Map<const Unknowns>(R.data(), p * q));
  return Eigen::Map<const Element>(y.data(), p, q);
}

/// A quasi-triangular matrix T by its elements: those on the diagonal have one real rate or two conjugate ones.
class Elements {
 public:
  explicit Elements(const Matrix& T) : T_(T) {
    for (int i = 0; i < T.rows(); i += size(count_ - 1)) {
      begin_[at(count_)] = i;
      size_[at(count_++)] = i + 1 < T.rows() && T(i + 1, i) != 0.0 ? 2 : 1;
      cluster_[at(count_ - 1)] = i;
    }
  }

  /// Computes Y and B. Returns false if two clusters had to be merged.
  bool solve(Matrix& Y, Matrix& B) {
    const double negligible = negligible_coupling * T_.norm();
    Y.setIdentity(T_.rows(), T_.rows());
    B.setZero(T_.rows(), T_.rows());
    for (int j = 0; j < count_; ++j) {
      of(B, j, j) = of(T_, j, j);
      for (int i = j - 1; i >= 0; --i) {
        Element left = of(T_, i, j);
        for (int k = i + 1; k < j; ++k) left += of(T_, i, k) * of(Y, k, j) - of(Y, i, k) * of(B, k, j);
        if (cluster_[at(i)] == cluster_[at(j)]) {
          of(B, i, j) = left;
        } else if (!(left.norm() <= negligible)) {
          of(Y, i, j) = sylvester(of(T_, i, i), of(T_, j, j), -left);
          if (!(of(Y, i, j).norm() <= largest_element)) return merge(i, j);
        }
      }
    }
    return true;
  }
  /// The cluster of each column.
  std::array<int, ModalRates::max_modes> clusters() const {
    std::array<int, ModalRates::max_modes> all{};
    for (int i = 0; i < count_; ++i) {
      for (int k = 0; k < size(i); ++k) all[at(begin_[at(i)] + k)] = cluster_[at(i)];
    }
    return all;
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  int size(int i) const { return size_[at(i)]; }
  template <typename Any>
  Eigen::Block<Any> of(Any& M, int i, int j) const {
    return M.block(begin_[at(i)], begin_[at(j)], size(i), size(j));
  }
  bool merge(int i, int j) {
    const int to = cluster_[at(i)], from = cluster_[at(j)];
    for (int& cluster : cluster_) cluster = cluster == from ? to : cluster;
    return false;
  }

  const Matrix& T_;
  int count_ = 0;
  std::array<int, ModalRates::max_modes> begin_{}, size_{}, cluster_{};  ///< of the elements on the diagonal
};

}  // namespace

TriangularSeparation::TriangularSeparation(const Matrix& T) {
  Elements elements(T);
  while (!elements.solve(Y, B)) {
  }
  cluster = elements.clusters();
}

}  // namespace spring_workbench::exponential
