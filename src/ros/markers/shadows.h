#pragma once

#include <map>
#include <vector>

#include "marker_list.h"
#include "spring_workbench/live/view.h"

namespace spring_workbench::markers {

/// Shadows on the bench, straight below raised objects and forks, which show their height. Shadows of objects that have
/// not moved are reused.
class Shadows {
 public:
  /// All views must be of the same scene, which must outlive this. `forks_W`: vertices of each hand's fork.
  void draw(const live::View& view, const std::vector<std::vector<Vector3d>>& forks_W, MarkerList& markers);

 private:
  void follow(const live::View& view);

  live::SharedStates drawn_;
  std::vector<const scene::Body*> bodies_;  ///< bodies of the objects
  std::map<std::size_t, std::vector<Vector3d>>
      corners_;  ///< corners of the triangles of the current shadows, by object
};

}  // namespace spring_workbench::markers
