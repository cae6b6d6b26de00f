#include "bindings.h"

namespace spring_workbench::python {

namespace py = pybind11;

namespace {

constexpr const char* pose_text = R"(Returns a pose as an array of shape (4, 4).

position: x, y, z [m]. quaternion: x, y, z, w; it is normalised here. Raises InputError if one of them has the wrong
length or is not finite, or if the quaternion is zero.)";

RigidTransform pose(const std::vector<double>& position, const std::vector<double>& quaternion) {
  const auto check = [](bool valid, const std::string& rule) {
    if (!valid) throw validation::InputError("pose: " + rule);
  };
  check(position.size() == 3, "position: expected 3 numbers [m], got " + std::to_string(position.size()));
  check(quaternion.size() == 4, "quaternion: expected 4 numbers, x y z w, got " + std::to_string(quaternion.size()));
  const Quaterniond q(quaternion[3], quaternion[0], quaternion[1], quaternion[2]);
  const Vector3d p(position[0], position[1], position[2]);
  check(p.allFinite() && q.coeffs().allFinite(), "expected finite numbers");
  check(q.norm() > 0.0, "quaternion: invalid value '0 0 0 0': expected a nonzero quaternion");
  return make_transform(p, q);
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  module.doc() = "Compiled part of spring_workbench.";
  // Not py::register_exception: a message may quote bytes that are not UTF-8.
  static const py::exception<validation::InputError> input_error(module, "InputError", PyExc_ValueError);
  py::register_exception_translator([](std::exception_ptr error) {
    try {
      if (error) std::rethrow_exception(error);
    } catch (const validation::InputError& refusal) {
      const std::string text = refusal.what();
      const auto size = static_cast<py::ssize_t>(text.size());
      PyErr_SetObject(input_error.ptr(),
                      py::reinterpret_steal<py::str>(PyUnicode_DecodeUTF8(text.data(), size, "replace")).ptr());
    }
  });
  py::object(input_error).attr("__doc__") =
      "Invalid input, in one line. For an invalid value it names the field, the value and the allowed values. A call "
      "that "
      "raises it changes nothing, unless it says otherwise.";
  bind_settings(module);
  bind_motions(module);
  bind_states(module);
  bind_simulation(module);
  module.def(
      "pose",
      [](const std::vector<double>& position, const std::vector<double>& quaternion) {
        return to_array(pose(position, quaternion));
      },
      py::arg("position"), py::arg("quaternion") = std::vector<double>{0.0, 0.0, 0.0, 1.0}, pose_text);
  module.def(
      "integrators", [] { return names_of(dynamics::IntegratorKind{}); },
      "Returns the names that the setting `integrator` accepts.");
}

}  // namespace spring_workbench::python
