#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "spring_workbench/fork_mesh/fork_model.h"
#include "spring_workbench/live/view.h"

namespace spring_workbench::markers {

class LoadScale;
class MarkerList;
class Shadows;

/// What to draw: everything, or only what the rviz displays `Objects` and `SpringFork` do not draw.
enum class Drawn { everything, not_in_displays };

/// Draws the simulation for rviz: bodies, targets, shadows on the bench, the deformed forks in the colours of their
/// loads with a legend, force and moment at each tip as arrows and text, contact points with their normals. To avoid
/// flicker, a marker keeps its namespace and id as long as it is shown, and is then deleted by name. Markers that are
/// no longer sent expire in rviz.
class MarkerBuilder {
 public:
  /// `fork_curve`: one of fork_curve_names(); `fork_diameter`: diameter of the coil as a fraction of the rest length;
  /// `lifetime`: time after which a marker that is not sent again expires [s].
  MarkerBuilder(std::string fork_curve, double fork_diameter, double lifetime, Drawn drawn = Drawn::everything);
  ~MarkerBuilder();

  visualization_msgs::MarkerArray build(const live::View& view, const std_msgs::Header& header);

 private:
  using MarkerKey = std::pair<std::string, int>;

  /// Draws the tool of a hand and what it carries.
  void draw_hand(const live::View& view, std::size_t hand, MarkerList& list);
  const fork_mesh::ForkModel& deform(const tools::ToolState& tool);
  void delete_stale_markers(const std_msgs::Header& header, visualization_msgs::MarkerArray& markers);

  std::string fork_curve_;
  double fork_diameter_, lifetime_;
  Drawn drawn_;
  std::shared_ptr<const scene::Scene> scene_;           ///< of the last view
  std::unique_ptr<LoadScale> scale_;                    ///< of this scene
  std::unique_ptr<Shadows> shadows_;                    ///< likewise
  std::map<tools::Tool, fork_mesh::ForkModel> models_;  ///< models of the tools drawn so far
  fork_mesh::ForkMesh fork_mesh_;
  std::vector<std::vector<Vector3d>> forks_W_;  ///< vertices of each hand's fork
  std::set<MarkerKey> shown_;
};

}  // namespace spring_workbench::markers
