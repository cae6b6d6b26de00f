#pragma once

#include "marker_list.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::markers {

/// How much a tool carries, as a colour: steel blue without load, over yellow, to red at the weight of the heaviest
/// object and beyond. In proportion to the load, or, where the weights of the objects span more than a decade, to its
/// logarithm.
class LoadScale {
 public:
  explicit LoadScale(const simulation::Simulation& simulation);

  /// The larger of the tip's force and of its moment over the fork's length [N].
  static double load(const tools::ToolState& tool);
  /// Where a load is on the scale: 0 … 1.
  double place(double load) const;
  Color color(double load) const;
  /// A column of the colours at the scene's left back corner: what its end means in N and vkg, and a mark for each
  /// object's weight; with `calibrate: world` the extension that the hanging object gives the fork, too.
  void draw_legend(MarkerList& markers) const;
  /// An arrow at the column, where the load of this tool is.
  void draw_load(const tools::ToolState& tool, const std::string& number, MarkerList& markers) const;

 private:
  void draw_marks(MarkerList& markers) const;
  double height(double place) const;  ///< of the column [m]
  std::string label(double weight) const;

  double full_;                     ///< [N], > 0
  double none_ = 0.0;               ///< where a logarithmic scale begins [N]; 0: the scale is linear
  std::vector<double> weights_;     ///< of the objects, from the heaviest to the lightest [N]
  double gravity_;                  ///< that tells a weight from a mass [m/s²]
  double stretch_stiffness_ = 0.0;  ///< of the fork that is calibrated to the world [N/m]; 0: it is not
  Vector3d foot_;                   ///< of the column
};

/// Virtual kilograms (the paper, section 4): what weighs this force [N] in the scene; on Earth where it has no gravity.
double virtual_kilograms(double force, const scene::Scene& scene);

}  // namespace spring_workbench::markers
