#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <spring_workbench/spring_workbench.h>
#include <yaml-cpp/yaml.h>

#include <vector>

namespace spring_workbench::python {

using Array = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

/// Conversion to a 4 × 4 array and back. Throws InputError naming `what` for a wrong shape, a number that is not
/// finite, or a matrix that is not a rigid transform.
Array to_array(const RigidTransform& X);
RigidTransform to_pose(const Array& matrix, const std::string& what);
Array to_array(const Eigen::Ref<const Eigen::VectorXd>& vector);
/// Twist: linear part, then angular part; wrench: force, then moment.
Array to_array(const Twist& V);
Array to_array(const Wrench& F);
/// Conversion back; throws InputError naming `what` for a wrong shape.
Wrench to_wrench(const Array& vector, const std::string& what);
/// `count` poses as a count × 4 × 4 array.
template <typename PoseOf>
Array to_arrays(std::size_t count, PoseOf&& pose_of) {
  Array all({count, std::size_t{4}, std::size_t{4}});
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Matrix4d X = pose_of(i).matrix();
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 4; ++column) all.mutable_at(i, row, column) = X(row, column);
    }
  }
  return all;
}
/// Converts numbers, booleans, strings, lists and dictionaries to the YAML of a settings file. Throws InputError naming
/// `key` and the keys within for other types.
YAML::Node to_yaml(const pybind11::handle& value, const std::string& key);

/// Throws InputError("<key>: invalid value '<value>': expected <rule>").
[[noreturn]] inline void refuse(const std::string& key, const std::string& value, const std::string& rule) {
  throw validation::InputError(key + ": invalid value '" + value + "': expected " + rule);
}

/// The name of an enum value.
template <typename E>
std::string word(E value) {
  return names_of(value).at(static_cast<std::size_t>(value));
}
/// The enum value with this name. Throws InputError naming `key` if there is none.
template <typename E>
E value_of(const std::string& word, const std::string& key) {
  std::string known;
  for (std::size_t i = 0; i < names_of(E{}).size(); ++i) {
    if (names_of(E{})[i] == word) return static_cast<E>(i);
    known += (i == 0 ? "" : ", ") + names_of(E{})[i];
  }
  refuse(key, word, "one of " + known);
}

void bind_states(pybind11::module& module);
void bind_settings(pybind11::module& module);
void bind_motions(pybind11::module& module);
void bind_simulation(pybind11::module& module);

/// A complete recorded hand.
struct Motion {
  std::vector<motion::StylusSample> samples;
};

}  // namespace spring_workbench::python
