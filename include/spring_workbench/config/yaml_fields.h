#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

#include "spring_workbench/math/rigid_transform.h"
#include "spring_workbench/validation/names.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::config {

/// `where` with the node's line in it ("scene.yaml:4"), if the node has one.
std::string place(const YAML::Node& node, const std::string& where);

// Typed readers of one YAML value. `where` names its origin (a file name, "command line"); messages add the line number
// if the node has one. Each throws InputError for a missing or invalid value.
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
/// Reads `count` finite numbers, given as a list or as a string separated by spaces.
std::vector<double> read_numbers(const YAML::Node& node, const std::string& where, const std::string& key,
                                 std::size_t count);
/// Reads a pose `x y z qx qy qz qw` (list or string) [m, –]. The quaternion is normalised; a zero one is refused.
RigidTransform read_pose(const YAML::Node& node, const std::string& where, const std::string& key);

/// A number, which may be infinite: yaml-cpp before 0.6.3 cannot read the infinity that it writes.
YAML::Node number_node(double number);

/// Reads the value of `key` in `map` by one of these readers. If it is missing, the message gives the line of the map.
/// `prefix` precedes the key in messages.
template <typename Read, typename... Rule>
auto read_required(const YAML::Node& map, const std::string& where, const std::string& prefix, const std::string& key,
                   const Read& read, const Rule&... rule) {
  const YAML::Node value = map[key];
  return read(value, value.IsDefined() ? where : place(map, where), prefix + key, rule...);
}

/// Throws InputError if the node is not a map, or if a key is duplicate or not in `allowed`. `prefix` precedes the key
/// in messages.
void check_keys(const YAML::Node& map, const std::string& where, const std::string& prefix,
                const std::vector<std::string>& allowed);

/// Parses a YAML file. An empty file is an empty map. Throws InputError with file:line if the file cannot be read or
/// parsed, if it has more than one document (`---`), or if its aliases make it endless or huge.
YAML::Node load_yaml_file(const std::string& path);

}  // namespace spring_workbench::config
