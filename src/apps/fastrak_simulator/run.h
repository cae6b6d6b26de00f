#pragma once

#include <functional>

#include "options.h"

namespace spring_workbench::fastrak_simulator {

/// Runs the device until the duration is over or `stop` says so. Throws InputError for motions and links that cannot be
/// used.
void run(const Options& options, const std::function<bool()>& stop);

}  // namespace spring_workbench::fastrak_simulator
