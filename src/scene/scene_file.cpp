#include "scene_file.h"

#include <filesystem>
#include <set>

#include "spring_workbench/config/yaml_fields.h"
#include "spring_workbench/scene/number_rules.h"

namespace spring_workbench::scene {
namespace {

const std::vector<std::string> default_keys = {"friction", "restitution", "density", "material_stiffness", "massless"};

/// A map of the file with optional keys.
struct Fields {
  const YAML::Node& map;
  std::string path, prefix;

  /// Sets `value` by one of the readers in config if the key exists.
  template <typename T, typename Read, typename... Rule>
  void operator()(const std::string& key, T& value, const Read& read, const Rule&... rule) const {
    if (map[key].IsDefined()) value = read(map[key], path, prefix + key, rule...);
  }
};

void read_material(const Fields& field, Material& material) {
  field("friction", material.friction, config::read_number, friction_rule());
  field("restitution", material.restitution, config::read_number, validation::between(0.0, 1.0));
  field("density", material.density, config::read_number, validation::positive().in("kg/m³"));
  field("material_stiffness", material.stiffness, config::read_number, validation::positive_or_infinite().in("N/m"));
}

ObjectEntry read_object(const YAML::Node& map, const std::string& path, const std::string& prefix,
                        const SceneFile& file) {
  std::vector<std::string> keys = default_keys;
  keys.insert(keys.end(), {"urdf", "pose"});
  config::check_keys(map, path, prefix, keys);
  ObjectEntry entry;
  entry.where = config::place(map, path);
  entry.material = file.settings.bench_material;
  entry.massless = file.massless;
  const Fields field{map, path, prefix};
  read_material(field, entry.material);
  field("massless", entry.massless, config::read_bool);
  field("urdf", entry.urdf, config::read_string);
  if (map["pose"].IsDefined() && !entry.urdf) {
    throw validation::InputError(validation::prefix(config::place(map["pose"], path), prefix + "pose") +
                                 "can only be given together with urdf; the scene's URDF places other objects");
  }
  field("pose", entry.X_WL, config::read_pose);
  return entry;
}

/// Points in a link frame, one per hand [m].
std::vector<Vector3d> read_grips(const YAML::Node& list, const std::string& path, const std::string& key) {
  if (!list.IsSequence() || list.size() == 0)
    validation::refuse(config::place(list, path), key, "a list of points, one per hand");
  std::vector<Vector3d> points;
  for (const YAML::Node& node : list) {
    const std::vector<double> p = config::read_numbers(node, path, key, 3);
    points.emplace_back(p[0], p[1], p[2]);
  }
  return points;
}

Target read_target(const YAML::Node& map, const std::string& path, const std::string& prefix) {
  config::check_keys(map, path, prefix, {"pose", "position_tolerance", "angle_tolerance", "max_force", "grips"});
  Target target;
  target.X_WL = config::read_required(map, path, prefix, "pose", config::read_pose);
  const Fields field{map, path, prefix};
  field("position_tolerance", target.position_tolerance, config::read_number, validation::positive().in("m"));
  field("angle_tolerance", target.angle_tolerance, config::read_number, validation::positive().in("rad"));
  field("max_force", target.max_force, config::read_number, validation::positive_or_infinite().in("N"));
  if (map["grips"].IsDefined()) target.p_LG = read_grips(map["grips"], path, prefix + "grips");
  return target;
}

std::vector<RigidTransform> read_handles(const YAML::Node& start, const std::string& path) {
  std::vector<std::string> keys = {handle_key(0), handle_key(1)};
  while (start.IsMap() && start[keys.back()].IsDefined()) keys.push_back(handle_key(keys.size()));
  config::check_keys(start, path, "start.", keys);
  keys.pop_back();
  std::vector<RigidTransform> handles;
  for (const std::string& key : keys)
    handles.push_back(config::read_required(start, path, "start.", key, config::read_pose));
  return handles;
}

void read_settings(const YAML::Node& map, const std::string& path, SceneFile& file) {
  Scene& scene = file.settings;
  const Fields field{map, path, ""};
  field("gravity", scene.gravity, config::read_number, gravity_rule());
  field("bench_height", scene.bench_height, config::read_number, validation::any_number().in("m"));
  field("force_scale", scene.force_scale, config::read_number, force_scale_rule());
  field("contact", scene.contact, config::read_named<ContactMode>);
  const std::vector<std::string> tools = {"spring", "spring_fork", "spring_probe", "direct", "ray"};
  field("tool", scene.tool, config::read_choice, tools);
  if (map["start"].IsDefined()) scene.X_WH_start = read_handles(map["start"], path);
  if (map["defaults"].IsDefined()) {
    const YAML::Node defaults = map["defaults"];
    config::check_keys(defaults, path, "defaults.", default_keys);
    const Fields field_of_all{defaults, path, "defaults."};
    read_material(field_of_all, scene.bench_material);
    field_of_all("massless", file.massless, config::read_bool);
  }
}

/// Calls `read` with name and node of each entry of the map under `key`, if there is one.
template <class Read>
void for_each_entry(const YAML::Node& map, const std::string& path, const std::string& key, const Read& read) {
  if (!map[key].IsDefined()) return;
  if (!map[key].IsMap()) validation::refuse(config::place(map[key], path), key, "a map of names");
  std::set<std::string> seen;
  for (const auto& entry : map[key]) {
    const std::string name = config::read_string(entry.first, path, key);
    if (!seen.insert(name).second)
      throw validation::InputError(validation::prefix(config::place(entry.first, path), key + "." + name) +
                                   "given twice");
    read(name, entry.second);
  }
}

}  // namespace

std::string yaml_next_to(const std::string& urdf) {
  namespace fs = std::filesystem;
  const auto exists = [](const fs::path& path) { return fs::symlink_status(path).type() != fs::file_type::not_found; };
  const fs::path yaml = fs::path(urdf).replace_extension(".yaml"), yml = fs::path(urdf).replace_extension(".yml");
  if (!exists(yml)) return yaml.string();
  if (exists(yaml))
    validation::refuse_because(urdf, "YAML file", "there are two next to it, .yaml and .yml: remove one");
  return yml.string();
}

SceneFile read_scene_file(const std::string& path) {
  const YAML::Node map = config::load_yaml_file(path);
  config::check_keys(
      map, path, "",
      {"gravity", "contact", "tool", "force_scale", "bench_height", "defaults", "objects", "targets", "start"});
  SceneFile file;
  read_settings(map, path, file);
  for_each_entry(map, path, "objects", [&](const std::string& name, const YAML::Node& node) {
    file.objects[name] = read_object(node, path, "objects." + name + ".", file);
  });
  for_each_entry(map, path, "targets", [&](const std::string& name, const YAML::Node& node) {
    const Target& target = file.settings.targets[name] = read_target(node, path, "targets." + name + ".");
    const std::size_t hands = file.settings.X_WH_start.size();
    if (target.p_LG.size() > hands) {
      validation::refuse(config::place(node["grips"], path), "targets." + name + ".grips",
                         "at most " + std::to_string(hands) + ", one for each handle of start, got " +
                             std::to_string(target.p_LG.size()) + " points");
    }
    file.targets[name] = config::place(node, path);
  });
  return file;
}

}  // namespace spring_workbench::scene
