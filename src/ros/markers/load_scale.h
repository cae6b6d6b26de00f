#pragma once

#include "marker_list.h"
#include "spring_workbench/instruments/load_range.h"
#include "spring_workbench/live/view.h"

namespace spring_workbench::markers {

/// The legend of how much a tool carries, in the colours of fork_mesh::load_color over the scene's LoadRange.
class LoadScale {
 public:
  /// Holds for all views of this scene.
  explicit LoadScale(const live::View& view);

  /// A column of the colours at the scene's left back corner: what its end means in N and vkg, and a mark for each
  /// object's weight; with `calibrate: world` the extension that the hanging object gives the fork, too.
  void draw_legend(MarkerList& markers) const;
  /// An arrow at the column, where the load of this tool is.
  void draw_load(const tools::ToolState& tool, const std::string& number, MarkerList& markers) const;

 private:
  struct Mark {
    double height;  ///< in the column [m]
    std::string label;
  };
  std::vector<Mark> marks() const;
  double height(double place) const;  ///< of the column [m]
  std::string label(double weight) const;

  instruments::LoadRange range_;
  double gravity_;                  ///< that tells a weight from a mass [m/s²]
  double stretch_stiffness_ = 0.0;  ///< of the fork that is calibrated to the world [N/m]; 0: it is not
  Vector3d foot_;                   ///< of the column
  std::vector<Mark> marks_;         ///< of objects' weights
};

/// Of a spring whose load is at `place` in the range.
Color load_color(double place);

/// Virtual kilograms (the paper, section 4): what weighs this force [N] in the scene; on Earth where it has no gravity.
double virtual_kilograms(double force, const scene::Scene& scene);

}  // namespace spring_workbench::markers
