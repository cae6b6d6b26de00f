#include <gtest/gtest.h>
#include <sys/stat.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <set>
#include <sstream>
#include <thread>

#include "spring_workbench/geometry/shape_queries.h"
#include "spring_workbench/scene/editing.h"
#include "spring_workbench/scene/scene.h"
#include "spring_workbench/validation/input_error.h"
#include "src/scene/mesh_reader.h"
#include "support/temporary_folder.h"

namespace spring_workbench::scene::load_scene_test {
namespace {

using test_support::TemporaryFolder;

const std::string floating_joint =
    "<joint name='j' type='floating'><parent link='world'/><child link='part'/><origin xyz='1 2 3' rpy='0 0 "
    "0.5'/></joint>";
const std::string unit_box = "<collision><geometry><box size='0.2 0.2 0.2'/></geometry></collision>";

std::string inertial(const std::string& mass, const std::string& moments) {
  std::istringstream in(moments);
  std::string xx, yy, zz;
  in >> xx >> yy >> zz;
  return "<inertial><mass value='" + mass + "'/><inertia ixx='" + xx + "' iyy='" + yy + "' izz='" + zz +
         "' ixy='0' ixz='0' iyz='0'/></inertial>";
}

class LoadScene : public testing::Test {
 protected:
  /// A bench with one movable link `part`.
  Scene load_part(const std::string& link_content, const std::string& yaml = "") {
    return load("<link name='world'/><link name='part'>" + link_content + "</link>" + floating_joint, yaml);
  }
  Scene load(const std::string& robot_content, const std::string& yaml = "") {
    folder_.write("scene.urdf", "<robot name='test'>\n" + robot_content + "\n</robot>\n");
    folder_.write("scene.yaml", yaml);
    return load_scene(folder_.path("scene.urdf"));
  }
  std::string refusal(const std::string& robot_content, const std::string& yaml = "") {
    try {
      load(robot_content, yaml);
    } catch (const validation::InputError& e) {
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
      return e.what();
    }
    return "(loaded)";
  }
  std::string part_refusal(const std::string& link_content, const std::string& yaml = "") {
    return refusal("<link name='world'/><link name='part'>" + link_content + "</link>" + floating_joint, yaml);
  }
  void write_mesh(const std::string& name, const std::string& text) { folder_.write(name, text); }

  TemporaryFolder folder_;
};

testing::AssertionResult has(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "'" << part << "' is not in: " << text;
}
testing::AssertionResult warned(const Scene& scene, const std::string& part) {
  std::string all;
  for (const std::string& warning : scene.warnings) all += warning + "\n";
  return has(all, part);
}

TEST_F(LoadScene, TheObjectFrameIsTheCentreOfMassInTheAxesOfTheLink) {
  const Scene scene = load_part(
      "<inertial><origin xyz='0.01 0.02 0.03' rpy='0.3 0.2 0.1'/><mass value='2'/>"
      "<inertia ixx='0.01' iyy='0.02' izz='0.025' ixy='0' ixz='0' iyz='0'/></inertial>" +
      unit_box);
  EXPECT_TRUE(scene.warnings.empty());
  ASSERT_EQ(scene.bodies.size(), 1u);
  const Body& body = scene.bodies[0];
  EXPECT_TRUE(body.movable);
  const RigidTransform X_WL = make_transform(Vector3d(1, 2, 3), Quaterniond(Eigen::AngleAxisd(0.5, Vector3d::UnitZ())));
  EXPECT_TRUE((body.X_WO * body.X_OL).isApprox(X_WL, 1e-12));
  EXPECT_TRUE(body.X_OL.translation().isApprox(Vector3d(-0.01, -0.02, -0.03)));
  EXPECT_TRUE(body.X_OL.linear().isIdentity());
  EXPECT_TRUE(body.collision[0].X_OS.translation().isApprox(Vector3d(-0.01, -0.02, -0.03)));
  // rpy: about fixed x, then y, then z.
  const Matrix3d R = (Eigen::AngleAxisd(0.1, Vector3d::UnitZ()) * Eigen::AngleAxisd(0.2, Vector3d::UnitY()) *
                      Eigen::AngleAxisd(0.3, Vector3d::UnitX()))
                         .toRotationMatrix();
  const Matrix3d expected = R * Vector3d(0.01, 0.02, 0.025).asDiagonal() * R.transpose();
  EXPECT_TRUE(body.mass_properties.inertia_O.isApprox(expected, 1e-9));
}

TEST_F(LoadScene, WithoutInertialMassIsVolumeTimesDensity) {
  const Scene scene = load_part(unit_box, "{defaults: {density: 500}, objects: {part: {density: 2000}}}");
  EXPECT_NEAR(scene.bodies[0].mass_properties.mass, 16.0, 1e-12);
  const Matrix3d expected = 16.0 * 0.04 / 6.0 * Matrix3d::Identity();
  EXPECT_TRUE(scene.bodies[0].mass_properties.inertia_O.isApprox(expected, 1e-12));
  EXPECT_EQ(scene.bench_material.density, 500.0);
}

/// A body cut into links on fixed joints has the mass properties of the whole.
TEST_F(LoadScene, FixedJointsMergeLinksIntoOneBody) {
  const std::string half = "<collision><geometry><box size='0.1 0.2 0.3'/></geometry></collision>";
  const Scene cut = load("<link name='world'/><link name='part'>" + half + "</link><link name='other'>" + half +
                         "</link>" + floating_joint +
                         "<joint name='f' type='fixed'><parent link='part'/><child link='other'/><origin xyz='0.1 0 0' "
                         "rpy='0 0 3.14159265358979'/>"
                         "</joint>");
  ASSERT_EQ(cut.bodies.size(), 1u);
  const Body& body = cut.bodies[0];
  EXPECT_EQ(body.collision.size(), 2u);
  EXPECT_NEAR(body.mass_properties.mass, 12.0, 1e-12);
  EXPECT_TRUE(body.X_OL.translation().isApprox(Vector3d(-0.05, 0, 0), 1e-12));
  const Vector3d expected = 12.0 / 12.0 * Vector3d(0.04 + 0.09, 0.04 + 0.09, 0.04 + 0.04);
  EXPECT_TRUE(body.mass_properties.inertia_O.isApprox(Matrix3d(expected.asDiagonal()), 1e-9));
}

TEST_F(LoadScene, InertialsOfMergedLinksAddUpByTheParallelAxisTheorem) {
  const std::string ball = inertial("1.5", "0.002 0.002 0.002");
  const std::string shape = "<collision><geometry><sphere radius='0.1'/></geometry></collision>";
  const Scene scene =
      load("<link name='world'/><link name='part'>" + ball + shape + "</link><link name='other'>" + ball + shape +
           "</link>" + floating_joint +
           "<joint name='f' type='fixed'><parent link='part'/><child link='other'/><origin xyz='0 0.4 0'/></joint>");
  const double across = 2 * 0.002 + 2 * 1.5 * 0.04;
  EXPECT_NEAR(scene.bodies[0].mass_properties.mass, 3.0, 1e-12);
  EXPECT_TRUE(scene.bodies[0].mass_properties.inertia_O.isApprox(Matrix3d(Vector3d(across, 0.004, across).asDiagonal()),
                                                                 1e-12));
}

TEST_F(LoadScene, ALinkFixedToTheBenchIsAFixedBody) {
  const Scene scene = load(
      "<link name='workbench'/><link name='wall'>" + unit_box + "</link><link name='top'>" + unit_box +
      "</link><joint name='a' type='fixed'><parent link='workbench'/><child link='wall'/><origin xyz='1 0 0'/></joint>"
      "<joint name='b' type='fixed'><parent link='wall'/><child link='top'/><origin xyz='0 0 0.5'/></joint>");
  ASSERT_EQ(scene.bodies.size(), 1u);
  EXPECT_EQ(scene.bodies[0].name, "wall");
  EXPECT_FALSE(scene.bodies[0].movable);
  EXPECT_EQ(scene.bodies[0].mass_properties.mass, 0.0);
  EXPECT_TRUE(scene.bodies[0].X_WO.translation().isApprox(Vector3d(1, 0, 0)));
  EXPECT_TRUE(scene.bodies[0].collision[1].X_OS.translation().isApprox(Vector3d(0, 0, 0.5)));
}

TEST_F(LoadScene, OtherJointsAreHeldAtZeroWithAWarning) {
  for (const std::string type : {"revolute", "prismatic", "continuous", "planar"}) {
    const Scene scene = load("<link name='world'/><link name='part'>" + unit_box + "</link><link name='arm'>" +
                             unit_box + "</link>" + floating_joint + "<joint name='hinge' type='" + type +
                             "'><parent link='part'/><child link='arm'/><axis xyz='0 0 1'/>"
                             "<limit effort='1' velocity='1' lower='-1' upper='1'/></joint>");
    EXPECT_EQ(scene.bodies.size(), 1u);
    EXPECT_TRUE(warned(scene, "link 'arm': joint 'hinge'"));
  }
}

TEST_F(LoadScene, AnObjectByItselfLiesOnTheBench) {
  const std::string tilted =
      "<collision><origin xyz='0 0 0.7' rpy='0.4 0.3 0'/><geometry><cylinder radius='0.1' length='0.3'/>"
      "</geometry></collision>";
  const Scene scene =
      load("<link name='mug'>" + inertial("1", "0.01 0.01 0.01") + tilted + "</link>", "bench_height: 0.25");
  ASSERT_EQ(scene.bodies.size(), 1u);
  EXPECT_TRUE(scene.bodies[0].movable);
  const geometry::Shape& shape = scene.bodies[0].collision[0];
  EXPECT_NEAR(geometry::bounding_box(shape.geometry, scene.bodies[0].X_WO * shape.X_OS).min().z(), 0.25, 1e-12);
  EXPECT_NEAR(scene.bodies[0].X_WO.translation().x(), 0.0, 1e-15);
}

TEST_F(LoadScene, ARootWithoutMassIsFixed) {
  EXPECT_FALSE(load("<link name='table'>" + unit_box + "</link>").bodies[0].movable);
  const Scene massless = load("<link name='table'>" + inertial("0", "1 1 1") + unit_box + "</link>");
  EXPECT_FALSE(massless.bodies[0].movable);
  EXPECT_TRUE(warned(massless, "link 'table': the root has no mass"));
}

// ---- common defects of real files

TEST_F(LoadScene, ImpossibleInertiaIsReplacedByTheShapes) {
  for (const auto& [moments, reason] :
       std::vector<std::pair<std::string, std::string>>{{"1 1 1", "implausible"},
                                                        {"0 0 0", "positive definite"},
                                                        {"-0.01 0.01 0.01", "positive definite"},
                                                        {"0.001 0.001 0.01", "triangle inequality"}}) {
    const Scene scene = load_part(inertial("0.5", moments) + unit_box);
    EXPECT_TRUE(warned(scene, "link 'part'"));
    EXPECT_TRUE(warned(scene, reason));
    EXPECT_EQ(scene.bodies[0].mass_properties.mass, 0.5);
    const Matrix3d expected = 0.5 * 0.04 / 6.0 * Matrix3d::Identity();
    EXPECT_TRUE(scene.bodies[0].mass_properties.inertia_O.isApprox(expected, 1e-12)) << moments;
  }
}

TEST_F(LoadScene, TheRadiusOfGyrationMayReachTheShapesEndAndNoFurther) {
  const double size = 0.1 * std::sqrt(3.0);
  const auto with_radius = [&](double radius) {
    const std::string moment = std::to_string(100.0 * radius * radius);
    return load_part(inertial("100", moment + " " + moment + " " + moment) + unit_box).warnings.size();
  };
  EXPECT_EQ(with_radius(0.99 * size), 0u);
  EXPECT_EQ(with_radius(1.01 * size), 1u);
}

TEST_F(LoadScene, AnInertialThatUrdfdomDropsTakesNothingElseWithIt) {
  const Scene scene = load_part("<inertial><mass value='2'/></inertial>" + unit_box + unit_box);
  EXPECT_TRUE(warned(scene, "link 'part': inertial cannot be read"));
  EXPECT_EQ(scene.bodies[0].collision.size(), 2u);
  EXPECT_EQ(scene.bodies[0].mass_properties.mass, 2.0);
  const Matrix3d expected = 2.0 * 0.04 / 6.0 * Matrix3d::Identity();
  EXPECT_TRUE(scene.bodies[0].mass_properties.inertia_O.isApprox(expected, 1e-12));
  EXPECT_NEAR(load_part("<inertial><mass value='nan'/></inertial>" + unit_box).bodies[0].mass_properties.mass, 8.0,
              1e-12);
}

TEST_F(LoadScene, AnUnknownShapeIsReportedAndSkippedAlone) {
  const Scene scene =
      load_part("<collision><geometry><capsule radius='1' length='1'/></geometry></collision><collision/>" + unit_box);
  EXPECT_TRUE(warned(scene, "link 'part': collision skipped: shape 'capsule'"));
  EXPECT_TRUE(warned(scene, "shape missing"));
  EXPECT_EQ(scene.bodies[0].collision.size(), 1u);
}

TEST_F(LoadScene, MassThatIsNotPositiveComesFromTheShapeOrIsRefused) {
  for (const std::string mass : {"0", "-3"}) {
    const Scene scene = load_part(inertial(mass, "1 1 1") + unit_box);
    EXPECT_TRUE(warned(scene, "link 'part': mass"));
    EXPECT_NEAR(scene.bodies[0].mass_properties.mass, 8.0, 1e-12);
    EXPECT_TRUE(has(part_refusal(inertial(mass, "1 1 1")), "link 'part': mass"));
  }
  EXPECT_TRUE(has(part_refusal(""), "link 'part': mass"));
}

/// The same body, whichever of its two halves has the mass that is not positive.
TEST_F(LoadScene, MassThatIsNotPositiveComesFromTheShapeInEachLinkOfABody) {
  for (const std::string mass : {"0", "-3"}) {
    for (const bool first : {true, false}) {
      const std::string given = inertial("8", "0.05 0.05 0.05") + unit_box, none = inertial(mass, "1 1 1") + unit_box;
      const Scene scene = load(
          "<link name='world'/><link name='part'>" + (first ? none : given) + "</link><link name='other'>" +
          (first ? given : none) + "</link>" + floating_joint +
          "<joint name='f' type='fixed'><parent link='part'/><child link='other'/><origin xyz='0.4 0 0'/></joint>");
      EXPECT_TRUE(warned(scene, std::string("link '") + (first ? "part" : "other") + "': mass " + mass));
      EXPECT_NEAR(scene.bodies[0].mass_properties.mass, 16.0, 1e-12);
      EXPECT_TRUE(scene.bodies[0].X_OL.translation().isApprox(Vector3d(-0.2, 0, 0), 1e-12));
    }
  }
}

TEST_F(LoadScene, AMassThatIsNotPositiveWithoutAVolumeIsNone) {
  const Scene scene = load("<link name='world'/><link name='part'>" + inertial("8", "0.05 0.05 0.05") + unit_box +
                           "</link><link name='other'>" + inertial("0", "1 1 1") + "</link>" + floating_joint +
                           "<joint name='f' type='fixed'><parent link='part'/><child link='other'/></joint>");
  EXPECT_TRUE(warned(scene, "link 'other': mass 0 is not positive: the link is treated as massless"));
  EXPECT_EQ(scene.bodies[0].mass_properties.mass, 8.0);
}

// ---- refusals

TEST_F(LoadScene, DegenerateSizesAreRefused) {
  for (const std::string shape :
       {"<box size='0 1 1'/>", "<box size='1 -1 1'/>", "<box size='1 nan 1'/>", "<box size='1 1'/>",
        "<sphere radius='0'/>", "<sphere radius='-1'/>", "<sphere/>", "<sphere radius='1e999'/>",
        "<cylinder radius='0' length='1'/>", "<cylinder radius='1' length='-1'/>", "<mesh/>",
        "<mesh filename='not_there.stl'/>"}) {
    const std::string message = part_refusal("<collision><geometry>" + shape + "</geometry></collision>");
    EXPECT_TRUE(has(message, "scene.urdf:")) << shape;
    EXPECT_TRUE(has(message, "link 'part'")) << shape;
  }
}

/// It is not needed for contact, so the scene is loaded with a warning; what is left of the link is drawn.
TEST_F(LoadScene, AMissingVisualMeshIsNotDrawn) {
  const std::string ball = "<visual><geometry><sphere radius='0.1'/></geometry></visual>";
  for (const std::string name : {"not_there.stl", "package://no_such_package/a.stl", "file:///not/there.dae"}) {
    const std::string mesh = "<geometry><mesh filename='" + name + "'/></geometry>";
    const Scene scene = load_part(unit_box + "<visual>" + mesh + "</visual>" + ball);
    EXPECT_TRUE(warned(scene, "scene.urdf:2: link 'part': mesh: ")) << name;
    EXPECT_TRUE(warned(scene, "'" + name + "'"));
    EXPECT_TRUE(warned(scene, ": it is not drawn"));
    const Body& part = scene.bodies[0];
    EXPECT_NEAR(part.mass_properties.mass, 8.0, 1e-12);
    ASSERT_EQ(part.visual.size(), 1u);
    EXPECT_TRUE(std::holds_alternative<geometry::Sphere>(part.visual[0].geometry));
    EXPECT_TRUE(std::holds_alternative<geometry::Box>(
        load_part(unit_box + "<visual>" + mesh + "</visual>").bodies[0].visual.at(0).geometry));
    EXPECT_TRUE(has(part_refusal("<collision>" + mesh + "</collision>" + ball), name)) << "it is needed for contact";
  }
  write_mesh("broken.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_TRUE(has(part_refusal(unit_box + "<visual><geometry><mesh filename='broken.obj'/></geometry></visual>"),
                  "broken.obj"));
}

TEST_F(LoadScene, WhatUrdfdomRefusesIsRefusedWithItsReasonAndNothingOnTheConsole) {
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  EXPECT_TRUE(has(refusal("<link name='a'/><link name='b'/>"), "Two root links"));
  EXPECT_TRUE(has(refusal("<link name='a'/><link name='a'/>"), "not unique"));
  EXPECT_TRUE(has(refusal(""), "No link elements"));
  EXPECT_TRUE(has(refusal("<link name='world'>"), "scene.urdf:"));
  EXPECT_TRUE(has(refusal("<link/>"), "name"));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

/// Random joints are accepted if and only if they form a tree that contains all links.
TEST_F(LoadScene, LinksMakeATreeOrAreRefused) {
  std::mt19937 random(1);
  int loaded = 0;
  for (int round = 0; round < 300; ++round) {
    const int links = 1 + static_cast<int>(random() % 4), joints = links - 1 + (random() % 3 == 0);
    std::string robot;
    for (int i = 0; i < links; ++i) robot += "<link name='l" + std::to_string(i) + "'/>";
    std::vector<std::pair<int, int>> ends;
    for (int i = 0; i < joints; ++i) {
      ends.emplace_back(random() % static_cast<unsigned>(links), random() % static_cast<unsigned>(links));
      robot += "<joint name='j" + std::to_string(i) + "' type='fixed'><parent link='l" +
               std::to_string(ends.back().first) + "'/><child link='l" + std::to_string(ends.back().second) +
               "'/></joint>";
    }
    bool tree = false;  // from one of them all others are reached, by as many joints as there are others
    for (int root = 0; root < links; ++root) {
      std::set<int> reached{root};
      for (int hop = 0; hop < links; ++hop) {
        for (const auto& [parent, child] : ends) {
          if (reached.count(parent) > 0) reached.insert(child);
        }
      }
      tree = tree || (joints == links - 1 && reached.size() == static_cast<std::size_t>(links));
    }
    loaded += tree;
    EXPECT_EQ(refusal(robot) == "(loaded)", tree) << robot;
  }
  EXPECT_GT(loaded, 20);
  EXPECT_LT(loaded, 280);
}

TEST_F(LoadScene, AFileThatIsNotThereIsRefused) {
  EXPECT_THROW(load_scene(folder_.path("nothing.urdf")), validation::InputError);
  EXPECT_THROW(load_scene(folder_.path("")), validation::InputError);
  EXPECT_THROW(load_scene("package://no_such_package/scene.urdf"), validation::InputError);
}

// ---- meshes

const std::string tetrahedron_obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

TEST_F(LoadScene, AMeshIsScaledAndClosed) {
  write_mesh("t.obj", tetrahedron_obj);
  const Scene scene =
      load_part("<collision><geometry><mesh filename='t.obj' scale='0.1 0.2 0.3'/></geometry></collision>");
  EXPECT_NEAR(scene.bodies[0].mass_properties.mass, 1000.0 * 0.006 / 6.0, 1e-6);
  const geometry::MeshPtr mesh = std::get<geometry::MeshPtr>(scene.bodies[0].collision[0].geometry);
  EXPECT_EQ(mesh->vertices.size(), 4u);
  EXPECT_EQ(mesh->uri, "file://" + folder_.path("t.obj"));
  EXPECT_TRUE(scene.warnings.empty());
}

TEST_F(LoadScene, AMirroredOrInsideOutMeshStillHasItsVolume) {
  write_mesh("t.obj", tetrahedron_obj);
  write_mesh("inside_out.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n");
  for (const std::string mesh : {"filename='t.obj' scale='-1 1 1'", "filename='inside_out.obj'"}) {
    const Scene scene = load_part("<collision><geometry><mesh " + mesh + "/></geometry></collision>");
    EXPECT_NEAR(geometry::volume_properties(scene.bodies[0].collision[0].geometry).volume, 1.0 / 6.0, 1e-7);
  }
}

TEST_F(LoadScene, AClosedMeshWhoseFacesDisagreeHasAnInside) {
  write_mesh("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const Scene scene = load_part("<collision><geometry><mesh filename='t.obj'/></geometry></collision>");
  EXPECT_NEAR(scene.bodies[0].mass_properties.mass, 1000.0 / 6.0, 1e-6);
  EXPECT_TRUE(scene.warnings.empty());
  EXPECT_TRUE(geometry::contains(scene.bodies[0].collision, Vector3d::Zero()));  // the centre of mass
}

TEST_F(LoadScene, StlAndObjOfOneShapeAreOneShape) {
  write_mesh("t.obj", tetrahedron_obj);
  const std::vector<Vector3d> v = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::ostringstream stl;
  stl << "solid t\n";
  for (const Eigen::Vector3i& t :
       {Eigen::Vector3i(0, 2, 1), Eigen::Vector3i(0, 1, 3), Eigen::Vector3i(0, 3, 2), Eigen::Vector3i(1, 2, 3)}) {
    stl << "facet normal 0 0 0\nouter loop\n";
    for (int k = 0; k < 3; ++k) stl << "vertex " << v[static_cast<std::size_t>(t[k])].transpose() << "\n";
    stl << "endloop\nendfacet\n";
  }
  stl << "endsolid t\n";
  write_mesh("t.stl", stl.str());
  const auto mass = [&](const std::string& file) {
    return load_part("<collision><geometry><mesh filename='" + file + "'/></geometry></collision>")
        .bodies[0]
        .mass_properties;
  };
  EXPECT_TRUE(mass("t.stl").inertia_O.isApprox(mass("t.obj").inertia_O, 1e-6));
}

TEST_F(LoadScene, AnOpenMeshCountsAsItsBoxWithAWarning) {
  write_mesh("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n");
  const Scene scene = load_part("<collision><geometry><mesh filename='open.obj'/></geometry></collision>");
  EXPECT_NEAR(scene.bodies[0].mass_properties.mass, 1000.0, 1e-9);
  EXPECT_TRUE(warned(scene, "link 'part': mesh"));
}

TEST_F(LoadScene, DegenerateMeshesAreRefused) {
  write_mesh("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  write_mesh("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
  write_mesh("nan.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write_mesh("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  write_mesh("empty.stl", "");
  write_mesh("text.dae", "no XML\n");
  write_mesh("mesh.txt", tetrahedron_obj);
  for (const std::string name :
       {"flat.obj", "index.obj", "nan.obj", "points.obj", "empty.stl", "text.dae", "mesh.txt"}) {
    EXPECT_TRUE(has(part_refusal("<collision><geometry><mesh filename='" + name + "'/></geometry></collision>"), name));
  }
  write_mesh("t.obj", tetrahedron_obj);
  EXPECT_TRUE(
      has(part_refusal("<collision><geometry><mesh filename='t.obj' scale='0 1 1'/></geometry></collision>"), "scale"));
}

/// An STL file of 2 n² triangles; `corner(i, j)` of a sphere's grid.
void write_fine_sphere(const std::string& path, std::uint32_t n) {
  std::ofstream stl(path, std::ios::binary);
  const auto corner = [&](std::uint32_t i, std::uint32_t j) {
    const double down = M_PI * i / n, around = 2.0 * M_PI * (j % n) / n;
    const double across = i % n == 0 ? 0.0 : std::sin(down);
    return Eigen::Vector3f(
        Vector3d(across * std::cos(around), across * std::sin(around), std::cos(down)).cast<float>());
  };
  const auto write = [&](const auto& value) { stl.write(reinterpret_cast<const char*>(&value), sizeof value); };
  stl << std::string(80, ' ');
  write(2 * n * n);
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      for (const int half : {0, 1}) {
        write(Eigen::Vector3f(Eigen::Vector3f::Zero()));
        write(corner(i, j));
        write(half == 0 ? corner(i + 1, j) : corner(i + 1, j + 1));
        write(half == 0 ? corner(i + 1, j + 1) : corner(i, j + 1));
        write(std::uint16_t{0});
      }
    }
  }
}

TEST_F(LoadScene, AMillionTrianglesLoad) {
  const std::uint32_t n = 707;
  write_fine_sphere(folder_.path("fine.stl"), n);
  const Scene scene = load_part("<collision><geometry><mesh filename='fine.stl'/></geometry></collision>");
  const geometry::MeshPtr mesh = std::get<geometry::MeshPtr>(scene.bodies[0].collision[0].geometry);
  EXPECT_EQ(mesh->triangles.size(), 2 * n * n - 2 * n) << "all but those that are flat at the poles";
  EXPECT_NEAR(geometry::volume_properties(mesh).volume, 4.0 / 3.0 * M_PI, 1e-4);
  EXPECT_TRUE(scene.warnings.empty());
}

TEST_F(LoadScene, MoreThanAMillionTrianglesAreRefused) {
  std::ofstream stl(folder_.path("big.stl"), std::ios::binary);
  const std::uint32_t count = 1000001;
  stl << std::string(80, ' ');
  stl.write(reinterpret_cast<const char*>(&count), sizeof count);
  const std::vector<char> triangle(50, 0);
  for (std::uint32_t i = 0; i < count; ++i) stl.write(triangle.data(), 50);
  stl.close();
  EXPECT_TRUE(has(part_refusal("<collision><geometry><mesh filename='big.stl'/></geometry></collision>"), "1000000"));
}

/// An STL file of which all triangles but one are flat.
void write_flat_stl(const std::string& path, std::uint32_t triangles) {
  std::ofstream stl(path, std::ios::binary);
  stl << std::string(80, ' ');
  stl.write(reinterpret_cast<const char*>(&triangles), sizeof triangles);
  const std::array<float, 12> corners{0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0};
  stl.write(reinterpret_cast<const char*>(corners.data()), sizeof corners).write("\0", 2);
  const std::vector<char> flat(50 * (triangles - 1), 0);
  stl.write(flat.data(), static_cast<std::streamsize>(flat.size()));
}

std::string drawn_mesh(const std::string& name, const std::string& scale) {
  return "<visual><geometry><mesh filename='" + name + "' scale='" + scale + "'/></geometry></visual>";
}

/// One file at three scales is three meshes.
TEST_F(LoadScene, AScenesMeshesHaveABudget) {
  write_flat_stl(folder_.path("half.stl"), 700000);
  const auto mesh = [](const std::string& scale) { return drawn_mesh("half.stl", scale); };
  EXPECT_EQ(load_part(unit_box + mesh("1 1 1") + mesh("2 2 2")).bodies.size(), 1u);
  const std::string refusal = part_refusal(unit_box + mesh("1 1 1") + mesh("2 2 2") + mesh("3 3 3"));
  EXPECT_TRUE(has(refusal, "triangles of the scene")) << refusal;
  EXPECT_TRUE(has(refusal, "2000000")) << refusal;
}

/// What is in the scene when an object is added counts, each mesh once.
TEST_F(LoadScene, TheMeshesOfAddedObjectsCountInTheScenesBudget) {
  write_flat_stl(folder_.path("half.stl"), 700000);
  write_mesh("mug.urdf", "<robot name='m'><link name='base'>" + inertial("1", "0.01 0.01 0.01") + unit_box +
                             drawn_mesh("half.stl", "1 1 1") + "</link></robot>");
  geometry::TriangleMesh mesh;
  mesh.vertices = {Vector3d::Zero(), Vector3d::UnitX(), Vector3d::UnitY()};
  mesh.triangles.assign(700000, Eigen::Vector3i(0, 1, 2));
  const auto shape = [&] { return geometry::Shape{std::make_shared<const geometry::TriangleMesh>(mesh)}; };
  Scene scene = load_part(unit_box);
  scene.bodies[0].collision = {shape()};
  scene.bodies[0].visual = scene.bodies[0].collision;
  const auto add = [&]() -> std::string {
    try {
      read_object("mug", folder_.path("mug.urdf"), {}, scene, {}, "test");
    } catch (const validation::InputError& refusal) {
      return refusal.what();
    }
    return "(added)";
  };
  EXPECT_EQ(add(), "(added)");
  scene.bodies.emplace_back();
  scene.bodies[1].visual = {shape()};
  const std::string refusal =
      "mug.urdf:1: link 'base': half.stl: triangles of the scene: expected at most 2000000, got ";
  EXPECT_TRUE(has(add(), refusal + "2100000"));
  scene.bodies.pop_back();
  EXPECT_EQ(add(), "(added)");
}

TEST_F(LoadScene, MeshesAreReadWithinTheTimeLeftForTheScene) {
  write_mesh("t.obj", tetrahedron_obj);
  double left = 60.0;
  EXPECT_EQ(read_triangles(folder_.path("t.obj"), "test", left).triangles.size(), 4u);
  EXPECT_LT(left, 60.0);
  left = 0.0;
  try {
    read_triangles(folder_.path("t.obj"), "test", left);
    ADD_FAILURE() << "read without time";
  } catch (const validation::InputError& refusal) {
    EXPECT_EQ(refusal.what(),
              "test: mesh: invalid value '" + folder_.path("t.obj") +
                  "': expected a mesh that can be read within 30 s (all meshes of a scene: 60 s) and 2 GiB");
  }
}

TEST_F(LoadScene, PackagesAreFoundByTheFinderAndInRosPackagePath) {
  write_mesh("some_package/package.xml", "<package><name>some_package</name></package>");
  write_mesh("some_package/meshes/t.obj", tetrahedron_obj);
  const std::string mesh =
      "<collision><geometry><mesh filename='package://some_package/meshes/t.obj'/></geometry></collision>";
  EXPECT_TRUE(has(part_refusal(mesh), "package"));
  const char* before = std::getenv("ROS_PACKAGE_PATH");
  const std::string saved = before != nullptr ? before : "";
  setenv("ROS_PACKAGE_PATH", ("/nowhere:" + folder_.path("")).c_str(), 1);
  EXPECT_EQ(std::get<geometry::MeshPtr>(load_part(mesh).bodies[0].collision[0].geometry)->uri,
            "package://some_package/meshes/t.obj");
  EXPECT_EQ(find_package_in_ros_package_path("other_package"), "");
  write_mesh("shelf/of/third_package/package.xml", "<package><name>third_package</name></package>");
  write_mesh("shelf/of/many/fourth_package/package.xml", "<package><name>fourth_package</name></package>");
  EXPECT_EQ(find_package_in_ros_package_path("third_package"), folder_.path("shelf/of/third_package"));
  EXPECT_EQ(find_package_in_ros_package_path("fourth_package"), "");
  setenv("ROS_PACKAGE_PATH", folder_.path("some_package").c_str(), 1);
  EXPECT_NE(find_package_in_ros_package_path("some_package"), "");
  setenv("ROS_PACKAGE_PATH", saved.c_str(), 1);
}

TEST_F(LoadScene, ColoursComeFromTheMaterials) {
  const Scene scene = load_part(unit_box +
                                "<visual><geometry><sphere radius='0.1'/></geometry><material name='red'>"
                                "<color rgba='0.5 0.25 0.75 0.125'/></material></visual>");
  ASSERT_EQ(scene.bodies[0].visual.size(), 1u);
  EXPECT_TRUE(scene.bodies[0].visual[0].color.isApprox(Eigen::Vector4d(0.5, 0.25, 0.75, 0.125)));
  EXPECT_TRUE(scene.bodies[0].visual[0].color_given);
  const Scene plain = load_part(unit_box + "<visual><geometry><sphere radius='0.1'/></geometry></visual>");
  EXPECT_FALSE(plain.bodies[0].visual[0].color_given);
  EXPECT_EQ(load_part(unit_box).bodies[0].visual.size(), 1u);
}

// ---- the YAML file

TEST_F(LoadScene, TheYamlAddsWhatUrdfCannotExpress) {
  const Scene scene = load_part(unit_box, R"(
gravity: 1.62
contact: none
tool: spring_probe
force_scale: 2.5
bench_height: -0.1
defaults: {friction: 0.7, restitution: 0.2, density: 800, material_stiffness: 1000}
objects:
  part: {friction: 0.1, material_stiffness: .inf}
targets:
  part: {pose: [1, 2, 3, 0, 0, 0, 2], position_tolerance: 0.02, angle_tolerance: 0.3, max_force: 12,
         grips: [[-0.3, 0, 0.1], [0.4, 0, 0.2]]}
start: {handle: [0.1, 0.2, 0.3, 1, 0, 0, 0], handle_2: [0.5, 0.2, 0.3, 1, 0, 0, 0]}
)");
  EXPECT_EQ(scene.gravity, 1.62);
  EXPECT_EQ(scene.contact, ContactMode::none);
  EXPECT_EQ(scene.tool, "spring_probe");
  EXPECT_EQ(scene.force_scale, 2.5);
  EXPECT_EQ(scene.bench_height, -0.1);
  EXPECT_EQ(scene.bench_material.friction, 0.7);
  EXPECT_EQ(scene.bench_material.stiffness, 1000.0);
  EXPECT_EQ(scene.bodies[0].material.friction, 0.1);
  EXPECT_EQ(scene.bodies[0].material.restitution, 0.2);
  EXPECT_TRUE(std::isinf(scene.bodies[0].material.stiffness));
  EXPECT_TRUE(scene.targets.at("part").X_WL.translation().isApprox(Vector3d(1, 2, 3)));
  EXPECT_TRUE(scene.targets.at("part").X_WL.linear().isIdentity());
  EXPECT_EQ(scene.targets.at("part").angle_tolerance, 0.3);
  EXPECT_EQ(scene.targets.at("part").max_force, 12.0);
  ASSERT_EQ(scene.targets.at("part").p_LG.size(), 2u);
  EXPECT_EQ(scene.targets.at("part").p_LG[1], Vector3d(0.4, 0.0, 0.2));
  ASSERT_EQ(scene.X_WH_start.size(), 2u);
  EXPECT_EQ(scene.X_WH_start[1].translation(), Vector3d(0.5, 0.2, 0.3));
  EXPECT_TRUE(scene.X_WH_start.front().linear().isApprox(Matrix3d(Vector3d(1, -1, -1).asDiagonal())));
  EXPECT_EQ(scene.name, "scene");
}

TEST_F(LoadScene, BadYamlIsRefusedWithLineAndKey) {
  for (const auto& [yaml, place, key] : std::vector<std::tuple<std::string, std::string, std::string>>{
           {"gravity: -1", ":1:", "gravity"},
           {"gravity: .nan", ":1:", "gravity"},
           {"gravity: 1e300", ":1:", "gravity"},
           {"\n\nspeed: 1", ":3:", "speed"},
           {"contact: yes", ":1:", "contact"},
           {"tool: fork", ":1:", "tool"},
           {"force_scale: 0", ":1:", "force_scale"},
           {"force_scale: 1e300", ":1:", "force_scale"},
           {"defaults: {density: 0}", ":1:", "defaults.density"},
           {"defaults: {restitution: 1.5}", ":1:", "defaults.restitution"},
           {"defaults: {colour: red}", ":1:", "defaults.colour"},
           {"objects:\n  part: {friction: -0.1}", ":2:", "objects.part.friction"},
           {"objects:\n  nobody: {friction: 0.1}", ":2:", "nobody"},
           {"objects: [1, 2]", ":1:", "objects"},
           {"objects:\n  part: {friction: 0.1}\n  part: {friction: 0.2}", ":3:", "objects.part: given twice"},
           {"targets: {part: {pose: [0, 0, 0, 0, 0, 0, 1]},\n  part: {pose: [1, 0, 0, 0, 0, 0, 1]}}",
            ":2:", "targets.part: given twice"},
           {"gravity: 1\n---\ngravity: 2", ": contains several YAML documents", "expected one"},
           {"objects:\n  part: {pose: [0, 0, 0, 0, 0, 0, 1]}", ":2:", "objects.part.pose"},
           {"objects:\n  mug: {urdf: nothing.urdf}", ":2:", "objects.mug.urdf"},
           {"targets:\n  nobody: {pose: [0, 0, 0, 0, 0, 0, 1]}", ":2:", "nobody"},
           {"targets:\n  part: {position_tolerance: 1}", ":", "targets.part.pose"},
           {"targets:\n  part: {pose: [0, 0, 0, 0, 0, 0, 0]}", ":2:", "targets.part.pose"},
           {"targets:\n  part: {pose: [0, 0, 0, 0, 0, 0, 1], max_force: 0}", ":2:", "targets.part.max_force"},
           {"targets:\n  part: {pose: [0, 0, 0, 0, 0, 0, 1], grips: 3}", ":2:", "targets.part.grips"},
           {"targets:\n  part: {pose: [0, 0, 0, 0, 0, 0, 1], grips: [[0, 0, 0], [1, 0, 0]]}", ":2:", "part.grips"},
           {"start: {hand: 1}", ":1:", "start.hand"},
           {"start: {handle_2: [0, 0, 0, 0, 0, 0, 1]}", ":", "start.handle"},
           {"a: [", ":", "YAML"}}) {
    const std::string message = part_refusal(unit_box, yaml);
    EXPECT_TRUE(has(message, "scene.yaml" + place)) << yaml;
    EXPECT_TRUE(has(message, key)) << yaml;
  }
}

TEST_F(LoadScene, TheYamlAddsObjectsByTheirOwnUrdf) {
  write_mesh("mug.urdf",
             "<robot name='m'><link name='base'>" + inertial("1", "0.01 0.01 0.01") + unit_box + "</link></robot>");
  const Scene scene = load_part(unit_box,
                                "objects:\n  cup: {urdf: mug.urdf, pose: [0.5, 0, 1, 0, 0, 0, 1], friction: 0.9}\n"
                                "  mug: {urdf: mug.urdf}\n");
  ASSERT_EQ(scene.bodies.size(), 3u);
  const Body& cup = scene.bodies[*find_body(scene, "cup")];
  EXPECT_TRUE(cup.movable);
  EXPECT_EQ(cup.material.friction, 0.9);
  EXPECT_TRUE((cup.X_WO * cup.X_OL).translation().isApprox(Vector3d(0.5, 0, 1)));
  EXPECT_NEAR(scene.bodies[*find_body(scene, "mug")].X_WO.translation().z(), 0.1, 1e-12);
  EXPECT_FALSE(find_body(scene, "base"));
}

TEST_F(LoadScene, TwoObjectsOfOneNameAreRefused) {
  write_mesh("mug.urdf",
             "<robot name='m'><link name='base'>" + inertial("1", "0.01 0.01 0.01") + unit_box + "</link></robot>");
  EXPECT_TRUE(has(part_refusal(unit_box, "objects: {part: {urdf: mug.urdf}}"), "part"));
}

TEST_F(LoadScene, AnObjectWithTheNameOfAFrameIsRefused) {
  write_mesh("mug.urdf",
             "<robot name='m'><link name='base'>" + inertial("1", "0.01 0.01 0.01") + unit_box + "</link></robot>");
  for (const std::string name : {"workbench", "stylus", "stylus_2", "head", "head_2", "eye_left", "eye_right_2",
                                 "fork_handle", "fork_tip", "fork_tip_12"}) {
    const std::string joint =
        "<joint name='j' type='floating'><parent link='world'/><child link='" + name + "'/></joint>";
    EXPECT_TRUE(
        has(refusal("<link name='world'/><link name='" + name + "'>" + unit_box + "</link>" + joint),
            "link '" + name + "': name: invalid value '" + name + "': expected a name that is not that of a frame"));
    EXPECT_TRUE(
        has(part_refusal(unit_box, "objects: {" + name + ": {urdf: mug.urdf}}"),
            "scene.yaml:1: objects: invalid value '" + name + "': expected a name that is not that of a frame"));
    EXPECT_THROW(read_object(name, folder_.path("mug.urdf"), {}, load_part(unit_box), {}, "test"),
                 validation::InputError);
  }
  EXPECT_EQ(load_part(unit_box, "objects: {head_rest: {urdf: mug.urdf}}").bodies.size(), 2u);
  const std::string fixed = "<joint name='j' type='fixed'><parent link='world'/><child link='head'/></joint>";
  EXPECT_EQ(load("<link name='world'/><link name='head'>" + unit_box + "</link>" + fixed).bodies.size(), 1u);
}

TEST_F(LoadScene, WhatXacroWouldReplaceIsRefused) {
  const std::string start = "<link name='world'/><link name='part'>" + unit_box, end = "</link>" + floating_joint;
  EXPECT_TRUE(has(refusal("<xacro:property name='w' value='0.1'/>" + start + end),
                  "scene.urdf:2: xacro:property: expected a URDF without elements of xacro"));
  EXPECT_TRUE(has(refusal(start + "\n<xacro:unit_mass/>" + end), "scene.urdf:3: xacro:unit_mass: "));
}

TEST_F(LoadScene, TheYamlNextToItMayEndInYml) {
  load_part(unit_box);
  folder_.write("scene.yml", "gravity: 1");
  const std::string urdf = folder_.path("scene.urdf");
  try {
    load_scene(urdf);
    ADD_FAILURE() << "loaded with both files";
  } catch (const validation::InputError& error) {
    EXPECT_TRUE(has(error.what(), "scene.urdf: YAML file: there are two next to it, .yaml and .yml: remove one"));
  }
  std::filesystem::remove(folder_.path("scene.yaml"));
  Scene scene = load_scene(urdf);
  EXPECT_EQ(scene.gravity, 1.0);
  scene.gravity = 2.0;
  save_scene(scene, urdf, {});
  EXPECT_EQ(load_scene(urdf).gravity, 2.0);
}

TEST_F(LoadScene, LoadsTheSameFromManyThreads) {
  load_part("<inertial><mass value='2'/></inertial>" + unit_box);
  std::vector<std::thread> threads;
  std::array<std::size_t, 8> warnings{};
  for (std::size_t& count : warnings) {
    threads.emplace_back([&] { count = load_scene(folder_.path("scene.urdf")).warnings.size(); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::size_t count : warnings) EXPECT_EQ(count, 1u);
}

const std::string one_link = "<robot name='r'><link name='a'/></robot>";

std::string refusal_from(const std::string& path, const std::vector<std::string>& roots) {
  try {
    load_scene(path, roots);
  } catch (const validation::InputError& e) {
    return e.what();
  }
  return "(loaded)";
}

/// A FIFO does not block, neither a device nor a huge file is read, and no link leads out of the allowed folders.
TEST_F(LoadScene, TheYamlNextToItIsRestrictedToTheSameFolders) {
  folder_.write("allowed/scene.urdf", "<robot name='test'><link name='world'/></robot>");
  folder_.write("secret.yaml", "password: 1");
  const std::vector<std::string> roots = {folder_.path("allowed")};
  const std::string yaml = folder_.path("allowed/scene.yaml");
  const auto refusal_within = [&](const std::vector<std::string>& folders) {
    const std::string text = refusal_from(folder_.path("allowed/scene.urdf"), folders);
    std::filesystem::remove(yaml);
    return text;
  };
  const auto refusal = [&] { return refusal_within(roots); };
  EXPECT_EQ(refusal(), "(loaded)");
  ASSERT_EQ(mkfifo(yaml.c_str(), 0600), 0);
  EXPECT_TRUE(has(refusal(), "a readable file ("));
  folder_.write("allowed/scene.yaml", "");
  std::filesystem::resize_file(yaml, std::uintmax_t{2} << 30);
  EXPECT_TRUE(has(refusal(), "the YAML file next to it: invalid value '" + yaml +
                                 "': expected a file of at most 256 MiB, got 2048 MiB"));
  std::filesystem::create_symlink("/dev/zero", yaml);
  EXPECT_TRUE(has(refusal_within({}), "not a regular file"));
  for (const auto& [target, rule] :
       {std::pair("/dev/zero", "one of the folders"), {"/nowhere", "No such file or directory"}}) {
    std::filesystem::create_symlink(target, yaml);
    EXPECT_TRUE(has(refusal(), rule));
  }
  std::filesystem::create_symlink(folder_.path("secret.yaml"), yaml);
  const std::string text = refusal();
  EXPECT_TRUE(has(text, "one of the folders"));
  EXPECT_EQ(text.find("password"), std::string::npos);
}

TEST_F(LoadScene, ReadsFromTheFoldersAllowedAndFromPackagesAlone) {
  folder_.write("allowed/scene.urdf", one_link);
  folder_.write("elsewhere/scene.urdf", one_link);
  folder_.write("elsewhere/t.obj", tetrahedron_obj);
  folder_.write("allowed/up.urdf",
                "<robot name='r'><link name='a'><collision><geometry><mesh filename='../elsewhere/t.obj'/>"
                "</geometry></collision></link></robot>");
  std::filesystem::create_symlink(folder_.path("elsewhere/scene.urdf"), folder_.path("allowed/link.urdf"));
  const std::vector<std::string> roots = {folder_.path("nowhere"), folder_.path("allowed")};
  EXPECT_EQ(refusal_from(folder_.path("allowed/scene.urdf"), roots), "(loaded)");
  for (const std::string path :
       {"elsewhere/scene.urdf", "allowed/../elsewhere/scene.urdf", "allowed/link.urdf", "allowed/up.urdf"}) {
    EXPECT_TRUE(has(refusal_from(folder_.path(path), roots), "one of the folders")) << path;
    EXPECT_EQ(refusal_from(folder_.path(path), {}), "(loaded)") << path;
  }
  for (const std::string mesh : {"t.obj", "nothing.obj"}) {  // nor does a mesh that is only drawn disclose them
    folder_.write("allowed/drawn.urdf",
                  "<robot name='r'><link name='a'><visual><geometry><mesh filename='../elsewhere/" + mesh +
                      "'/></geometry></visual></link></robot>");
    EXPECT_TRUE(has(refusal_from(folder_.path("allowed/drawn.urdf"), roots), "one of the folders")) << mesh;
  }
  folder_.write("elsewhere/package.xml", "<package><name>somewhere_else</name></package>");
  const char* before = std::getenv("ROS_PACKAGE_PATH");
  const std::string saved = before != nullptr ? before : "";
  setenv("ROS_PACKAGE_PATH", folder_.path("").c_str(), 1);
  EXPECT_EQ(refusal_from(folder_.path("elsewhere/scene.urdf"), roots), "(loaded)");
  EXPECT_EQ(refusal_from("package://somewhere_else/scene.urdf", roots), "(loaded)");
  // Files outside are not disclosed: the message is the same whether they exist or not.
  for (const std::string name : {"nothing.urdf", "elsewhere"})
    EXPECT_TRUE(has(refusal_from("package://somewhere_else/../" + name, roots), "one of the folders"));
  setenv("ROS_PACKAGE_PATH", saved.c_str(), 1);
}

// Files crafted to exhaust time or memory.
TEST_F(LoadScene, RefusesHostileFiles) {
  std::string deep = "<robot name='r'>";
  for (int i = 0; i < 1000000; ++i) deep += "<a>";
  folder_.write("deep.urdf", deep);
  EXPECT_TRUE(has(refusal_from(folder_.path("deep.urdf"), {}), "nesting"));

  // What a scanner that is not TinyXML's own takes for closed: ends in a comment, and in an attribute.
  std::string ends, hidden;
  for (int i = 0; i < 3000; ++i) {
    ends += "</a>";
    hidden += "<a b='/>'>";
  }
  folder_.write("comment.urdf", "<robot name='r'><!-- " + ends + " -->" + deep.substr(16, 9000));
  EXPECT_TRUE(has(refusal_from(folder_.path("comment.urdf"), {}), "nesting"));
  folder_.write("attribute.urdf", "<robot name='r'>" + hidden);
  EXPECT_TRUE(has(refusal_from(folder_.path("attribute.urdf"), {}), "nesting"));

  std::string chain = "<robot name='r'><link name='l0'/>";
  for (int i = 1; i < 10002; ++i) {
    const std::string a = std::to_string(i - 1), b = std::to_string(i);
    chain += "<link name='l" + b + "'/><joint name='j" + b + "' type='fixed'><parent link='l" + a +
             "'/><child link='l" + b + "'/></joint>";
  }
  folder_.write("chain.urdf", chain + "</robot>");
  EXPECT_TRUE(has(refusal_from(folder_.path("chain.urdf"), {}), "links"));

  std::string bomb = "<!DOCTYPE r [<!ENTITY a0 'ha'>";
  for (int i = 1; i < 40; ++i) {
    const std::string a = "&a" + std::to_string(i - 1) + ";";
    bomb += "<!ENTITY a" + std::to_string(i) + " '" + a + a + "'>";
  }
  folder_.write("bomb.urdf", bomb + "]><robot name='&a39;'><link name='a'/></robot>");
  EXPECT_FALSE(has(refusal_from(folder_.path("bomb.urdf"), {}), "(loaded)"));

  folder_.write("large.urdf", one_link);
  std::filesystem::resize_file(folder_.path("large.urdf"), std::uintmax_t{1} << 31);
  EXPECT_TRUE(has(refusal_from(folder_.path("large.urdf"), {}), "MiB"));

  EXPECT_TRUE(has(refusal("<link name='a'/>", "gravity: " + std::string(100000, '[')), "not YAML"));
  std::string aliases = "a0: &a0 [1, 1]\n";
  for (int i = 1; i < 60; ++i) {
    const std::string a = "*a" + std::to_string(i - 1);
    aliases += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + a + ", " + a + "]\n";
  }
  EXPECT_TRUE(has(refusal("<link name='a'/>", aliases), "size"));
  EXPECT_TRUE(
      has(refusal("<link name='a'/>", "objects:\n  b:\n    " + std::string("pose: &a [&b [1, 1], *b]\n")), "pose"));
}

std::string collada(const std::string& nodes, const std::string& library = "", const std::string& count = "12") {
  return "<COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' version='1.4.1'><library_geometries><geometry "
         "id='g'><mesh>"
         "<source id='p'><float_array id='pa' count='" +
         count +
         "'>0 0 0 1 0 0 0 1 0 0 0 1</float_array><technique_common>"
         "<accessor source='#pa' count='4' stride='3'><param name='X' type='float'/><param name='Y' type='float'/>"
         "<param name='Z' type='float'/></accessor></technique_common></source><vertices id='v'>"
         "<input semantic='POSITION' source='#p'/></vertices><triangles count='4'><input semantic='VERTEX' source='#v' "
         "offset='0'/>"
         "<p>0 2 1 0 1 3 1 2 3 0 3 2</p></triangles></mesh></geometry></library_geometries><library_nodes>" +
         library + "</library_nodes><library_visual_scenes><visual_scene id='s'>" + nodes +
         "</visual_scene></library_visual_scenes><scene><instance_visual_scene url='#s'/></scene></COLLADA>";
}

// Each would crash or hang an unprotected reader.
TEST_F(LoadScene, RefusesHostileMeshes) {
  const auto response = [&](const std::string& name) {
    folder_.write("scene.urdf", "<robot name='r'><link name='a'><collision><geometry><mesh filename='" + name +
                                    "'/></geometry>"
                                    "</collision></link></robot>");
    return refusal_from(folder_.path("scene.urdf"), {});
  };
  const std::string part = "<instance_geometry url='#g'/>";
  folder_.write("good.dae", collada("<node id='n'>" + part + "</node>"));
  EXPECT_EQ(response("good.dae"), "(loaded)");
  folder_.write("count.dae", collada("<node id='n'>" + part + "</node>", "", "4000000000"));
  EXPECT_TRUE(has(response("count.dae"), "expected a readable mesh"));

  std::string deep, end;
  for (int i = 0; i < 300000; ++i) {
    deep += "<node id='n" + std::to_string(i) + "'>";
    end += "</node>";
  }
  folder_.write("deep.dae", collada(deep + part + end));
  EXPECT_TRUE(has(response("deep.dae"), "expected a mesh that can be read"));
  folder_.write("loop.dae",
                collada("<node id='n'><instance_node url='#a'/></node>",
                        "<node id='a'><instance_node url='#b'/></node><node id='b'><instance_node url='#a'/></node>"));
  EXPECT_TRUE(has(response("loop.dae"), "expected a mesh that can be read"));
  std::string doubled = "<node id='m0'>" + part + "</node>";
  for (int i = 1; i < 40; ++i) {
    const std::string of = "<instance_node url='#m" + std::to_string(i - 1) + "'/>";
    doubled += "<node id='m" + std::to_string(i) + "'>" + of + of + "</node>";
  }
  folder_.write("doubled.dae", collada("<node id='n'><instance_node url='#m39'/></node>", doubled));
  EXPECT_TRUE(has(response("doubled.dae"), "expected a readable mesh"));

  // A file of materials that never ends: it is not opened.
  ASSERT_EQ(mkfifo(folder_.path("pipe").c_str(), 0600), 0);
  folder_.write("materials.obj", "mtllib pipe\nmtllib " + folder_.path("pipe") + "\n" + std::string(tetrahedron_obj));
  EXPECT_EQ(response("materials.obj"), "(loaded)");
}

}  // namespace
}  // namespace spring_workbench::scene::load_scene_test
