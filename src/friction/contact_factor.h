#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <map>
#include <utility>
#include <vector>

#include "reduced_contacts.h"

namespace spring_workbench::friction {

/// Factor of 1 + Jᵀ D J, by reduced coordinates: J of all contacts, D a 3 × 3 matrix of each. Sparse like the graph of
/// the bodies that touch; what depends on that graph alone is kept while the graph is the same.
class ContactFactor {
 public:
  /// Takes the graph of the contacts and orders the elimination by minimum degree.
  void set_pattern(const ReducedContacts& contacts);
  /// Factors by Cholesky, for symmetric and positive D. Returns false if there is no factor.
  bool factorize(const ReducedContacts& contacts, const std::vector<Eigen::Matrix3d>& D);
  Eigen::VectorXd solve(const Eigen::VectorXd& right_side) const;
  /// The same for any D.
  bool factorize_nonsymmetric(const ReducedContacts& contacts, const std::vector<Eigen::Matrix3d>& D);
  Eigen::VectorXd solve_nonsymmetric(const Eigen::VectorXd& right_side) const;

 private:
  using Pair = std::pair<std::size_t, std::size_t>;
  void order();
  void assemble(const ReducedContacts& contacts, const std::vector<Eigen::Matrix3d>& D);
  Eigen::VectorXd eliminated(const Eigen::VectorXd& v) const;  ///< in the order of elimination
  Eigen::VectorXd reduced(const Eigen::VectorXd& v) const;     ///< and back

  std::vector<Eigen::Index> sizes_;     ///< of the bodies
  std::vector<Pair> touching_;          ///< pairs of bodies, sorted
  std::vector<Eigen::Index> first_;     ///< row of each body, in the order of elimination
  std::map<Pair, Eigen::Index> above_;  ///< entries above the block of the second body in the columns of the first
  Eigen::VectorXi permutation_;         ///< from reduced coordinates to the order of elimination
  bool lu_analysed_ = false;
  Eigen::SparseMatrix<double> matrix_;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>> cholesky_;
  Eigen::SparseLU<Eigen::SparseMatrix<double>, Eigen::NaturalOrdering<int>> lu_;
};

}  // namespace spring_workbench::friction
