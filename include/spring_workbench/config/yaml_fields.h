#pragma once

#include <yaml-cpp/yaml.h>

#include <limits>
#include <string>
#include <vector>

#include "spring_workbench/config/input_error.h"
#include "spring_workbench/math/rigid_transform.h"

namespace spring_workbench {

/// Which numbers a field allows. NaN is never allowed.
struct NumberRule {
  double min = -std::numeric_limits<double>::max();
  double max = std::numeric_limits<double>::max();
  bool min_allowed = true;        ///< false: must be greater than `min`
  bool infinity_allowed = false;  ///< true: `.inf` is allowed although it is greater than `max`

  bool allows(double value) const;
  std::string text() const;  ///< e.g. "a number > 0", "a number in [0, 1]"
};
inline NumberRule any_number() { return {}; }
inline NumberRule positive() { return {0.0, std::numeric_limits<double>::max(), false, false}; }
inline NumberRule not_negative() { return {0.0, std::numeric_limits<double>::max(), true, false}; }
inline NumberRule between(double min, double max) { return {min, max, true, false}; }

/// Throws InputError("<where>: <key>: <value> is not allowed: must be <rule>").
[[noreturn]] void refuse(const std::string& where, const std::string& key, const std::string& value,
                         const std::string& rule);

/// Throws (see `refuse`) unless the rule allows `value`.
void check_number(const std::string& where, const std::string& key, double value, const NumberRule& rule);

// Typed readers of one YAML value. `where` says where it came from (a file's name, "command line"); the line is added
// where the node knows it. Each throws InputError as above.
double read_number(const YAML::Node& node, const std::string& where, const std::string& key, const NumberRule& rule);
int read_integer(const YAML::Node& node, const std::string& where, const std::string& key, int min, int max);
bool read_bool(const YAML::Node& node, const std::string& where, const std::string& key);
std::string read_string(const YAML::Node& node, const std::string& where, const std::string& key);
std::string read_choice(const YAML::Node& node, const std::string& where, const std::string& key,
                        const std::vector<std::string>& choices);
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

/// "a, b, c"
std::string join(const std::vector<std::string>& words, const std::string& separator = ", ");

}  // namespace spring_workbench
