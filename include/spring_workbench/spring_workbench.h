#pragma once

/// The whole library: virtual tools made of springs, and what they move. Begin with simulation::Simulation,
/// scene::load_scene() and make_transform(); doc/library.md shows how they work together. Units are SI, and frames are
/// right-handed with z up.
namespace spring_workbench {
/// Scenes, read from URDF.
namespace scene {}
/// The simulation, its settings, changes and reports.
namespace simulation {}
/// Tools in the hand, their settings and states.
namespace tools {}
/// The elastic rod of the spring-fork.
namespace rod {}
/// Motion of a held object, and integrators for it.
namespace dynamics {}
/// States of movable objects.
namespace bodies {}
/// States of contacts.
namespace contact {}
/// Shapes of bodies.
namespace geometry {}
/// Motions of tracked frames.
namespace motion {}
/// Readers of recorded motions.
namespace motion_files {}
/// Filters between a tracker and the simulation.
namespace hand_input {}
/// Packs of numbers and saved states. Packs, which hold several numbers, only make built-in methods fast: users of the
/// interface with `double` can ignore them.
namespace math {}
/// Errors in the user's input.
namespace validation {}
}  // namespace spring_workbench

#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/hand_input/input_filter.h"
#include "spring_workbench/motion_files/open_motion.h"
#include "spring_workbench/scene/scene.h"
#include "spring_workbench/simulation/simulation.h"
#include "spring_workbench/validation/input_error.h"

static_assert(alignof(spring_workbench::RigidTransform) <= 16,
              "The library's types are aligned to 16 bytes: link spring_workbench::core, or define "
              "EIGEN_MAX_ALIGN_BYTES=16");
