#pragma once

#include <nvector/nvector_serial.h>

#include <stdexcept>
#include <string>

#include "benchmark/ode_solver.h"

namespace spring_workbench::benchmark {

// Callbacks and error handling for CVODE and ARKODE.

/// `rates`: pointer to an OdeSolver::Rates. Returns 1 if there are no rates at `y`; the solver then tries a smaller
/// step.
inline int right_side(realtype t, N_Vector y, N_Vector rate, void* rates) {
  const bool fine = (*static_cast<const OdeSolver::Rates*>(rates))(t, N_VGetArrayPointer(y), N_VGetArrayPointer(rate));
  return fine ? 0 : 1;
}

/// Throws std::runtime_error if `status` indicates that `call` failed.
inline void require(int status, const char* call) {
  if (status < 0) throw std::runtime_error(std::string(call) + " failed with status " + std::to_string(status));
}

inline void ignore_message(int, const char*, const char*, char*, void*) {}

}  // namespace spring_workbench::benchmark
