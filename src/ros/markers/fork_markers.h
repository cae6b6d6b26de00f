#pragma once

#include "load_scale.h"
#include "spring_workbench/fork_mesh/fork_model.h"

namespace spring_workbench::markers {

/// Draws the fork's spring in the colour of its load, its shaft and prongs. `number`: suffix of the hand, "" for the
/// first, "_2" for the second.
void draw_fork(const fork_mesh::ForkModel& model, const fork_mesh::ForkMesh& mesh, const Color& spring_color,
               const std::string& number, MarkerList& markers);
/// Draws a line from the hand to the proxy handle.
void draw_gap(const tools::ToolState& tool, const std::string& number, MarkerList& markers);
/// Draws force and moment at the tip as arrows, and as a line of text in vkg, N and N·m. The arrow is half the fork's
/// length for the weight of the held object, and for the moment of that weight at a fifth of the fork's length.
void draw_load(const scene::Scene& scene, const tools::ToolState& tool, const std::string& number, MarkerList& markers);

}  // namespace spring_workbench::markers
