#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

#include "spring_workbench/math/rigid_transform.h"
#include "spring_workbench/validation/names.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::config {

// Typed readers of one YAML value. `where` says where it came from (a file's name, "command line"); the line is added
// where the node knows it. Each throws InputError as above.
double read_number(const YAML::Node& node, const std::string& where, const std::string& key,
                   const validation::NumberRule& rule);
int read_integer(const YAML::Node& node, const std::string& where, const std::string& key, int min, int max);
bool read_bool(const YAML::Node& node, const std::string& where, const std::string& key);
std::string read_string(const YAML::Node& node, const std::string& where, const std::string& key);
std::string read_choice(const YAML::Node& node, const std::string& where, const std::string& key,
                        const std::vector<std::string>& choices);
/// The value of an enum (see validation::names).
template <typename E>
E read_named(const YAML::Node& node, const std::string& where, const std::string& key) {
  return validation::named<E>(read_choice(node, where, key, validation::names<E>()), where, key);
}
/// `count` finite numbers as a list, or as a string of numbers with spaces between.
std::vector<double> read_numbers(const YAML::Node& node, const std::string& where, const std::string& key,
                                 std::size_t count);
/// A pose as `x y z qx qy qz qw` (list or string) [m, –]; the quaternion is normalised, a zero one is refused.
RigidTransform read_pose(const YAML::Node& node, const std::string& where, const std::string& key);

/// Refuses a node that is not a map, or one with a key that is not in `allowed` or is there twice; `prefix` goes before
/// the key in messages.
void check_keys(const YAML::Node& map, const std::string& where, const std::string& prefix,
                const std::vector<std::string>& allowed);

/// Parses a YAML file. An empty file is an empty map. Throws InputError with file:line for what cannot be read or
/// parsed, and for what aliases make endless or immense.
YAML::Node load_yaml_file(const std::string& path);

}  // namespace spring_workbench::config
