#pragma once

#include "load_scale.h"
#include "spring_workbench/fork_mesh/fork_model.h"

namespace spring_workbench::markers {

/// The fork's spring in the colour of its load, its shaft and prongs. `number` of the hand: "" of the first, "_2" of
/// the second.
void draw_fork(const fork_mesh::ForkModel& model, const fork_mesh::ForkMesh& mesh, const Color& spring_color,
               const std::string& number, MarkerList& markers);
/// A line from the hand to the seen handle.
void draw_gap(const tools::ToolState& tool, const std::string& number, MarkerList& markers);
/// Force and moment at the tip as arrows, half the fork's length for the held object's weight and for that weight at a
/// fifth of the fork's length; both as a line of text in vkg, N and N·m.
void draw_load(const scene::Scene& scene, const tools::ToolState& tool, const std::string& number, MarkerList& markers);

}  // namespace spring_workbench::markers
