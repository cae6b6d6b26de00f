#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <vector>

#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench::markers {

using Color = Eigen::Vector4d;  ///< r, g, b, alpha in 0 … 1

std_msgs::ColorRGBA to_color(const Color& color);

/// The markers of one message, all in the header's frame and with the same lifetime.
class MarkerList {
 public:
  /// `lifetime` [s]: how long rviz keeps a marker that is not sent again.
  MarkerList(const std_msgs::Header& header, double lifetime) : header_(header), lifetime_(lifetime) {}

  /// Adds a marker of a visualization_msgs::Marker type; the reference is valid until the next one is added.
  visualization_msgs::Marker& add(const std::string& ns, int id, int type, const RigidTransform& X_W,
                                  const Color& color);
  visualization_msgs::Marker& add_shape(const std::string& ns, int id, int type, const RigidTransform& X_W,
                                        const Vector3d& size, const Color& color);
  /// Adds a marker made of points in W.
  visualization_msgs::Marker& add_points(const std::string& ns, int id, int type, const std::vector<Vector3d>& points,
                                         const Color& color);
  /// Adds an arrow from `begin` to `end` in W, with a shaft of `thickness` [m].
  void add_arrow(const std::string& ns, int id, const Vector3d& begin, const Vector3d& end, double thickness,
                 const Color& color);
  /// Adds a text that faces the viewer, with letters `height` [m] high.
  void add_text(const std::string& ns, int id, const Vector3d& p_W, double height, const std::string& text,
                const Color& color);

  /// Removes and returns the markers.
  visualization_msgs::MarkerArray take() { return std::move(markers_); }

 private:
  std_msgs::Header header_;
  double lifetime_;
  visualization_msgs::MarkerArray markers_;
};

}  // namespace spring_workbench::markers
