#pragma once

#include "marker_list.h"
#include "spring_workbench/live/view.h"

namespace spring_workbench::markers {

/// Bodies as primitives or as their mesh files, in their URDF's colours; an object that the tip is in lights up.
void draw_bodies(const live::View& view, MarkerList& markers);
/// Ghosts of the objects where they belong.
void draw_targets(const scene::Scene& scene, MarkerList& markers);
/// What lies straight below each raised object and below the fork, on the bench: shows how high they are.
void draw_shadows(const live::View& view, const std::vector<std::vector<Vector3d>>& forks_W, MarkerList& markers);
void draw_contacts(const std::vector<contact::ContactState>& contacts, double fork_length, MarkerList& markers);

}  // namespace spring_workbench::markers
