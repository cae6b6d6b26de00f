#include "contact_factor.h"

#include <algorithm>

namespace spring_workbench::friction {

using Eigen::Index;
using Eigen::Matrix3d;

void ContactFactor::set_pattern(const ReducedContacts& contacts, const std::vector<std::size_t>& indices) {
  indices_ = indices;
  std::vector<Index> sizes;
  for (const auto& body : contacts.bodies()) sizes.push_back(body.size);
  std::vector<Pair> touching;
  for (std::size_t body = 0; body < sizes.size(); ++body) touching.emplace_back(body, body);
  for (const std::size_t i : indices) {
    const auto& c = contacts.contacts()[i];
    for (std::size_t p = c.parts_begin; p < c.parts_end; ++p) {
      for (std::size_t q = c.parts_begin; q < c.parts_end; ++q)
        touching.emplace_back(contacts.parts()[p].body, contacts.parts()[q].body);
    }
  }
  std::sort(touching.begin(), touching.end());
  touching.erase(std::unique(touching.begin(), touching.end()), touching.end());
  if (sizes == sizes_ && touching == touching_) return;
  sizes_ = std::move(sizes);
  touching_ = std::move(touching);
  make_matrix(contacts);
}

void ContactFactor::make_matrix(const ReducedContacts& contacts) {
  above_.clear();
  std::vector<Eigen::Triplet<double, int>> entries;
  Index above = 0;
  for (std::size_t i = 0; i < touching_.size(); ++i) {
    const auto [of_column, of_row] = touching_[i];
    if (i == 0 || touching_[i - 1].first != of_column) above = 0;
    above_[touching_[i]] = above;
    above += sizes_[of_row];
    for (Index c = 0; c < sizes_[of_column]; ++c) {
      for (Index r = 0; r < sizes_[of_row]; ++r) {
        entries.emplace_back(static_cast<int>(contacts.bodies()[of_row].first + r),
                             static_cast<int>(contacts.bodies()[of_column].first + c), 1.0);
      }
    }
  }
  matrix_.resize(contacts.size(), contacts.size());
  matrix_.setFromTriplets(entries.begin(), entries.end());
  cholesky_.analyzePattern(matrix_);
  lu_analysed_ = false;
}

void ContactFactor::assemble(const ReducedContacts& contacts, const std::vector<Matrix3d>& D) {
  std::fill(matrix_.valuePtr(), matrix_.valuePtr() + matrix_.nonZeros(), 0.0);
  const auto column_of = [&](std::size_t of_column, std::size_t of_row, Index c) {
    return matrix_.valuePtr() + matrix_.outerIndexPtr()[contacts.bodies()[of_column].first + c] +
           above_.at({of_column, of_row});
  };
  for (std::size_t body = 0; body < sizes_.size(); ++body) {
    for (Index c = 0; c < sizes_[body]; ++c) column_of(body, body, c)[c] = 1.0;
  }
  for (std::size_t i = 0; i < D.size(); ++i) {
    const auto& contact = contacts.contacts()[indices_[i]];
    if (D[i].isZero(0.0)) continue;
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

bool ContactFactor::factorize(const ReducedContacts& contacts, const std::vector<Matrix3d>& D) {
  assemble(contacts, D);
  cholesky_.factorize(matrix_);
  return cholesky_.info() == Eigen::Success;
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

}  // namespace spring_workbench::friction
