#include "spring_workbench/fork_mesh/fork_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "random_strain.h"
#include "spring_workbench/validation/input_error.h"
#include "support/named.h"

namespace spring_workbench::fork_mesh::fork_model_test {
namespace {

constexpr double L = 0.2, diameter = 0.03;

ForkModel::Triangles all_triangles(const ForkModel& model) {
  ForkModel::Triangles all = model.spring();
  all.insert(all.end(), model.shaft_and_end().begin(), model.shaft_and_end().end());
  return all;
}

const Vector3d& corner(const ForkMesh& mesh, const Eigen::Vector3i& t, int k) {
  return mesh.vertices[static_cast<std::size_t>(t[k])];
}

Vector3d area_vector(const ForkMesh& mesh, const Eigen::Vector3i& t) {
  return 0.5 * (corner(mesh, t, 1) - corner(mesh, t, 0)).cross(corner(mesh, t, 2) - corner(mesh, t, 0));
}

double volume(const ForkMesh& mesh, const ForkModel::Triangles& triangles) {
  double sum = 0.0;
  for (const Eigen::Vector3i& t : triangles) sum += corner(mesh, t, 0).dot(area_vector(mesh, t)) / 3.0;
  return sum;
}

class DeformedFork : public testing::Test {
 protected:
  /// A finely meshed fork, deformed randomly.
  void deform() {
    q_ = random_strain(*shape_, 0.5, random_);
    X_WH_ = random_.pose(1.0);
    model_.deform(rod_curve(*shape_, q_, X_WH_), diameter, mesh_);
  }

  static ForkAppearance fine() {
    ForkAppearance look;
    look.points_per_turn = 48;
    look.wire_sides = 16;
    return look;
  }

  /// Of the coil, and of the seam after it.
  static constexpr std::size_t coil_rings = 10 * 48 + 3, seam_rings = 40 + 3;

  test_support::Random random_{12};
  const std::shared_ptr<const rod::ShapeModel> shape_ = rod::make_shape_model(rod::ShapeKind::linear, L);
  const ForkModel model_{fine()};
  rod::StrainVector q_;
  RigidTransform X_WH_;
  ForkMesh mesh_;
};

TEST_F(DeformedFork, IsClosedAndNormalsAreUnitAndRight) {
  for (int run = 0; run < 20; ++run) {
    deform();
    ASSERT_EQ(mesh_.vertices.size(), model_.vertex_count());
    ASSERT_EQ(mesh_.normals.size(), model_.vertex_count());
    for (const Vector3d& n : mesh_.normals) EXPECT_NEAR(n.norm(), 1.0, 1e-12);
    Vector3d sum = Vector3d::Zero();
    for (const Eigen::Vector3i& t : all_triangles(model_)) {
      const Vector3d area = area_vector(mesh_, t);
      sum += area;
      ASSERT_GT(area.norm(), 0.0);
      Vector3d normal = Vector3d::Zero();
      for (int k = 0; k < 3; ++k) normal += mesh_.normals[static_cast<std::size_t>(t[k])] / 3.0;
      EXPECT_GT(normal.dot(area.normalized()), 0.93);  // flat facets of a round surface
    }
    EXPECT_LT(sum.norm(), 1e-12);
    EXPECT_GT(volume(mesh_, model_.spring()), 0.0);
    EXPECT_GT(volume(mesh_, model_.shaft_and_end()), 0.0);
  }
}

TEST_F(DeformedFork, NormalsStandOnTheWire) {
  // Along the wire, a line of the surface: the normal has nothing along it but what a facet leaves.
  for (int run = 0; run < 20; ++run) {
    deform();
    for (const Eigen::Vector3i& t : model_.spring()) {
      const Vector3d along = corner(mesh_, t, 2) - corner(mesh_, t, 1);  // first triangle of a quad: b − a
      const std::size_t a = static_cast<std::size_t>(t[1]), b = static_cast<std::size_t>(t[2]);
      if (std::abs(t[2] - t[1]) != fine().wire_sides) continue;
      EXPECT_LT(std::abs((mesh_.normals[a] + mesh_.normals[b]).dot(along)), 5e-3 * 2.0 * along.norm());
    }
  }
}

TEST_F(DeformedFork, WireKeepsItsThicknessAndShaftAndEndTheirShape) {
  ForkMesh rest;
  model_.deform(rod_curve(*shape_, rod::StrainVector::Zero(6), RigidTransform::Identity()), diameter, rest);
  const auto sides = static_cast<std::size_t>(fine().wire_sides);
  const std::size_t first = model_.vertex_count() - sides * (coil_rings + seam_rings);
  const RigidTransform X_E_rest = shape_->section(rod::StrainVector::Zero(6), L);
  for (int run = 0; run < 20; ++run) {
    deform();
    for (std::size_t i = first; i < mesh_.vertices.size(); i += sides) {
      Vector3d centre = Vector3d::Zero();
      for (std::size_t k = 0; k < sides; ++k) centre += mesh_.vertices[i + k] / static_cast<double>(sides);
      for (std::size_t k = 0; k < sides; ++k) {
        EXPECT_NEAR((mesh_.vertices[i + k] - centre).norm(), fine().wire_radius * diameter, 1e-12);
      }
    }
    const RigidTransform X_E = X_WH_ * shape_->section(q_, L) * X_E_rest.inverse();
    for (std::size_t i = 0; i < first; ++i) {
      const RigidTransform& X = rest.vertices[i].z() > 0.5 * L ? X_E : X_WH_;
      EXPECT_LT((mesh_.vertices[i] - X * rest.vertices[i]).norm(), 1e-12);
      EXPECT_LT((mesh_.normals[i] - X.linear() * rest.normals[i]).norm(), 1e-12);
    }
  }
}

TEST_F(DeformedFork, MiddleProngPointsWhereTheSimulatedTipPoints) {
  for (int run = 0; run < 20; ++run) {
    deform();
    rod::TipKinematics tip;
    shape_->tip(q_, rod::StrainVector::Zero(6), tip);
    const RigidTransform X_WE = X_WH_ * make_transform(tip.p_HE, Quaterniond(tip.R_HE));
    const Vector3d point = X_WE * Vector3d(0.0, 0.0, fine().prong_length * diameter);
    double nearest = 1.0;
    for (const Vector3d& p : mesh_.vertices) nearest = std::min(nearest, (p - point).norm());
    EXPECT_LT(nearest, 1e-9);
  }
}

/// At its beginning on the handle's x axis, at its end on the tip's.
TEST_F(DeformedFork, TheSeamShowsTheTwist) {
  const auto sides = static_cast<std::size_t>(fine().wire_sides);
  const std::size_t first = model_.vertex_count() - sides * seam_rings;
  for (int run = 0; run < 20; ++run) {
    deform();
    const RigidTransform X_E = X_WH_ * shape_->section(q_, L);
    for (const auto& [ring, X] : {std::pair{first, X_WH_}, std::pair{mesh_.vertices.size() - sides, X_E}}) {
      Vector3d centre = Vector3d::Zero();
      for (std::size_t k = 0; k < sides; ++k) centre += mesh_.vertices[ring + k] / static_cast<double>(sides);
      EXPECT_LT((centre - X * Vector3d(0.5 * diameter, 0.0, 0.0)).norm(), 1e-9);
    }
  }
}

TEST_F(DeformedFork, TorsionTurnsEachPlaceByItsShare) {
  const auto twisted_by = [&](double twist) {
    rod::StrainVector q = rod::StrainVector::Zero(6);
    q[shape_->torsion().begin] = twist / L;
    ForkMesh mesh;
    model_.deform(rod_curve(*shape_, q, RigidTransform::Identity()), diameter, mesh);
    return mesh;
  };
  constexpr double twist = 1.3;
  const ForkMesh straight = twisted_by(0.0), twisted = twisted_by(twist);
  const auto sides = static_cast<std::size_t>(fine().wire_sides);
  const std::size_t first = model_.vertex_count() - sides * (coil_rings + seam_rings);
  for (std::size_t i = first; i < straight.vertices.size(); i += sides) {
    const auto centre = [&](const ForkMesh& mesh) {
      Vector3d sum = Vector3d::Zero();
      for (std::size_t k = 0; k < sides; ++k) sum += mesh.vertices[i + k] / static_cast<double>(sides);
      return sum;
    };
    const Vector3d from = centre(straight), to = centre(twisted);
    EXPECT_LT((Eigen::AngleAxisd(twist * from.z() / L, Vector3d::UnitZ()) * from - to).norm(), 1e-9);
  }
}

TEST_F(DeformedFork, TheCoilIsAsWideAsItsDiameterAndAFifthOfItThickAreTheDiscs) {
  ForkMesh straight;
  model_.deform(rod_curve(*shape_, rod::StrainVector::Zero(6), RigidTransform::Identity()), diameter, straight);
  double widest = 0.0, disc_ends = L;
  for (const Vector3d& p : straight.vertices) {
    const double radius = p.head<2>().norm();
    widest = std::max(widest, radius);
    if (std::abs(radius - (0.5 + fine().wire_radius) * diameter) < 1e-12) disc_ends = std::max(disc_ends, p.z());
  }
  EXPECT_NEAR(widest, (0.5 + fine().wire_radius) * diameter, 1e-12);
  EXPECT_NEAR(disc_ends, L + 0.2 * diameter, 1e-12);
}

/// Closed surfaces with correct dimensions: the probe's needle ends at the tip; beam and cursor have the thickness of
/// rigid tools.
TEST(ForkModel, EachToolHasItsOwnAppearance) {
  const auto shape = rod::make_shape_model(rod::ShapeKind::linear, L);
  const rod::StrainVector q = rod::StrainVector::Zero(shape->size());
  const ForkCurve curve = rod_curve(*shape, q, RigidTransform::Identity());
  std::map<std::string, Eigen::AlignedBox3d> boxes;
  for (const std::string tool : {"spring_fork", "spring", "spring_probe", "direct", "ray"}) {
    const ForkModel model(appearance_of(tool));
    ForkMesh mesh;
    model.deform(curve, drawn_diameter(tool, L), mesh);
    ASSERT_EQ(mesh.vertices.size(), model.vertex_count());
    Vector3d sum = Vector3d::Zero();
    for (const Eigen::Vector3i& t : all_triangles(model)) sum += area_vector(mesh, t);
    EXPECT_LT(sum.norm(), 1e-12) << tool;
    EXPECT_GT(volume(mesh, all_triangles(model)), 0.0) << tool;
    for (const Vector3d& v : mesh.vertices) boxes[tool].extend(v);
    for (const auto& [other, box] : boxes) {
      if (other == tool) continue;
      EXPECT_GT((box.max() - boxes[tool].max()).norm() + (box.min() - boxes[tool].min()).norm(), 1e-3) << other;
    }
  }
  EXPECT_NEAR(boxes["spring_probe"].max().z(), L, 1e-12);
  EXPECT_NEAR(boxes["direct"].min().z(), L - 0.9 * 0.03, 1e-9);
  EXPECT_NEAR(boxes["direct"].max().x(), 0.45 * 0.03, 1e-9);
  EXPECT_NEAR(boxes["ray"].max().z(), L + 0.45 * 0.03, 1e-9);
  EXPECT_NEAR(drawn_diameter("spring_fork", L), 0.16 * L, 1e-15);
  EXPECT_NEAR(drawn_diameter("spring_fork", L, 0.3), 0.3 * L, 1e-15);
  EXPECT_EQ(drawn_diameter("ray", L, 0.3), drawn_diameter("ray", 10.0 * L));
  EXPECT_THROW(appearance_of("hammer"), validation::InputError);
}

/// The needle is as long as its diameter says and ends at the tip, so of the spring there is what is left behind it,
/// however far it is compressed.
TEST(ForkModel, TheProbesSpringEndsWhereItsNeedleBegins) {
  const auto shape = rod::make_shape_model(rod::ShapeKind::linear, L);
  const ForkModel model(appearance_of("spring_probe"));
  for (const double share : {0.01, 0.16, 0.3}) {
    for (const double compression : {0.0, 0.2, 0.5}) {
      rod::StrainVector q = rod::StrainVector::Zero(shape->size());
      q[shape->stretch().begin] = -compression;
      ForkMesh mesh;
      model.deform(rod_curve(*shape, q, RigidTransform::Identity()), share * L, mesh);
      double wire_end = 0.0;
      for (const Eigen::Vector3i& t : model.spring()) wire_end = std::max(wire_end, corner(mesh, t, 0).z());
      const double begin_of_needle = (1.0 - compression) * L - ForkAppearance().needle_length * share * L;
      EXPECT_NEAR(wire_end, begin_of_needle, ForkAppearance().wire_radius * share * L) << share << ' ' << compression;
    }
  }
}

TEST(ForkModel, RefusesALookThatIsNoSurface) {
  ForkAppearance look;
  look.wire_sides = 2;
  EXPECT_THROW(ForkModel{look}, validation::InputError);
  look = ForkAppearance();
  look.prong_length = 0.0;
  EXPECT_THROW(ForkModel{look}, validation::InputError);
}

}  // namespace
}  // namespace spring_workbench::fork_mesh::fork_model_test
