#pragma once

#include "marker_list.h"
#include "spring_workbench/live/view.h"

namespace spring_workbench::markers {

/// Draws bodies as primitives or mesh files, in the colours of their URDF; the object that the tip is in is
/// highlighted.
void draw_bodies(const live::View& view, MarkerList& markers);
/// Draws ghosts of the objects at their targets.
void draw_targets(const scene::Scene& scene, MarkerList& markers);
void draw_contacts(const std::vector<contact::ContactState>& contacts, double fork_length, MarkerList& markers);

}  // namespace spring_workbench::markers
