#include "marker_list.h"

#include "spring_workbench/ros/common/conversions.h"

namespace spring_workbench::markers {

using visualization_msgs::Marker;

std_msgs::ColorRGBA to_color(const Color& color) {
  std_msgs::ColorRGBA message;
  message.r = static_cast<float>(color[0]);
  message.g = static_cast<float>(color[1]);
  message.b = static_cast<float>(color[2]);
  message.a = static_cast<float>(color[3]);
  return message;
}

Marker& MarkerList::add(const std::string& ns, int id, int type, const RigidTransform& X_W, const Color& color) {
  Marker marker;
  marker.header = header_;
  marker.ns = ns;
  marker.id = id;
  marker.type = type;
  marker.action = Marker::ADD;
  marker.pose = ros_common::to_pose(X_W);
  marker.color = to_color(color);
  marker.scale = ros_common::to_vector(Vector3d::Ones());
  marker.lifetime = ros::Duration(lifetime_);
  markers_.markers.push_back(marker);
  return markers_.markers.back();
}

Marker& MarkerList::add_shape(const std::string& ns, int id, int type, const RigidTransform& X_W, const Vector3d& size,
                              const Color& color) {
  Marker& marker = add(ns, id, type, X_W, color);
  marker.scale = ros_common::to_vector(size);
  return marker;
}

Marker& MarkerList::add_points(const std::string& ns, int id, int type, const std::vector<Vector3d>& points,
                               const Color& color) {
  Marker& marker = add(ns, id, type, RigidTransform::Identity(), color);
  marker.points.reserve(points.size());
  for (const Vector3d& p : points) marker.points.push_back(ros_common::to_point(p));
  return marker;
}

void MarkerList::add_arrow(const std::string& ns, int id, const Vector3d& begin, const Vector3d& end, double thickness,
                           const Color& color) {
  add_points(ns, id, Marker::ARROW, {begin, end}, color).scale =
      ros_common::to_vector(thickness * Vector3d(1.0, 2.2, 3.0));
}

void MarkerList::add_text(const std::string& ns, int id, const Vector3d& p_W, double height, const std::string& text,
                          const Color& color) {
  RigidTransform X_W = RigidTransform::Identity();
  X_W.translation() = p_W;
  Marker& marker = add(ns, id, Marker::TEXT_VIEW_FACING, X_W, color);
  marker.scale.z = height;
  marker.text = text;
}

}  // namespace spring_workbench::markers
