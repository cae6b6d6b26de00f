#pragma once

#include <map>
#include <vector>

#include "marker_list.h"
#include "spring_workbench/live/view.h"

namespace spring_workbench::markers {

/// What lies straight below each raised object and below the forks, on the bench: shows how high they are. Those of
/// objects that have not moved are kept.
class Shadows {
 public:
  /// All views are of one scene, which must outlive this. `forks_W`: corners of each hand's fork.
  void draw(const live::View& view, const std::vector<std::vector<Vector3d>>& forks_W, MarkerList& markers);

 private:
  void follow(const live::View& view);

  live::SharedStates drawn_;
  std::vector<const scene::Body*> bodies_;                ///< of the objects
  std::map<std::size_t, std::vector<Vector3d>> corners_;  ///< of the triangles of the shadows that there are, by object
};

}  // namespace spring_workbench::markers
