#include "contact_factor.h"

#include <Eigen/OrderingMethods>
#include <algorithm>

namespace spring_workbench::friction {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::VectorXd;

void ContactFactor::set_pattern(const ReducedContacts& contacts) {
  std::vector<Index> sizes;
  for (const auto& body : contacts.bodies()) sizes.push_back(body.size);
  std::vector<Pair> touching;
  for (const auto& c : contacts.contacts()) {
    for (std::size_t p = c.parts_begin; p < c.parts_end; ++p) {
      for (std::size_t q = c.parts_begin; q < p; ++q)
        touching.push_back(std::minmax(contacts.parts()[p].body, contacts.parts()[q].body));
    }
  }
  std::sort(touching.begin(), touching.end());
  touching.erase(std::unique(touching.begin(), touching.end()), touching.end());
  touching.erase(std::remove_if(touching.begin(), touching.end(), [](const Pair& t) { return t.first == t.second; }),
                 touching.end());
  if (sizes == sizes_ && touching == touching_) return;
  sizes_ = std::move(sizes);
  touching_ = std::move(touching);
  order();
}

void ContactFactor::order() {
  const auto count = static_cast<int>(sizes_.size());
  std::vector<Eigen::Triplet<double, int>> edges;
  for (int i = 0; i < count; ++i) edges.emplace_back(i, i, 1.0);
  for (const auto& [a, b] : touching_) edges.emplace_back(static_cast<int>(b), static_cast<int>(a), 1.0);
  Eigen::SparseMatrix<double> graph(count, count);
  graph.setFromTriplets(edges.begin(), edges.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> eliminated;  // place to body
  if (count > 0) Eigen::AMDOrdering<int>()(graph.selfadjointView<Eigen::Lower>(), eliminated);
  std::vector<std::size_t> place(sizes_.size());
  first_.assign(sizes_.size(), 0);
  Index size = 0;
  for (int i = 0; i < count; ++i) {
    const auto body = static_cast<std::size_t>(eliminated.indices()[i]);
    place[body] = static_cast<std::size_t>(i);
    first_[body] = size;
    size += sizes_[body];
  }
  permutation_.resize(size);
  Index from = 0;
  for (std::size_t body = 0; body < sizes_.size(); ++body) {
    for (Index k = 0; k < sizes_[body]; ++k) permutation_[from++] = static_cast<int>(first_[body] + k);
  }
  std::vector<std::vector<std::size_t>> column(sizes_.size());  // by place: the places of the blocks in its columns
  for (std::size_t i = 0; i < sizes_.size(); ++i) column[i].push_back(i);
  for (const auto& [a, b] : touching_) {
    column[place[a]].push_back(place[b]);
    column[place[b]].push_back(place[a]);
  }
  above_.clear();
  std::vector<Eigen::Triplet<double, int>> entries;
  for (std::size_t i = 0; i < column.size(); ++i) {
    std::sort(column[i].begin(), column[i].end());
    const auto of_column = static_cast<std::size_t>(eliminated.indices()[static_cast<Index>(i)]);
    Index above = 0;
    for (const std::size_t j : column[i]) {
      const auto of_row = static_cast<std::size_t>(eliminated.indices()[static_cast<Index>(j)]);
      above_[{of_column, of_row}] = above;
      above += sizes_[of_row];
      for (Index c = 0; c < sizes_[of_column]; ++c) {
        for (Index r = 0; r < sizes_[of_row]; ++r) {
          entries.emplace_back(static_cast<int>(first_[of_row] + r), static_cast<int>(first_[of_column] + c), 1.0);
        }
      }
    }
  }
  matrix_.resize(size, size);
  matrix_.setFromTriplets(entries.begin(), entries.end());
  cholesky_.analyzePattern(matrix_);
  lu_analysed_ = false;
}

void ContactFactor::assemble(const ReducedContacts& contacts, const std::vector<Matrix3d>& D) {
  std::fill(matrix_.valuePtr(), matrix_.valuePtr() + matrix_.nonZeros(), 0.0);
  const auto column_of = [&](std::size_t of_column, std::size_t of_row, Index c) {
    return matrix_.valuePtr() + matrix_.outerIndexPtr()[first_[of_column] + c] + above_.at({of_column, of_row});
  };
  for (std::size_t body = 0; body < sizes_.size(); ++body) {
    for (Index c = 0; c < sizes_[body]; ++c) column_of(body, body, c)[c] = 1.0;
  }
  for (std::size_t i = 0; i < D.size(); ++i) {
    const auto& contact = contacts.contacts()[i];
    if (!(contact.scale > 0.0) || D[i].isZero(0.0)) continue;
    for (std::size_t q = contact.parts_begin; q < contact.parts_end; ++q) {
      const auto& of_column = contacts.parts()[q];
      const Eigen::Matrix3Xd DJ = D[i] * contacts.jacobian(of_column);
      for (std::size_t p = contact.parts_begin; p < contact.parts_end; ++p) {
        const auto& of_row = contacts.parts()[p];
        const auto J = contacts.jacobian(of_row);
        for (Index c = 0; c < of_column.size; ++c) {
          double* const column = column_of(of_column.body, of_row.body, c);
          for (Index r = 0; r < of_row.size; ++r) column[r] += J.col(r).dot(DJ.col(c));
        }
      }
    }
  }
}

VectorXd ContactFactor::eliminated(const VectorXd& v) const {
  VectorXd result(v.size());
  for (Index i = 0; i < v.size(); ++i) result[permutation_[i]] = v[i];
  return result;
}

VectorXd ContactFactor::reduced(const VectorXd& v) const {
  VectorXd result(v.size());
  for (Index i = 0; i < v.size(); ++i) result[i] = v[permutation_[i]];
  return result;
}

bool ContactFactor::factorize(const ReducedContacts& contacts, const std::vector<Matrix3d>& D) {
  assemble(contacts, D);
  cholesky_.factorize(matrix_);
  return cholesky_.info() == Eigen::Success;
}

VectorXd ContactFactor::solve(const VectorXd& right_side) const {
  return reduced(cholesky_.solve(eliminated(right_side)));
}

bool ContactFactor::factorize_nonsymmetric(const ReducedContacts& contacts, const std::vector<Matrix3d>& D) {
  assemble(contacts, D);
  if (!lu_analysed_) {
    lu_.isSymmetric(true);
    lu_.analyzePattern(matrix_);
  }
  lu_analysed_ = true;
  lu_.factorize(matrix_);
  return lu_.info() == Eigen::Success;
}

VectorXd ContactFactor::solve_nonsymmetric(const VectorXd& right_side) const {
  return reduced(lu_.solve(eliminated(right_side)));
}

}  // namespace spring_workbench::friction
