// Every shipped scene, and a collection of third-party URDFs; load_scene_test.cpp covers each of their defects.
#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/Eigenvalues>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "spring_workbench/geometry/shape_queries.h"
#include "spring_workbench/scene/scene.h"
#include "spring_workbench/validation/input_error.h"
#include "support/paths.h"

namespace spring_workbench::scene::scene_files_test {
namespace {

namespace fs = std::filesystem;

const fs::path scenes = test_support::checkout("scenes");
const fs::path collection = test_support::extra_data("data/urdf");

/// Every loaded scene can be simulated.
void expect_sound(const Scene& scene) {
  for (const Body& body : scene.bodies) {
    SCOPED_TRACE(body.name);
    EXPECT_TRUE(body.X_WO.matrix().allFinite());
    EXPECT_TRUE(body.X_OL.linear().isIdentity(1e-12));
    for (const geometry::Shape& shape : body.collision)
      EXPECT_FALSE(geometry::bounding_box(shape.geometry, shape.X_OS).isEmpty());
    if (!body.movable) continue;
    EXPECT_GT(body.mass_properties.mass, 0.0);
    const Vector3d moments = Eigen::SelfAdjointEigenSolver<Matrix3d>(body.mass_properties.inertia_O).eigenvalues();
    EXPECT_GT(moments[0], 0.0);
    EXPECT_LE(moments[2], (moments[0] + moments[1]) * (1.0 + 1e-5));
    if (!body.collision.empty()) {
      EXPECT_LE(moments[2],
                body.mass_properties.mass * std::pow(geometry::bounding_radius(body.collision), 2) * (1.0 + 1e-5));
    }
  }
}

double lowest_point(const Body& body) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const geometry::Shape& shape : body.collision) {
    lowest = std::min(lowest, geometry::bounding_box(shape.geometry, body.X_WO * shape.X_OS).min().z());
  }
  return lowest;
}

TEST(ShippedScenes, AllLoadWithoutAWarningAndLieOnTheBench) {
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(scenes)) {
    if (entry.path().extension() != ".urdf") continue;
    SCOPED_TRACE(entry.path().string());
    const Scene scene = load_scene(entry.path().string());
    names.insert(scene.name);
    expect_sound(scene);
    EXPECT_TRUE(scene.warnings.empty());
    for (const Body& body : scene.bodies) {
      if (!body.movable) continue;
      EXPECT_NEAR(lowest_point(body), scene.bench_height, 1e-12) << body.name;
    }
  }
  EXPECT_TRUE(names.count("mini_world"));
  EXPECT_TRUE(names.count("single_box"));
}

TEST(ShippedScenes, TheSingleBoxIsOneKilogramOfUniformDensity) {
  const Scene scene = load_scene((scenes / "single_box.urdf").string());
  const Body& box = scene.bodies[*find_body(scene, "box")];
  EXPECT_EQ(box.mass_properties.mass, 1.0);
  const geometry::VolumeProperties solid = geometry::volume_properties(box.collision[0].geometry);
  EXPECT_TRUE(box.mass_properties.inertia_O.isApprox(solid.inertia_per_density / solid.volume, 1e-9));
}

TEST(ShippedScenes, TheMiniWorldFitsIntoTheBlueBox) {
  const Scene scene = load_scene((scenes / "mini_world.urdf").string());
  const Body& bin = scene.bodies[*find_body(scene, "blue_box")];
  EXPECT_FALSE(bin.movable);
  Eigen::AlignedBox3d inside = geometry::bounding_box(bin.collision);
  inside.translate(bin.X_WO.translation());
  std::vector<Eigen::AlignedBox3d> places;
  int movable = 0;
  for (const Body& body : scene.bodies) {
    if (!body.movable) continue;
    ++movable;
    EXPECT_GE(body.mass_properties.mass, 0.1 - 1e-9);
    EXPECT_LE(body.mass_properties.mass, 30.0 + 1e-9);
    ASSERT_TRUE(scene.targets.count(body.name)) << body.name;
    const RigidTransform X_WO = scene.targets.at(body.name).X_WL * body.X_OL.inverse();
    const Eigen::AlignedBox3d place = geometry::bounding_box(body.collision[0].geometry, X_WO * body.collision[0].X_OS);
    EXPECT_TRUE(inside.contains(place)) << body.name;
    for (const geometry::Shape& wall : bin.collision) {
      const Eigen::AlignedBox3d box = geometry::bounding_box(wall.geometry, bin.X_WO * wall.X_OS);
      EXPECT_LT(box.intersection(place).sizes().minCoeff(), 1e-12) << body.name;
    }
    for (const Eigen::AlignedBox3d& other : places) EXPECT_FALSE(other.intersects(place)) << body.name;
    places.push_back(place);
  }
  EXPECT_GE(movable, 6);
}

class Collection : public testing::Test {
 protected:
  void SetUp() override {
    if (collection.empty()) GTEST_SKIP() << "SPRING_WORKBENCH_TEST_DATA is not given";
    const char* before = std::getenv("ROS_PACKAGE_PATH");
    saved_ = before != nullptr ? before : "";
    setenv("ROS_PACKAGE_PATH", collection.c_str(), 1);
  }
  void TearDown() override { setenv("ROS_PACKAGE_PATH", saved_.c_str(), 1); }

  /// The files of the README's table, with what urdfdom says: "accept" or "REJECT".
  static std::vector<std::pair<std::string, std::string>> files() {
    std::vector<std::pair<std::string, std::string>> files;
    std::ifstream readme(collection / "README.md");
    for (std::string line; std::getline(readme, line);) {
      const std::size_t end = line.find(".urdf |");
      if (line.rfind("| ", 0) != 0 || end == std::string::npos) continue;
      const bool rejected = line.find("| REJECT") != std::string::npos;
      files.emplace_back(line.substr(2, end + 3), rejected ? "REJECT" : "accept");
    }
    return files;
  }

 private:
  std::string saved_;
};

TEST_F(Collection, WhatUrdfdomTakesLoadsAndWhatItRejectsIsRefused) {
  const std::set<std::string> mesh_missing = {"drake_parsing/urdf_parser_test/all_geometries_as_collision.urdf"};
  ASSERT_GE(files().size(), 38u);
  for (const auto& [file, verdict] : files()) {
    SCOPED_TRACE(file);
    const std::string path = (collection / file).string();
    if (verdict == "REJECT" || mesh_missing.count(file)) {
      try {
        load_scene(path);
        ADD_FAILURE() << "was loaded";
      } catch (const validation::InputError& e) {
        EXPECT_NE(std::string(e.what()).find(fs::path(file).filename().string()), std::string::npos) << e.what();
      }
    } else {
      EXPECT_NO_THROW(expect_sound(load_scene(path)));
    }
  }
}

TEST_F(Collection, DefectsAreReportedWithTheirLink) {
  const auto has_warning = [&](const std::string& file, const std::string& link, const std::string& what) {
    for (const std::string& warning : load_scene((collection / file).string()).warnings) {
      if (warning.find("'" + link + "'") != std::string::npos && warning.find(what) != std::string::npos) return true;
    }
    return false;
  };
  EXPECT_TRUE(has_warning("bullet3/block.urdf", "block_2_base_link", "implausible"));
  EXPECT_TRUE(has_warning("bullet3/sphere_small_zeroinertia.urdf", "base_link", "positive definite"));
  EXPECT_TRUE(has_warning("bullet3/dinnerware/plate.urdf", "cube", "inertial cannot be read"));
  EXPECT_TRUE(has_warning("bullet3/plane.urdf", "planeLink", "no mass"));
  EXPECT_TRUE(has_warning("drake_objects/folding_table.urdf", "table_surface_center", "no mass"));
}

TEST_F(Collection, ADroppedInertialLeavesShapesAndMass) {
  const Scene plate = load_scene((collection / "bullet3/dinnerware/plate.urdf").string());
  EXPECT_EQ(plate.bodies[0].collision.size(), 7u);
  EXPECT_EQ(plate.bodies[0].mass_properties.mass, 0.5);
  EXPECT_TRUE(plate.bodies[0].movable);
  const Scene box = load_scene((collection / "drake_parsing/box_package/urdfs/box.urdf").string());
  EXPECT_TRUE(
      box.bodies[0].mass_properties.inertia_O.isApprox(4.0 / 6.0 * Matrix3d::Identity(), 1e-6));  // 2 m cube, 1 kg
}

TEST_F(Collection, MalformedMeshesAreRefusedAndOddButValidOnesLoad) {
  const fs::path meshes = collection / "malformed" / "assimp";
  const std::set<std::string> valid = {"box_without_lineending.obj", "cube_UTF8BOM.dae"};
  int count = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(meshes)) {
    if (!entry.is_regular_file()) continue;
    ++count;
    SCOPED_TRACE(entry.path().string());
    const fs::path urdf = fs::temp_directory_path() / ("spring_workbench_" + std::to_string(getpid()) + ".urdf");
    std::ofstream(urdf) << "<robot name='a'><link name='world'/><link name='b'><collision><geometry><mesh filename='"
                        << entry.path().string() << "'/></geometry></collision></link><joint name='j' type='floating'>"
                        << "<parent link='world'/><child link='b'/></joint></robot>";
    if (valid.count(entry.path().filename().string())) {
      EXPECT_NO_THROW(expect_sound(load_scene(urdf.string())));
    } else {
      EXPECT_THROW(load_scene(urdf.string()), validation::InputError);
    }
    fs::remove(urdf);
  }
  EXPECT_GE(count, 8);
}

}  // namespace
}  // namespace spring_workbench::scene::scene_files_test
