#pragma once

#include "marker_list.h"
#include "spring_workbench/live/view.h"

namespace spring_workbench::markers {

/// Bodies as primitives or as their mesh files, in their URDF's colours; an object that the tip is in lights up.
void draw_bodies(const live::View& view, MarkerList& markers);
/// Ghosts of the objects where they belong.
void draw_targets(const scene::Scene& scene, MarkerList& markers);
void draw_contacts(const std::vector<contact::ContactState>& contacts, double fork_length, MarkerList& markers);

}  // namespace spring_workbench::markers
