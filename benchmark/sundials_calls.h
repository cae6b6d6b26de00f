#pragma once

#include <nvector/nvector_serial.h>

#include <stdexcept>
#include <string>

#include "benchmark/ode_solver.h"

namespace spring_workbench::benchmark {

// What CVODE and ARKODE are called with.

/// `rates` is an OdeSolver::Rates. 1 where it has no rates at `y`: the solver tries a smaller step.
inline int right_side(realtype t, N_Vector y, N_Vector rate, void* rates) {
  const bool fine = (*static_cast<const OdeSolver::Rates*>(rates))(t, N_VGetArrayPointer(y), N_VGetArrayPointer(rate));
  return fine ? 0 : 1;
}

/// Throws std::runtime_error where `status` says that `call` failed.
inline void require(int status, const char* call) {
  if (status < 0) throw std::runtime_error(std::string(call) + " failed with status " + std::to_string(status));
}

inline void ignore_message(int, const char*, const char*, char*, void*) {}

}  // namespace spring_workbench::benchmark
