#include <set>

#include "spring_workbench/config/yaml_fields.h"
#include "spring_workbench/fastrak/fastrak_source.h"

namespace spring_workbench::fastrak {

const std::vector<std::string>& fastrak_keys() {
  static const std::vector<std::string> keys{"port",        "baud",      "format",     "stations",
                                             "orientation", "redundant", "hemisphere", "stylus"};
  return keys;
}

namespace {

std::vector<int> read_stations(const YAML::Node& node, const std::string& where, const std::string& key) {
  std::vector<int> stations;
  for (const YAML::Node& entry : node) {
    stations.push_back(config::read_integer(entry, where, key, 1, kFastrakStations));
  }
  return stations;
}

/// A list of stations, or a single one.
std::vector<int> read_used_stations(const YAML::Node& node, const std::string& where) {
  const auto stations = node.IsScalar()
                            ? std::vector<int>{config::read_integer(node, where, "stations", 1, kFastrakStations)}
                            : read_stations(node, where, "stations");
  const std::set<int> different(stations.begin(), stations.end());
  if (stations.empty() || different.size() != stations.size()) {
    validation::refuse(where, "stations", "a list of distinct station numbers between 1 and 4");
  }
  return stations;
}

/// true: station 1, if it is in use; false: none; or a list of some of `stations`.
std::vector<int> read_styluses(const YAML::Node& node, const std::string& where, const std::vector<int>& stations) {
  if (node.IsScalar()) return config::read_bool(node, where, "stylus") ? std::vector<int>{1} : std::vector<int>();
  std::set<int> free(stations.begin(), stations.end());
  const std::vector<int> styluses = read_stations(node, where, "stylus");
  for (const int station : styluses) {
    if (free.erase(station) == 0)
      validation::refuse(where, "stylus", std::to_string(station), "distinct stations listed in ~stations");
  }
  return styluses;
}

}  // namespace

FastrakSettings read_fastrak_settings(const YAML::Node& map, const std::string& where) {
  FastrakSettings settings;
  if (map["port"]) settings.port = config::read_string(map["port"], where, "port");
  if (settings.port.empty()) validation::refuse(where, "port", settings.port, "a path");
  if (map["baud"]) {
    settings.baud = std::stoi(
        config::read_choice(map["baud"], where, "baud", {"2400", "4800", "9600", "19200", "38400", "57600", "115200"}));
  }
  if (map["format"]) {
    const bool binary = config::read_choice(map["format"], where, "format", {"binary", "ascii"}) == "binary";
    settings.format = binary ? FastrakFormat::binary : FastrakFormat::ascii;
  }
  if (map["stations"]) settings.stations = read_used_stations(map["stations"], where);
  if (map["orientation"]) {
    settings.euler = config::read_choice(map["orientation"], where, "orientation", {"quaternion", "euler"}) == "euler";
  }
  if (map["redundant"]) settings.redundant = config::read_bool(map["redundant"], where, "redundant");
  if (map["stylus"]) settings.styluses = read_styluses(map["stylus"], where, settings.stations);
  if (map["hemisphere"]) {
    const auto direction = config::read_numbers(map["hemisphere"], where, "hemisphere", 3);
    for (std::size_t i = 0; i < 3; ++i) {
      validation::check_number(where, "hemisphere", direction[i], validation::between(-1e3, 1e3));
      settings.hemisphere[static_cast<Eigen::Index>(i)] = direction[i];
    }
  }
  return settings;
}

}  // namespace spring_workbench::fastrak
