#pragma once

#include "marker_list.h"
#include "spring_workbench/instruments/load_range.h"
#include "spring_workbench/live/view.h"

namespace spring_workbench::markers {

/// The legend for the loads of tools, in the colours of fork_mesh::load_color over the scene's LoadRange.
class LoadScale {
 public:
  /// Valid for all views of this scene.
  explicit LoadScale(const live::View& view);

  /// Draws a column of the colours at the left back corner of the scene, labelled with its full scale in N and vkg and
  /// with the weight of each object; with `calibrate: world` also with the extension of the fork under each hanging
  /// object.
  void draw_legend(MarkerList& markers) const;
  /// Draws an arrow at the column that indicates the load of this tool.
  void draw_load(const tools::ToolState& tool, const std::string& number, MarkerList& markers) const;

 private:
  struct Mark {
    double height;  ///< height in the column [m]
    std::string label;
  };
  std::vector<Mark> marks() const;
  double height(double place) const;  ///< height in the column of a position in the range [m]
  std::string label(double weight) const;

  instruments::LoadRange range_;
  double gravity_;                  ///< converts mass to weight [m/s²]
  double stretch_stiffness_ = 0.0;  ///< of the fork calibrated to the world [N/m]; 0: not calibrated
  Vector3d foot_;                   ///< foot of the column
  std::vector<Mark> marks_;         ///< labels of the objects' weights
};

/// Colour of a spring whose load is at `place` in the range, 0 … 1.
Color load_color(double place);

/// Virtual kilograms (paper, section 4): the mass whose weight in the scene is this force [N]; on Earth if the scene
/// has no gravity.
double virtual_kilograms(double force, const scene::Scene& scene);

}  // namespace spring_workbench::markers
