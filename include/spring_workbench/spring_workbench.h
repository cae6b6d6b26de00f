#pragma once

// Everything that a program needs of the library.
#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/hand_input/feed.h"
#include "spring_workbench/motion_files/open_motion.h"
#include "spring_workbench/scene/scene.h"
#include "spring_workbench/simulation/simulation.h"
#include "spring_workbench/validation/input_error.h"

static_assert(alignof(spring_workbench::RigidTransform) <= 16,
              "The library's types are aligned to 16 bytes: link spring_workbench::core, or define "
              "EIGEN_MAX_ALIGN_BYTES=16");
