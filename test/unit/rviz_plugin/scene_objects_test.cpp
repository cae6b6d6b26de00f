#include "src/rviz_plugin/scene_objects.h"

#include <OgreEntity.h>
#include <OgreSubEntity.h>
#include <OgreTechnique.h>
#include <gtest/gtest.h>

#include <boost/make_shared.hpp>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "ogre.h"
#include "spring_workbench/fork_mesh/constants.h"
#include "spring_workbench/fork_mesh/load_color.h"
#include "spring_workbench/validation/input_error.h"
#include "src/rviz_plugin/constants.h"
#include "support/temporary_folder.h"

namespace spring_workbench::rviz_plugin::scene_objects_test {
namespace {

const double nan = std::numeric_limits<double>::quiet_NaN();

ShapeDescription shape_of(std::uint8_t type) {
  ShapeDescription shape;
  shape.type = type;
  shape.pose.position.x = 0.1;
  shape.pose.orientation.w = 1.0;
  shape.size.x = shape.size.y = 0.2;
  shape.size.z = 0.3;
  shape.color.r = 0.8F;
  shape.color.a = 1.0F;
  return shape;
}

BodyDescription body_of(const std::string& name, bool movable, std::uint8_t type) {
  BodyDescription body;
  body.name = name;
  body.movable = movable ? 1 : 0;
  body.pose.orientation.w = 1.0;
  body.pose.position.z = 1.0;
  body.visual = {shape_of(type)};
  return body;
}

/// A fixed table and movable objects of every kind.
SceneDescription scene_of_all() {
  SceneDescription scene;
  scene.bodies = {body_of("table", false, ShapeDescription::BOX), body_of("box", true, ShapeDescription::BOX),
                  body_of("ball", true, ShapeDescription::SPHERE), body_of("rod", true, ShapeDescription::CYLINDER),
                  body_of("mesh", true, ShapeDescription::MESH)};
  scene.bodies[1].visual.push_back(shape_of(ShapeDescription::SPHERE));
  scene.meshes.resize(1);
  scene.meshes[0].vertices = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  scene.meshes[0].triangles = {0, 1, 2};
  return scene;
}

ObjectStates states_of(const SceneDescription& scene, std::mt19937& random) {
  std::normal_distribution<double> normal;
  ObjectStates states;
  for (const BodyDescription& body : scene.bodies) {
    if (body.movable == 0) continue;
    ObjectState state;
    state.name = body.name;
    state.pose.position.x = normal(random);
    state.pose.position.y = normal(random);
    state.pose.position.z = normal(random);
    const Quaterniond q = Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
    state.pose.orientation.w = q.w();
    state.pose.orientation.x = q.x();
    state.pose.orientation.y = q.y();
    state.pose.orientation.z = q.z();
    states.objects.push_back(state);
  }
  return states;
}

Ogre::Entity* entity_of(const SceneObjects& objects, const std::string& name) {
  const auto* part =
      dynamic_cast<const Ogre::SceneNode*>(const_cast<Ogre::SceneNode*>(objects.node(name))->getChild(0));
  return dynamic_cast<Ogre::Entity*>(const_cast<Ogre::SceneNode*>(part)->getAttachedObject(0));
}

Ogre::ColourValue color_of(const SceneObjects& objects, const std::string& name) {
  return entity_of(objects, name)->getSubEntity(0)->getMaterial()->getTechnique(0)->getPass(0)->getDiffuse();
}

/// Describes the bodies and builds all of them.
void describe(SceneObjects& objects, const SceneDescription& scene) {
  objects.describe(boost::make_shared<const SceneDescription>(scene));
  while (!objects.build(0.0)) std::this_thread::yield();
}

class SceneObjectsTest : public Ogre3d {
 protected:
  std::mt19937 random_{7};
};

TEST_F(SceneObjectsTest, NodesAreAtThePosesOfTheMessage) {
  SceneObjects objects(manager_, parent_);
  const SceneDescription scene = scene_of_all();
  describe(objects, scene);
  EXPECT_EQ(objects.node("table")->getPosition(), Ogre::Vector3(0, 0, 1));
  for (int i = 0; i < 100; ++i) {
    const ObjectStates states = states_of(scene, random_);
    objects.place(states);
    parent_->_update(true, true);  // as a frame does
    for (const ObjectState& state : states.objects) {
      const Ogre::SceneNode* node = objects.node(state.name);
      const auto& p = state.pose.position;
      const auto& q = state.pose.orientation;
      const RigidTransform X_WO = make_transform(Vector3d(p.x, p.y, p.z), Quaterniond(q.w, q.x, q.y, q.z));
      EXPECT_NEAR(static_cast<double>(node->getPosition().x), p.x, 1e-6);
      EXPECT_NEAR(static_cast<double>(node->getPosition().y), p.y, 1e-6);
      EXPECT_NEAR(static_cast<double>(node->getPosition().z), p.z, 1e-6);
      EXPECT_NEAR(static_cast<double>(node->getOrientation().w), q.w, 1e-6);
      EXPECT_NEAR(static_cast<double>(node->getOrientation().x), q.x, 1e-6);
      const Ogre::Vector3 shape = entity_of(objects, state.name)->getParentNode()->_getDerivedPosition();
      const Vector3d expected = X_WO * Vector3d(0.1, 0.0, 0.0);
      EXPECT_NEAR(static_cast<double>(shape.x), expected.x(), 1e-5);
      EXPECT_NEAR(static_cast<double>(shape.z), expected.z(), 1e-5);
    }
  }
}

TEST_F(SceneObjectsTest, ShapesHaveTheirSize) {
  SceneObjects objects(manager_, parent_);
  describe(objects, scene_of_all());
  for (const std::string name : {"table", "box", "ball", "rod"}) {
    const Ogre::Vector3 size = entity_of(objects, name)->getWorldBoundingBox(true).getSize();
    EXPECT_NEAR(size.x, 0.2F, 0.01F) << name;
    EXPECT_NEAR(size.y, 0.2F, 0.01F) << name;
    EXPECT_NEAR(size.z, 0.3F, 0.01F) << name;
  }
}

/// A square and a triangle as Wavefront files have them: green, and with a picture of two by two pixels.
std::string write_file_with_colors(const test_support::TemporaryFolder& folder) {
  std::string picture("BM\x46\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\2\0\0\0\2\0\0\0\1\0\x18\0", 30);
  picture += std::string(24, '\0') + std::string("\xff\xff\xff\x10\x10\xf0\0\0\x10\x10\xf0\xff\xff\xff\0\0", 16);
  folder.write("checks.bmp", picture);
  folder.write("thing.mtl", "newmtl green\nKd 0.1 0.9 0.2\nnewmtl checks\nKd 1 1 1\nmap_Kd checks.bmp\n");
  folder.write("thing.obj",
               "mtllib thing.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
               "usemtl green\nf 1 2 5\nusemtl checks\nf 1/1 2/2 3/3 4/4\n");
  return "file://" + folder.path("thing.obj");
}

/// The colours and textures of a file stay while the object is lit or translucent; what was made for it is freed.
TEST_F(SceneObjectsTest, AMeshFileHasItsOwnColours) {
  const test_support::TemporaryFolder folder;
  SceneDescription scene = scene_of_all();
  scene.meshes[0].uri = write_file_with_colors(folder);
  ShapeDescription& shape = scene.bodies[4].visual[0];
  shape.file_colors = 1;
  shape.size.x = shape.size.y = shape.size.z = 2.0;
  SceneObjects objects(manager_, parent_);
  describe(objects, scene);  // rviz keeps what it has read
  objects.clear();
  const Counts before = counts();
  describe(objects, scene);
  const Ogre::Entity* entity = entity_of(objects, "mesh");
  ASSERT_EQ(entity->getNumSubEntities(), 2u);
  const auto pass = [&](unsigned i) { return entity->getSubEntity(i)->getMaterial()->getTechnique(0)->getPass(0); };
  const unsigned green = pass(0)->getNumTextureUnitStates() == 0 ? 0 : 1, checks = 1 - green;
  EXPECT_EQ(pass(green)->getNumTextureUnitStates(), 0);
  EXPECT_EQ(pass(checks)->getNumTextureUnitStates(), 1);
  EXPECT_NEAR(pass(green)->getDiffuse().g, 0.9F, 1e-3F);
  EXPECT_NEAR(entity->getWorldBoundingBox(true).getSize().x, 2.0F, 0.1F);  // Ogre pads it
  ObjectStates states = states_of(scene, random_);
  ObjectState& state = states.objects.back();
  ASSERT_EQ(state.name, "mesh");
  state.held = 1;
  objects.place(states);
  EXPECT_NEAR(pass(green)->getDiffuse().g, 0.9F, 1e-3F);
  EXPECT_NEAR(pass(checks)->getDiffuse().a, static_cast<float>(fork_mesh::pierced_opacity), 1e-3F);
  EXPECT_EQ(pass(checks)->getNumTextureUnitStates(), 1);
  state.held = 0;
  objects.place(states);
  EXPECT_EQ(pass(checks)->getDiffuse().a, 1.0F);
  objects.clear();
  EXPECT_EQ(counts(), before);
  scene.meshes[0].uri = "file:///nowhere/thing.obj";  // its triangles are there
  describe(objects, scene);
  EXPECT_NEAR(color_of(objects, "mesh").r, 0.8F, 1e-6F);
}

TEST_F(SceneObjectsTest, FramesBuildNothing) {
  SceneObjects objects(manager_, parent_);
  const SceneDescription scene = scene_of_all();
  describe(objects, scene);
  EXPECT_EQ(objects.built(), 6u);
  const Counts before = counts();
  for (int i = 0; i < 1000; ++i) {
    ObjectStates states = states_of(scene, random_);
    states.objects[0].highlighted = i % 2 == 0 ? 1 : 0;
    objects.place(states);
  }
  EXPECT_EQ(objects.built(), 6u);
  EXPECT_EQ(counts(), before);
}

/// A grid of triangles on the z = 0 plane, side × side × 2 of them.
MeshDescription grid(std::uint32_t side) {
  MeshDescription mesh;
  for (std::uint32_t i = 0; i <= side; ++i) {
    for (std::uint32_t j = 0; j <= side; ++j) {
      for (const std::uint32_t x : {i, j, 0U})
        mesh.vertices.push_back(static_cast<float>(x) / static_cast<float>(side));
    }
  }
  for (std::uint32_t i = 0; i < side; ++i) {
    for (std::uint32_t j = 0; j < side; ++j) {
      const std::uint32_t a = i * (side + 1) + j, b = a + side + 1;
      for (const std::uint32_t corner : {a, b, a + 1, a + 1, b, b + 1}) mesh.triangles.push_back(corner);
    }
  }
  return mesh;
}

/// A mesh of 180,000 triangles and, behind it in the list, other shapes: these are drawn first, and each call without
/// time makes one shape or one piece. Freed at any stage.
TEST_F(SceneObjectsTest, AreBuiltInParts) {
  const Counts before = counts();
  SceneDescription scene = scene_of_all();
  scene.meshes[0] = grid(300);
  std::swap(scene.bodies.front(), scene.bodies.back());
  const std::size_t pieces = (scene.meshes[0].triangles.size() + piece_corners - 1) / piece_corners;
  ASSERT_GT(pieces, 10u);
  for (const std::size_t stop_after : {std::size_t{0}, std::size_t{3}, std::size_t{9}, pieces + 6}) {
    SceneObjects objects(manager_, parent_);
    objects.describe(boost::make_shared<const SceneDescription>(scene));
    std::size_t calls = 0, made = 0;
    Counts last = counts();
    for (bool complete = false; !complete && made < stop_after; ++calls) {
      complete = objects.build(0.0);
      const Counts now = counts();
      EXPECT_LE(now[1], last[1] + 1);  // a mesh
      made += now == last ? 0 : 1;
      last = now;
      if (made == 5) {
        EXPECT_EQ(objects.built(), 5u);  // all but the mesh
      }
    }
    EXPECT_GE(calls, made);
    if (stop_after > pieces) {
      EXPECT_EQ(made, pieces + 6);
      EXPECT_EQ(objects.built(), 6u);
    }
  }
  EXPECT_EQ(counts()[0], before[0]);
  EXPECT_LE(counts()[1], before[1] + 3);  // rviz' own cube, sphere and cylinder stay loaded
  EXPECT_EQ(counts()[2], before[2]);
  EXPECT_EQ(counts()[3], before[3]);
}

/// Half a million triangles take many frames.
TEST_F(SceneObjectsTest, AFrameBuildsForAShortTime) {
  SceneDescription scene = scene_of_all();
  scene.meshes[0] = grid(500);
  SceneObjects objects(manager_, parent_);
  objects.describe(boost::make_shared<const SceneDescription>(scene));
  const std::size_t meshes = counts()[1];
  while (counts()[1] < meshes + 4) objects.build(0.0);  // the other shapes may need three, and the normals are there
  int frames = 1;
  while (!objects.build(build_time)) ++frames;
  EXPECT_GT(frames, 2);
}

/// What is added later looks like the rest of its body.
TEST_F(SceneObjectsTest, ALatePartIsLitAndHiddenLikeItsBody) {
  SceneObjects objects(manager_, parent_);
  const SceneDescription scene = scene_of_all();
  objects.describe(boost::make_shared<const SceneDescription>(scene));
  ObjectStates states = states_of(scene, random_);
  states.objects[0].highlighted = 1;
  states.objects.pop_back();  // the mesh
  objects.place(states);
  while (!objects.build(0.0)) std::this_thread::yield();
  EXPECT_NE(color_of(objects, "box").b, 0.0F);
  EXPECT_TRUE(entity_of(objects, "box")->getVisible());
  EXPECT_FALSE(entity_of(objects, "mesh")->getVisible());
  objects.place(states_of(scene, random_));
  EXPECT_TRUE(entity_of(objects, "mesh")->getVisible());
}

TEST_F(SceneObjectsTest, EverythingIsFreed) {
  const Counts before = counts();
  {
    SceneObjects objects(manager_, parent_);
    describe(objects, scene_of_all());
    const Counts with = counts();
    for (std::size_t i = 0; i < with.size(); ++i) EXPECT_GT(with[i], before[i]);
    for (int i = 0; i < 20; ++i) describe(objects, scene_of_all());
    EXPECT_EQ(counts()[0], with[0]);
    EXPECT_EQ(counts()[2], with[2]);
    EXPECT_EQ(counts()[3], with[3]);
  }
  const Counts after = counts();
  EXPECT_EQ(after[0], before[0]);
  EXPECT_LE(after[1], before[1] + 3);  // rviz' own cube, sphere and cylinder stay loaded
  EXPECT_EQ(after[2], before[2]);
  EXPECT_EQ(after[3], before[3]);
}

TEST_F(SceneObjectsTest, FollowAnotherDescription) {
  SceneObjects objects(manager_, parent_);
  SceneDescription scene = scene_of_all();
  describe(objects, scene);
  scene.bodies.erase(scene.bodies.begin() + 1);                         // removed
  scene.bodies.push_back(body_of("new", true, ShapeDescription::BOX));  // added
  scene.bodies[0].visual[0].size.x = 0.7;                               // changed
  describe(objects, scene);
  EXPECT_EQ(objects.bodies(), 5u);
  EXPECT_EQ(objects.node("box"), nullptr);
  ASSERT_NE(objects.node("new"), nullptr);
  EXPECT_NEAR(entity_of(objects, "table")->getWorldBoundingBox(true).getSize().x, 0.7F, 1e-5F);
}

TEST_F(SceneObjectsTest, MovableOnesAreSeenWhileTheMessageNamesThem) {
  SceneObjects objects(manager_, parent_);
  const SceneDescription scene = scene_of_all();
  describe(objects, scene);
  EXPECT_TRUE(entity_of(objects, "table")->getVisible());
  EXPECT_FALSE(entity_of(objects, "box")->getVisible());
  ObjectStates states = states_of(scene, random_);
  objects.place(states);
  EXPECT_TRUE(entity_of(objects, "box")->getVisible());
  states.objects.erase(states.objects.begin());
  states.objects[0].name = "not described yet";
  objects.place(states);
  EXPECT_FALSE(entity_of(objects, "box")->getVisible());
  EXPECT_FALSE(entity_of(objects, "ball")->getVisible());
  EXPECT_TRUE(entity_of(objects, "rod")->getVisible());
  EXPECT_TRUE(entity_of(objects, "table")->getVisible());
}

TEST_F(SceneObjectsTest, WhatWouldBeGraspedLightsUp) {
  SceneObjects objects(manager_, parent_);
  const SceneDescription scene = scene_of_all();
  describe(objects, scene);
  ObjectStates states = states_of(scene, random_);
  const Vector3d lit = fork_mesh::highlighted(Vector3d(0.8, 0.0, 0.0));
  for (const bool on : {false, true, true, false}) {
    states.objects[0].highlighted = on ? 1 : 0;
    objects.place(states);
    EXPECT_NEAR(static_cast<double>(color_of(objects, "box").r), on ? lit.x() : 0.8, 1e-6);
    EXPECT_NEAR(static_cast<double>(color_of(objects, "box").b), on ? lit.z() : 0.0, 1e-6);
    EXPECT_NEAR(static_cast<double>(color_of(objects, "ball").g), 0.0, 1e-6);
    EXPECT_NEAR(static_cast<double>(color_of(objects, "box").a), on ? fork_mesh::pierced_opacity : 1.0, 1e-6);
  }
  states.objects[0].held = 1;
  objects.place(states);
  EXPECT_NEAR(static_cast<double>(color_of(objects, "box").r), 0.8, 1e-6);
  EXPECT_NEAR(static_cast<double>(color_of(objects, "box").a), fork_mesh::pierced_opacity, 1e-6);
}

TEST_F(SceneObjectsTest, WhatCannotBeDrawnIsRefusedAndChangesNothing) {
  SceneObjects objects(manager_, parent_);
  const SceneDescription scene = scene_of_all();
  describe(objects, scene);
  const ObjectStates states = states_of(scene, random_);
  objects.place(states);
  const Counts before = counts();
  const Ogre::Vector3 position = objects.node("box")->getPosition();
  const std::vector<std::function<void(SceneDescription&)>> faults = {
      [](SceneDescription& s) { s.bodies[0].name = "box"; },
      [](SceneDescription& s) { s.bodies[0].pose.position.x = nan; },
      [](SceneDescription& s) { s.bodies[0].pose.position.x = 1e300; },
      [](SceneDescription& s) { s.bodies[0].pose.orientation.w = 0.0; },
      [](SceneDescription& s) { s.bodies[1].visual[0].size.y = nan; },
      [](SceneDescription& s) { s.bodies[1].visual[0].type = 4; },
      [](SceneDescription& s) { s.bodies[1].visual[0].color.a = static_cast<float>(nan); },
      [](SceneDescription& s) { s.bodies[4].visual[0].mesh = 1; },
      [](SceneDescription& s) { s.meshes[0].triangles[1] = 3; },
      [](SceneDescription& s) { s.meshes[0].triangles.pop_back(); },
      [](SceneDescription& s) { s.meshes[0].vertices.pop_back(); },
      [](SceneDescription& s) { s.meshes[0].vertices[2] = static_cast<float>(nan); },
  };
  for (std::size_t i = 0; i < faults.size(); ++i) {
    SceneDescription bad = scene;
    faults[i](bad);
    EXPECT_THROW(describe(objects, bad), validation::InputError) << i;
    EXPECT_EQ(counts(), before) << i;
  }
  ObjectStates bad = states;
  bad.objects[0].pose.position.x += 1.0;
  bad.objects.back().pose.orientation.x = nan;
  EXPECT_THROW(objects.place(bad), validation::InputError);
  EXPECT_EQ(objects.node("box")->getPosition(), position);
  SceneDescription empty_mesh = scene;
  empty_mesh.meshes[0].triangles.clear();
  describe(objects, empty_mesh);  // nothing of it is seen
  objects.place(states);
}

}  // namespace
}  // namespace spring_workbench::rviz_plugin::scene_objects_test
