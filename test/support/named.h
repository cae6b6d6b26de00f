#pragma once

#include <memory>
#include <string>
#include <vector>

#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/rod/shape_model.h"
#include "spring_workbench/validation/names.h"

namespace spring_workbench::test_support {

// Shapes and integrators by name, for the names of parameterised tests.

inline rod::ShapeKind shape_named(const std::string& name) {
  return validation::named<rod::ShapeKind>(name, "test", "shape");
}
inline std::vector<std::string> shape_names() { return validation::names<rod::ShapeKind>(); }

inline dynamics::IntegratorKind integrator_named(const std::string& name) {
  return validation::named<dynamics::IntegratorKind>(name, "test", "integrator");
}
inline std::unique_ptr<dynamics::Integrator> make_integrator(const std::string& name) {
  return dynamics::make_integrator(integrator_named(name));
}
inline std::vector<std::string> integrator_names() { return validation::names<dynamics::IntegratorKind>(); }

/// The integrators that converge to the equation of motion.
inline std::vector<std::string> equation_of_motion_integrator_names() {
  std::vector<std::string> names;
  for (const std::string& name : integrator_names()) {
    if (make_integrator(name)->solves_the_equation_of_motion()) names.push_back(name);
  }
  return names;
}

}  // namespace spring_workbench::test_support
