#include "spring_workbench/ros/markers/markers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "spring_workbench/scene/editing.h"
#include "support/bench_scenes.h"
#include "support/meshes.h"
#include "support/paths.h"
#include "support/snapshots.h"

namespace spring_workbench::markers {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;
using Keys = std::set<std::pair<std::string, int>>;

/// A hand over the middle of the box of the single-object scene: down, grasp, up.
class MarkersOfALift : public testing::Test {
 protected:
  static double height(double t) {
    return t < 1.0 ? 0.5 - 0.28 * t : t < 2.0 ? 0.22 : std::min(0.22 + 0.1 * (t - 2.0), 0.4);
  }

  void go_to(double t_end) {
    for (; t_ <= t_end; t_ += 0.02) {
      simulation_.push_stylus({t_, make_transform(Vector3d(0, 0, height(t_)), Quaterniond(0, 1, 0, 0))});
      if (!pressed_ && t_ > 1.5) simulation_.push_button(t_, pressed_ = true);
    }
    simulation_.advance_to(simulation_.newest_sample_time());
  }
  MarkerArray build() {
    std_msgs::Header header;
    header.frame_id = "world";
    return builder_.build(view_of(simulation_), header);
  }

  simulation::Simulation simulation_{scene::load_scene(test_support::checkout("scenes/single_box.urdf")),
                                     simulation::SimulationSettings()};
  MarkerBuilder builder_{"rod", fork_mesh::default_diameter, 2.0};
  double t_ = 0.0;
  bool pressed_ = false;
};

Keys keys(const MarkerArray& markers, int action) {
  Keys result;
  for (const Marker& marker : markers.markers) {
    if (marker.action == action) result.emplace(marker.ns, marker.id);
  }
  return result;
}

TEST_F(MarkersOfALift, EveryMarkerIsFiniteAndHasAnIdOfItsOwn) {
  for (const double t : {0.5, 1.2, 1.8, 2.5, 4.0}) {
    go_to(t);
    const MarkerArray markers = build();
    Keys all;
    for (const Marker& marker : markers.markers) {
      EXPECT_TRUE(all.emplace(marker.ns, marker.id).second) << marker.ns << " " << marker.id;
      EXPECT_NE(marker.action, Marker::DELETEALL);
      if (marker.action != Marker::ADD) continue;
      EXPECT_EQ(marker.header.frame_id, "world");
      EXPECT_EQ(marker.lifetime.toSec(), 2.0);
      EXPECT_GT(marker.type == Marker::TEXT_VIEW_FACING ? marker.scale.z : marker.scale.x, 0.0) << marker.ns;
      const auto& q = marker.pose.orientation;
      EXPECT_NEAR(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 1.0, 1e-9);
      for (const auto& p : marker.points) EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
      if (marker.type == Marker::TRIANGLE_LIST) {
        EXPECT_EQ(marker.points.size() % 3, 0u);
      }
    }
  }
}

TEST_F(MarkersOfALift, RemovedMarkersAreDeletedOnceAndByName) {
  Keys shown;
  bool force_was_drawn = false;
  for (double t = 0.5; t < 4.0; t += 0.1) {
    go_to(t);
    if (t > 3.5) simulation_.release();
    const MarkerArray markers = build();
    const Keys added = keys(markers, Marker::ADD), deleted = keys(markers, Marker::DELETE);
    Keys gone;
    for (const auto& key : shown) {
      if (added.count(key) == 0) gone.insert(key);
    }
    EXPECT_EQ(deleted, gone);
    force_was_drawn |= added.count({"force", 0}) != 0;
    shown = added;
  }
  EXPECT_TRUE(force_was_drawn);
  EXPECT_EQ(shown.count({"force", 0}), 0u);
}

/// Reused parts of the last message equal newly drawn ones.
TEST_F(MarkersOfALift, WhatWasDrawnBeforeChangesNothing) {
  const auto scene = std::make_shared<const scene::Scene>(simulation_.scene());
  live::SharedStates objects;
  std::set<std::size_t> shadows;
  for (double t = 0.5; t < 4.0; t += 0.1) {
    go_to(t);
    if (t > 3.5) simulation_.release();
    const live::View view = live::view_of(simulation_, scene, objects);
    MarkerArray markers = builder_.build(view, std_msgs::Header());
    const auto deletes = [](const Marker& marker) { return marker.action == Marker::DELETE; };
    markers.markers.erase(std::remove_if(markers.markers.begin(), markers.markers.end(), deletes),
                          markers.markers.end());
    EXPECT_EQ(markers, MarkerBuilder("rod", fork_mesh::default_diameter, 2.0).build(view, std_msgs::Header())) << t;
    shadows.insert(static_cast<std::size_t>(std::count_if(markers.markers.begin(), markers.markers.end(),
                                                          [](const Marker& m) { return m.ns == "shadow"; })));
  }
  EXPECT_EQ(shadows, (std::set<std::size_t>{0, 1, 2}));  // of the fork over the bench, and of the raised box
}

/// Sum of the triangles' areas.
double area(const Marker& marker) {
  const auto corner = [&](std::size_t i) {
    return Vector3d(marker.points[i].x, marker.points[i].y, marker.points[i].z);
  };
  double sum = 0.0;
  for (std::size_t i = 0; i + 2 < marker.points.size(); i += 3) {
    sum += 0.5 * (corner(i + 1) - corner(i)).cross(corner(i + 2) - corner(i)).norm();
  }
  return sum;
}

const Marker* find(const MarkerArray& markers, const std::string& ns, int id) {
  for (const Marker& marker : markers.markers) {
    if (marker.ns == ns && marker.id == id && marker.action == Marker::ADD) return &marker;
  }
  return nullptr;
}

TEST_F(MarkersOfALift, ARaisedBoxThrowsItsOwnOutlineOnTheBench) {
  go_to(1.0);
  EXPECT_EQ(find(build(), "shadow", 0), nullptr);
  go_to(6.0);  // at rest, hanging upright
  const MarkerArray markers = build();
  const Marker* shadow = find(markers, "shadow", 0);
  ASSERT_NE(shadow, nullptr);
  EXPECT_NEAR(area(*shadow), 0.1 * 0.06, 1e-5);
  for (const auto& p : shadow->points) EXPECT_NEAR(p.z, 0.0, 2e-3);
}

TEST_F(MarkersOfALift, LoadIsColouredAndWrittenInVirtualKilograms) {
  go_to(1.0);
  const auto unloaded = find(build(), "fork", 0)->color;
  EXPECT_EQ(find(build(), "readout", 0), nullptr);
  go_to(8.0);  // at rest: the scene's heaviest object, of 1 kg
  const MarkerArray markers = build();
  const auto loaded = find(markers, "fork", 0)->color;
  EXPECT_GT(unloaded.b, unloaded.r);
  EXPECT_GT(loaded.r, loaded.b + 0.5f);
  const auto& full = find(markers, "legend", 0)->colors.back();
  EXPECT_NEAR(full.g, loaded.g, 0.02);
  EXPECT_EQ(find(markers, "readout", 0)->text.substr(0, 20), "1.00 vkg   9.81 N   ");
}

/// Its colour is its own while it is held, and lit while it would be grasped.
TEST_F(MarkersOfALift, TheObjectThatTheTipIsInIsTranslucent) {
  const auto color = [&] {
    const MarkerArray markers = build();
    return find(markers, "box", 0)->color;
  };
  go_to(0.5);
  const auto own = color();
  EXPECT_EQ(own.a, 1.0f);
  go_to(1.2);
  EXPECT_NEAR(color().a, 0.5, 1e-6);
  EXPECT_GT(color().g, own.g + 0.1f);
  go_to(4.0);
  ASSERT_EQ(simulation_.tool().held_object, "box");
  EXPECT_NEAR(color().a, 0.5, 1e-6);
  EXPECT_EQ(color().g, own.g);
  simulation_.release();
  simulation_.push_stylus({t_ + 0.1, make_transform(Vector3d(0, 0, 0.9), Quaterniond(0, 1, 0, 0))});
  simulation_.advance_to(t_ + 0.1);
  EXPECT_EQ(color().a, 1.0f);
}

/// The probe holds nothing, but shows the force with which it presses.
TEST_F(MarkersOfALift, TheProbeHasAReadoutWhileItTouches) {
  simulation_.select_tool(tools::Tool::spring_probe);
  go_to(0.2);
  EXPECT_EQ(find(build(), "readout", 0), nullptr);
  go_to(1.9);
  const tools::ToolState tool = simulation_.tool();
  ASSERT_FALSE(tool.touched.empty());
  char force[20];
  std::snprintf(force, sizeof force, " %.2f N ", tool.tip_wrench_W.force.norm());
  EXPECT_GT(tool.tip_wrench_W.force.norm(), 1.0);
  EXPECT_NE(find(build(), "readout", 0)->text.find(force), std::string::npos);
}

/// Below the load: the means of scale and torque wrench, the force along and across the tool and its angle; of a probe,
/// the material.
TEST_F(MarkersOfALift, ReadingsAreWrittenBelowTheLoad) {
  go_to(8.0);
  live::View view = view_of(simulation_);
  tools::ToolState& tool = view.tools[0];
  const auto below = [&] {
    const MarkerArray markers = builder_.build(view, std_msgs::Header());
    const std::string text = find(markers, "readout", 0)->text;
    return text.find('\n') == std::string::npos ? "" : text.substr(text.find('\n') + 1);
  };
  EXPECT_EQ(below(), "9.8 N along   0.0 N across   0 deg");
  tool.weight_average = {1.0004, 0.002};
  tool.torque_average = {-0.0504, 0.001};
  tool.force_angle = M_PI / 6.0;
  tool.bending_force = 4.9;
  EXPECT_EQ(below(), "mean 1.000 +/- 0.002 vkg\nmean -0.050 +/- 0.001 N m\n9.8 N along   4.9 N across   30 deg");
  tool.stretching_force = -1e-9;  // a rounding error
  EXPECT_NE(below().find("\n0.0 N along"), std::string::npos);
  tool.held_object.clear();
  tool.touched = "box";
  EXPECT_EQ(below(), "");
  tool.material_stiffness = 1234.0;
  tool.material_stiffness_uncertainty = 20.0;
  EXPECT_EQ(below(), "material: 1.23e+03 +/- 2e+01 N/m");
  tool.material_stiffness = std::numeric_limits<double>::infinity();
  EXPECT_EQ(below(), "material: rigid");
}

TEST_F(MarkersOfALift, TheDrawnProngEndsWhereTheSimulatedTipPoints) {
  for (const double t : {0.5, 2.2, 2.6, 4.0}) {
    go_to(t);
    const tools::ToolState tool = simulation_.tool();
    const Vector3d point =
        tool.X_WE *
        Vector3d(0.0, 0.0, fork_mesh::ForkAppearance().prong_length * fork_mesh::default_diameter * tool.length);
    double nearest = 1.0;
    const MarkerArray markers = build();
    for (const auto& p : find(markers, "fork", 1)->points) {
      nearest = std::min(nearest, (Vector3d(p.x, p.y, p.z) - point).norm());
    }
    EXPECT_LT(nearest, 1e-9);
  }
}

/// 0.1 to 30 vkg on a logarithmic scale: each object has a different colour and a label with its weight.
TEST(LoadScale, EveryWeightOfTheMiniWorldHasItsPosition) {
  const scene::Scene scene = scene::load_scene(test_support::checkout("scenes/mini_world.urdf"));
  simulation::SimulationSettings settings;
  settings.grasp.calibrate = tools::Calibration::world;
  settings.contact = scene::ContactMode::none;
  std::set<std::string> marks;
  std::map<double, Vector3d> colors;
  for (const scene::Body& body : scene.bodies) {
    if (!body.movable) continue;
    settings.grasp.object = body.name;
    simulation::Simulation simulation(scene, settings);
    const Vector3d hand = body.X_WO.translation() + Vector3d(0, 0, 0.2);
    for (const double t : {0.0, 0.1}) simulation.push_stylus({t, make_transform(hand, Quaterniond(0, 1, 0, 0))});
    simulation.advance_to(4.0);
    const MarkerArray markers =
        MarkerBuilder("rod", fork_mesh::default_diameter, 2.0).build(view_of(simulation), std_msgs::Header());
    const auto color = find(markers, "fork", 0)->color;
    colors[body.mass_properties.mass] = Eigen::Vector3f(color.r, color.g, color.b).cast<double>();
    ASSERT_NE(find(markers, "legend load", 0), nullptr) << body.name;
    EXPECT_GT(find(markers, "legend load", 0)->points[1].z, find(markers, "legend", 0)->points[0].z) << body.name;
    for (const Marker& marker : markers.markers) {
      if (marker.ns == "legend marks") marks.insert(marker.text);
    }
  }
  Vector3d before(0.52, 0.66, 0.84);  // steel blue: no load
  for (const auto& [mass, color] : colors) {
    EXPECT_GT((color - before).norm(), 0.1) << mass;
    before = color;
  }
  EXPECT_EQ(marks.size(), colors.size());
  EXPECT_EQ(marks.count("0.1 vkg  0.2 mm"), 1u);
  EXPECT_EQ(marks.count("30 vkg  60 mm"), 1u);
}

/// One fork for 0.1 to 300 vkg: the lightest has its mark, and its load is above none.
TEST(LoadScale, ATenthOfAKilogramIsSeenBesideThreeHundred) {
  scene::Scene scene = scene::load_scene(test_support::checkout("scenes/heavy.urdf"));
  scene::set_mass(scene.bodies[*scene::find_body(scene, "one")], 0.1, "test");
  simulation::SimulationSettings settings;
  settings.grasp.calibrate = tools::Calibration::world;
  settings.contact = scene::ContactMode::none;
  settings.grasp.object = "one";
  simulation::Simulation simulation(scene, settings);
  const Vector3d hand = object(simulation, "one").X_WO.translation() + Vector3d(0, 0, 0.2);
  for (const double t : {0.0, 0.1}) simulation.push_stylus({t, make_transform(hand, Quaterniond(0, 1, 0, 0))});
  const auto draw = [&] {
    return MarkerBuilder("rod", fork_mesh::default_diameter, 2.0).build(view_of(simulation), std_msgs::Header());
  };
  simulation.advance_to(4.0);
  const MarkerArray loaded = draw();
  simulation.release();
  const MarkerArray unloaded = draw();
  std::set<std::string> marks;
  for (const Marker& marker : loaded.markers) {
    if (marker.ns == "legend marks") marks.insert(marker.text);
  }
  EXPECT_EQ(marks, (std::set<std::string>{"0.1 vkg  0.02 mm", "10 vkg  2 mm", "100 vkg  20 mm", "300 vkg  60 mm"}));
  EXPECT_GT(find(loaded, "legend load", 0)->points[1].z, find(loaded, "legend", 0)->points[0].z);
  EXPECT_GT(find(loaded, "fork", 0)->color.r, find(unloaded, "fork", 0)->color.r + 0.05f);
}

TEST(Markers, AMeshIsSentByItsFile) {
  scene::Scene scene = scene::load_scene(test_support::checkout("scenes/single_box.urdf"));
  geometry::TriangleMesh mesh = *test_support::box_mesh(Vector3d(0.2, 0.1, 0.1));
  mesh.uri = "package://somewhere/meshes/box.stl";
  mesh.scale = Vector3d(0.5, 1.0, 2.0);
  scene::Body& box = scene.bodies[*scene::find_body(scene, "box")];
  box.visual[0].geometry = std::make_shared<const geometry::TriangleMesh>(mesh);
  const MarkerArray markers =
      MarkerBuilder("rod", fork_mesh::default_diameter, 2.0)
          .build(view_of(simulation::Simulation(scene, simulation::SimulationSettings())), std_msgs::Header());
  const Marker* marker = find(markers, "box", 0);
  ASSERT_NE(marker, nullptr);
  EXPECT_EQ(marker->type, Marker::MESH_RESOURCE);
  EXPECT_EQ(marker->mesh_resource, mesh.uri);
  EXPECT_EQ(marker->scale.z, 2.0);
  EXPECT_TRUE(marker->points.empty());
  EXPECT_NEAR(marker->color.r, box.visual[0].color[0], 1e-6);
}

/// Unless the scene gives it another colour, or its kind of file has none.
TEST(Markers, AMeshHasTheColoursOfItsFile) {
  scene::Scene scene = scene::load_scene(test_support::checkout("scenes/single_box.urdf"));
  geometry::TriangleMesh mesh = *test_support::box_mesh(Vector3d(0.2, 0.1, 0.1));
  geometry::Shape& shape = scene.bodies[*scene::find_body(scene, "box")].visual[0];
  for (const auto& [uri, given, own] :
       std::vector<std::tuple<std::string, bool, bool>>{{"package://a/b.dae", false, true},
                                                        {"package://a/b.dae", true, false},
                                                        {"package://a/b.STL", false, false}}) {
    mesh.uri = uri;
    shape.geometry = std::make_shared<const geometry::TriangleMesh>(mesh);
    shape.color_given = given;
    const simulation::Simulation simulation(scene, simulation::SimulationSettings());
    const MarkerArray markers =
        MarkerBuilder("rod", fork_mesh::default_diameter, 2.0).build(view_of(simulation), std_msgs::Header());
    const Marker* marker = find(markers, "box", 0);
    ASSERT_NE(marker, nullptr);
    EXPECT_EQ(marker->mesh_use_embedded_materials != 0, own) << uri << given;
    EXPECT_NEAR(marker->color.a, own ? 0.0 : 1.0, 1e-6) << uri << given;
  }
}

TEST_F(MarkersOfALift, AnInsertedObjectIsHighlighted) {
  const auto color = [this] {
    for (const Marker& marker : build().markers) {
      if (marker.ns == "box") return marker.color;
    }
    throw std::runtime_error("the box is not drawn");
  };
  go_to(0.5);
  const auto before = color();
  go_to(1.3);  // the tip is in, the button is up
  const auto inserted = color();
  go_to(2.5);
  const auto held = color();
  EXPECT_GT(inserted.g, before.g + 0.2);
  EXPECT_EQ(held.g, before.g);
}

/// Of a thousand objects among fixed bodies each is drawn as its own body, where it is.
TEST(Markers, OfManyObjectsEachIsItsOwnBody) {
  std::vector<scene::Body> bodies;
  for (int k = 0; k < 1500; ++k) {
    const bool fixed = k % 3 == 1;
    const Vector3d size(0.01 + 1e-5 * k, 0.02, 0.03);
    scene::Body body = box("body " + std::to_string(k), size, fixed ? 0.0 : 1.0, Vector3d(0.1 * k, 0.0, 0.5));
    geometry::Shape shape;
    shape.geometry = geometry::Box{size};
    body.visual = {shape};
    bodies.push_back(body);
  }
  simulation::Simulation simulation(scene_of(bodies, scene::ContactMode::none), simulation::SimulationSettings());
  std::map<std::string, RigidTransform> places;
  for (const bodies::BodyState& object : simulation.objects()) {
    places[object.name] = object.X_WO;
    places[object.name].translation().y() = 1.0;
  }
  ASSERT_EQ(places.size(), 1000u);
  simulation.place(places);
  std::map<std::string, Marker> drawn;
  for (const Marker& marker :
       MarkerBuilder("rod", fork_mesh::default_diameter, 2.0).build(view_of(simulation), std_msgs::Header()).markers) {
    if (marker.ns.rfind("body ", 0) == 0) drawn[marker.ns] = marker;
  }
  ASSERT_EQ(drawn.size(), 1500u);
  for (int k = 0; k < 1500; ++k) {
    const Marker& marker = drawn.at("body " + std::to_string(k));
    EXPECT_DOUBLE_EQ(marker.scale.x, 0.01 + 1e-5 * k);
    EXPECT_DOUBLE_EQ(marker.pose.position.x, 0.1 * k);
    EXPECT_EQ(marker.pose.position.y, k % 3 == 1 ? 0.0 : 1.0);
  }
}

}  // namespace
}  // namespace spring_workbench::markers
