#include "spring_workbench/ros_interface/markers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "spring_workbench/scene/scene.h"

namespace spring_workbench {
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
      simulation_.push_stylus({t_, make_transform(Quaterniond(0, 1, 0, 0), Vector3d(0, 0, height(t_)))});
      if (!pressed_ && t_ > 1.5) simulation_.push_button(t_, pressed_ = true);
    }
    simulation_.advance(simulation_.newest_sample());
  }
  MarkerArray build() {
    std_msgs::Header header;
    header.frame_id = "world";
    return builder_.build(simulation_, header);
  }

  Simulation simulation_{load_scene(SPRING_WORKBENCH_SOURCE_DIR "/scenes/single_box.urdf"), SimulationSettings()};
  MarkerBuilder builder_{"rod", 2.0};
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
      EXPECT_GT(marker.scale.x, 0.0) << marker.ns;
      const auto& q = marker.pose.orientation;
      EXPECT_NEAR(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 1.0, 1e-9);
      for (const auto& p : marker.points) EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
      if (marker.type == Marker::TRIANGLE_LIST) {
        EXPECT_EQ(marker.points.size() % 3, 0u);
      }
    }
  }
}

TEST_F(MarkersOfALift, WhatIsGoneIsDeletedOnceAndByName) {
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

}  // namespace
}  // namespace spring_workbench
