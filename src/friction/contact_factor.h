#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <map>
#include <utility>
#include <vector>

#include "reduced_contacts.h"

namespace spring_workbench::friction {

/// Factor of 1 + Jᵀ D J, by reduced coordinates: J of all contacts, D a 3 × 3 matrix of each. Sparse like the graph of
/// the bodies that touch; what depends on that graph alone, as the order of elimination (by minimum degree), is kept
/// while the graph is the same.
class ContactFactor {
 public:
  /// Takes the graph of the contacts of these indices.
  void set_pattern(const ReducedContacts& contacts, const std::vector<std::size_t>& indices);
  /// Factors by Cholesky, for symmetric and positive D. Returns false if there is no factor.
  bool factorize(const ReducedContacts& contacts, const std::vector<Eigen::Matrix3d>& D);
  Eigen::VectorXd solve(const Eigen::VectorXd& right_side) const { return cholesky_.solve(right_side); }
  /// The same for any D.
  bool factorize_nonsymmetric(const ReducedContacts& contacts, const std::vector<Eigen::Matrix3d>& D);
  Eigen::VectorXd solve_nonsymmetric(const Eigen::VectorXd& right_side) const { return lu_.solve(right_side); }

 private:
  using Pair = std::pair<std::size_t, std::size_t>;
  void make_matrix(const ReducedContacts& contacts);
  void assemble(const ReducedContacts& contacts, const std::vector<Eigen::Matrix3d>& D);

  std::vector<std::size_t> indices_;    ///< of the contacts
  std::vector<Eigen::Index> sizes_;     ///< of the bodies
  std::vector<Pair> touching_;          ///< pairs of bodies, in both orders and each with itself, sorted
  std::map<Pair, Eigen::Index> above_;  ///< entries above the block of the second body in the columns of the first
  bool lu_analysed_ = false;
  Eigen::SparseMatrix<double> matrix_;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::AMDOrdering<int>> cholesky_;
  Eigen::SparseLU<Eigen::SparseMatrix<double>, Eigen::AMDOrdering<int>> lu_;
};

}  // namespace spring_workbench::friction
