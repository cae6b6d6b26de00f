#pragma once

#include "marker_list.h"
#include "spring_workbench/simulation/simulation.h"

namespace spring_workbench::manipulation {

/// How much the fork carries, as a colour: steel blue without load, over yellow, to red at the weight of the scene's
/// heaviest object and beyond.
class LoadScale {
 public:
  explicit LoadScale(const scene::Scene& scene);

  /// The larger of the tip's force and of its moment over the fork's length [N].
  static double load(const tools::ToolState& tool);
  Color color(double load) const;
  /// A column of the colours at the scene's left back corner, with what they mean in N and vkg.
  void draw_legend(const scene::Scene& scene, MarkerList& markers) const;

 private:
  double full_;  ///< [N], > 0
};

/// Virtual kilograms (the paper, section 4): what weighs this force [N] in the scene; on Earth where it has no gravity.
double virtual_kilograms(double force, const scene::Scene& scene);

}  // namespace spring_workbench::manipulation
