// A written scene is read back identically.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "spring_workbench/scene/editing.h"
#include "spring_workbench/validation/input_error.h"
#include "support/paths.h"
#include "support/random_poses.h"
#include "support/temporary_folder.h"

namespace spring_workbench::scene::save_scene_test {
namespace {

namespace fs = std::filesystem;

void expect_same(const std::vector<geometry::Shape>& a, const std::vector<geometry::Shape>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_TRUE(a[i].X_OS.isApprox(b[i].X_OS, 1e-12));
    EXPECT_LT((a[i].color - b[i].color).norm(), 1e-6);
    EXPECT_EQ(a[i].color_given, b[i].color_given);
    ASSERT_EQ(a[i].geometry.index(), b[i].geometry.index());
    if (const auto* mesh = std::get_if<geometry::MeshPtr>(&a[i].geometry)) {
      const geometry::TriangleMesh &of_a = **mesh, &of_b = *std::get<geometry::MeshPtr>(b[i].geometry);
      EXPECT_EQ(of_a.vertices, of_b.vertices);
      EXPECT_EQ(of_a.triangles, of_b.triangles);
    } else if (const auto* box = std::get_if<geometry::Box>(&a[i].geometry)) {
      EXPECT_EQ(box->size, std::get<geometry::Box>(b[i].geometry).size);
    } else if (const auto* ball = std::get_if<geometry::Sphere>(&a[i].geometry)) {
      EXPECT_EQ(ball->radius, std::get<geometry::Sphere>(b[i].geometry).radius);
    } else {
      EXPECT_EQ(std::get<geometry::Cylinder>(a[i].geometry).radius, std::get<geometry::Cylinder>(b[i].geometry).radius);
      EXPECT_EQ(std::get<geometry::Cylinder>(a[i].geometry).length, std::get<geometry::Cylinder>(b[i].geometry).length);
    }
  }
}

void expect_same(const Material& a, const Material& b) {
  EXPECT_EQ(a.friction, b.friction);
  EXPECT_EQ(a.restitution, b.restitution);
  EXPECT_EQ(a.density, b.density);
  EXPECT_EQ(a.stiffness, b.stiffness);
}

void expect_same(const Scene& a, const Scene& b) {
  EXPECT_EQ(a.gravity, b.gravity);
  EXPECT_EQ(a.contact, b.contact);
  EXPECT_EQ(a.tool, b.tool);
  EXPECT_EQ(a.force_scale, b.force_scale);
  EXPECT_EQ(a.bench_height, b.bench_height);
  ASSERT_EQ(a.X_WH_start.size(), b.X_WH_start.size());
  for (std::size_t hand = 0; hand < a.X_WH_start.size(); ++hand)
    EXPECT_TRUE(a.X_WH_start[hand].isApprox(b.X_WH_start[hand], 1e-14));
  expect_same(a.bench_material, b.bench_material);
  ASSERT_EQ(a.bodies.size(), b.bodies.size());
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    const Body &of_a = a.bodies[i], &of_b = b.bodies[i];
    SCOPED_TRACE(of_a.name);
    EXPECT_EQ(of_a.name, of_b.name);
    EXPECT_EQ(of_a.movable, of_b.movable);
    EXPECT_TRUE(of_a.X_WO.isApprox(of_b.X_WO, 1e-12));
    EXPECT_TRUE(of_a.X_OL.isApprox(of_b.X_OL, 1e-12));
    EXPECT_EQ(of_a.mass_properties.mass, of_b.mass_properties.mass);
    EXPECT_TRUE(of_a.mass_properties.inertia_O.isApprox(of_b.mass_properties.inertia_O, 1e-14));
    expect_same(of_a.material, of_b.material);
    expect_same(of_a.collision, of_b.collision);
    expect_same(of_a.visual, of_b.visual);
  }
  ASSERT_EQ(a.targets.size(), b.targets.size());
  for (const auto& [name, target] : a.targets) {
    EXPECT_TRUE(target.X_WL.isApprox(b.targets.at(name).X_WL, 1e-14)) << name;
    EXPECT_EQ(target.position_tolerance, b.targets.at(name).position_tolerance);
    EXPECT_EQ(target.angle_tolerance, b.targets.at(name).angle_tolerance);
    EXPECT_EQ(target.max_force, b.targets.at(name).max_force);
    EXPECT_EQ(target.p_LG, b.targets.at(name).p_LG);
  }
}

TEST(SavedScenes, EveryShippedSceneIsReadAsItWas) {
  const test_support::TemporaryFolder folder;
  int scenes = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(test_support::checkout("scenes"))) {
    if (entry.path().extension() != ".urdf") continue;
    SCOPED_TRACE(entry.path().string());
    const Scene scene = load_scene(entry.path().string());
    const Scene again = load_scene(save_scene(scene, folder.path("saved.urdf")));
    expect_same(scene, again);
    EXPECT_TRUE(again.warnings.empty()) << again.warnings.front();
    ++scenes;
  }
  EXPECT_GE(scenes, 4);
  const fs::directory_iterator files(folder.path(""));
  EXPECT_EQ(std::distance(files, fs::directory_iterator()), 2);  // nothing else was left
}

/// Every kind of shape, a root body, a massless body, random orientations and those at the poles.
TEST(SavedScenes, SoIsOneWithEverythingInIt) {
  const test_support::TemporaryFolder folder;
  folder.write("wedge.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  folder.write("scene.urdf", R"(<robot name="all">
    <link name="workbench"><collision><geometry><box size="2 2 0.1"/></geometry></collision></link>
    <link name="shelf &amp; co"><visual><geometry><cylinder radius="0.1" length="0.7"/></geometry></visual></link>
    <joint name="a" type="fixed"><parent link="workbench"/><child link="shelf &amp; co"/><origin xyz="1 0 0"/></joint>
    <link name="thing"><inertial><origin xyz="0.1 0.02 0.03" rpy="0.3 0.2 0.1"/><mass value="0.3"/>
      <inertia ixx="0.002" iyy="0.003" izz="0.004" ixy="0.0001" ixz="-0.0002" iyz="0.0003"/></inertial>
      <collision><origin xyz="0.1 0 0" rpy="0 1.5707963267948966 0.3"/>
        <geometry><sphere radius="0.3"/></geometry></collision>
      <visual><geometry><mesh filename="wedge.obj" scale="0.1 0.2 0.3"/></geometry>
        <material name="red"><color rgba="1 0.1 0.2 0.5"/></material></visual></link>
    <joint name="c" type="floating"><parent link="workbench"/><child link="thing"/></joint>
    <link name="light"><collision><geometry><box size="0.1 0.2 0.3"/></geometry></collision></link>
    <joint name="b" type="floating"><parent link="workbench"/><child link="light"/></joint></robot>)");
  folder.write("scene.yaml", R"({gravity: 1.62, contact: dynamic, tool: ray, force_scale: 3, bench_height: -0.2,
    start: {handle: [0.1, 0.2, 0.3, 0.5, 0.5, 0.5, 0.5]},
    defaults: {friction: 0.3, restitution: 0.1, density: 700, material_stiffness: 1.0e+4},
    objects: {light: {massless: true, friction: 0.9}, thing: {material_stiffness: .inf}},
    targets: {thing: {pose: [1, 2, 3, 0.1, 0.2, 0.3, 0.9], position_tolerance: 0.02}}})");
  Scene scene = load_scene(folder.path("scene.urdf"));
  ASSERT_EQ(scene.bodies.size(), 4u);
  test_support::Random random(7);
  for (int i = 0; i < 40; ++i) {
    for (Body& body : scene.bodies) {
      if (!body.movable) continue;
      body.X_WO = random.pose(2.0);
      if (i % 4 == 0) {  // at a pole of roll, pitch and yaw, and near it
        body.X_WO.linear() = (Eigen::AngleAxisd(0.3 * i, Vector3d::UnitZ()) *
                              Eigen::AngleAxisd(0.5 * M_PI - (i % 8 == 0 ? 0.0 : 1e-8), Vector3d::UnitY()) *
                              Eigen::AngleAxisd(0.7, Vector3d::UnitX()))
                                 .toRotationMatrix();
      }
    }
    set_mass(scene.bodies[*find_body(scene, "thing")], 0.1 + 0.3 * i, "test");
    expect_same(scene, load_scene(save_scene(scene, folder.path("again.urdf"))));
  }
}

TEST(SavedScenes, WhereTheyMayNotBeTheyAreRefused) {
  const test_support::TemporaryFolder folder, elsewhere;
  const Scene scene = load_scene(test_support::checkout("scenes/single_box.urdf"));
  const auto refusal = [&](const std::string& path) -> std::string {
    try {
      save_scene(scene, path, {folder.path("")});
    } catch (const validation::InputError& error) {
      return error.what();
    }
    return "";
  };
  const auto invalid = [](const std::string& path) { return "path: invalid value '" + path + "': expected "; };
  EXPECT_EQ(refusal(folder.path("good.urdf")), "");
  const std::string outside = elsewhere.path("box.urdf");
  EXPECT_EQ(refusal(outside), invalid(outside) + "a file in a ROS package or in one of the folders " + folder.path("") +
                                  " (to add folders, use the parameter scene_roots or the argument roots)");
  const std::string above = folder.path("../box.urdf"), in_package = invalid(above) + "a file in a ROS package";
  EXPECT_EQ(refusal(above).substr(0, in_package.size()), in_package);
  const std::string rule = "a package:// URI or an absolute path, in a folder that exists";
  EXPECT_EQ(refusal("box.urdf"), invalid("box.urdf") + rule);
  EXPECT_EQ(refusal(folder.path("none/box.urdf")), invalid(folder.path("none/box.urdf")) + rule);
  EXPECT_EQ(refusal(folder.path("box.xml")), invalid(folder.path("box.xml")) + "a path that ends in .urdf");
  fs::create_directory(folder.path("taken.yaml"));
  EXPECT_EQ(refusal(folder.path("taken.urdf")), folder.path("taken.yaml") + ": cannot be written: it is a folder");
  EXPECT_FALSE(fs::exists(folder.path("taken.urdf")));
}

}  // namespace
}  // namespace spring_workbench::scene::save_scene_test
