#pragma once

#include "spring_workbench/scene/constants.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::scene {

// The numbers that are allowed in a scene, whether they come from its files, the settings or an edit.

inline validation::NumberRule mass_rule() { return validation::between(0.0, max_mass).in("kg"); }
inline validation::NumberRule friction_rule() { return validation::not_negative(); }
inline validation::NumberRule gravity_rule() { return validation::between(0.0, 1e3).in("m/s²"); }
inline validation::NumberRule force_scale_rule() { return validation::between(1e-9, 1e9); }

}  // namespace spring_workbench::scene
