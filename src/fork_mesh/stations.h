#pragma once

namespace spring_workbench::fork_mesh {

/// Of every curve that is made here: enough that a full circle is 1e-6 of the length off between them.
constexpr int fork_curve_stations = 65;

}  // namespace spring_workbench::fork_mesh
