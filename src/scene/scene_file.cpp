#include "scene_file.h"

#include "spring_workbench/config/yaml_fields.h"

namespace spring_workbench::scene {
namespace {

const std::vector<std::string> material_keys = {"friction", "restitution", "density", "material_stiffness"};

std::string line_of(const YAML::Node& node, const std::string& path) {
  return path + ":" + std::to_string(node.Mark().line + 1);
}

void read_material(const YAML::Node& map, const std::string& path, const std::string& prefix, Material& material) {
  const auto number = [&](const std::string& key, const validation::NumberRule& rule, double& value) {
    if (map[key].IsDefined()) value = config::read_number(map[key], path, prefix + key, rule);
  };
  validation::NumberRule stiffness = validation::positive();
  stiffness.infinity_allowed = true;
  number("friction", validation::not_negative(), material.friction);
  number("restitution", validation::between(0.0, 1.0), material.restitution);
  number("density", validation::positive(), material.density);
  number("material_stiffness", stiffness, material.stiffness);
}

ObjectEntry read_object(const YAML::Node& map, const std::string& path, const std::string& prefix,
                        const Material& defaults) {
  std::vector<std::string> keys = material_keys;
  keys.insert(keys.end(), {"urdf", "pose", "massless"});
  config::check_keys(map, path, prefix, keys);
  ObjectEntry entry;
  entry.where = line_of(map, path);
  entry.material = defaults;
  read_material(map, path, prefix, entry.material);
  if (map["massless"].IsDefined()) entry.massless = config::read_bool(map["massless"], path, prefix + "massless");
  if (map["urdf"].IsDefined()) entry.urdf = config::read_string(map["urdf"], path, prefix + "urdf");
  if (map["pose"].IsDefined()) {
    if (!entry.urdf)
      validation::refuse(line_of(map["pose"], path), prefix + "pose", "without urdf", "given in the scene's URDF");
    entry.X_WL = config::read_pose(map["pose"], path, prefix + "pose");
  }
  return entry;
}

Target read_target(const YAML::Node& map, const std::string& path, const std::string& prefix) {
  config::check_keys(map, path, prefix, {"pose", "position_tolerance", "angle_tolerance"});
  Target target;
  target.X_WL = config::read_pose(map["pose"], path, prefix + "pose");
  const auto number = [&](const std::string& key, double& value) {
    if (map[key].IsDefined()) value = config::read_number(map[key], path, prefix + key, validation::positive());
  };
  number("position_tolerance", target.position_tolerance);
  number("angle_tolerance", target.angle_tolerance);
  return target;
}

void read_settings(const YAML::Node& map, const std::string& path, Scene& scene) {
  if (map["gravity"].IsDefined())
    scene.gravity = config::read_number(map["gravity"], path, "gravity", validation::not_negative());
  if (map["bench_height"].IsDefined()) {
    scene.bench_height = config::read_number(map["bench_height"], path, "bench_height", validation::any_number());
  }
  if (map["force_scale"].IsDefined()) {
    scene.force_scale = config::read_number(map["force_scale"], path, "force_scale", validation::positive());
  }
  if (map["contact"].IsDefined()) scene.contact = config::read_named<ContactMode>(map["contact"], path, "contact");
  if (map["tool"].IsDefined()) {
    scene.tool =
        config::read_choice(map["tool"], path, "tool", {"spring", "spring_fork", "spring_probe", "direct", "ray"});
  }
  if (map["start"].IsDefined()) {
    config::check_keys(map["start"], path, "start.", {"handle"});
    scene.X_WH_start = config::read_pose(map["start"]["handle"], path, "start.handle");
  }
  if (map["defaults"].IsDefined()) {
    config::check_keys(map["defaults"], path, "defaults.", material_keys);
    read_material(map["defaults"], path, "defaults.", scene.bench_material);
  }
}

/// Calls `read` with name and node of each entry of the map under `key`, where there is one.
template <class Read>
void for_each_entry(const YAML::Node& map, const std::string& path, const std::string& key, const Read& read) {
  if (!map[key].IsDefined()) return;
  if (!map[key].IsMap()) validation::refuse(line_of(map[key], path), key, "not a map", "a map of names");
  for (const auto& entry : map[key]) read(config::read_string(entry.first, path, key), entry.second);
}

}  // namespace

SceneFile read_scene_file(const std::string& path) {
  const YAML::Node map = config::load_yaml_file(path);
  config::check_keys(
      map, path, "",
      {"gravity", "contact", "tool", "force_scale", "bench_height", "defaults", "objects", "targets", "start"});
  SceneFile file;
  read_settings(map, path, file.settings);
  for_each_entry(map, path, "objects", [&](const std::string& name, const YAML::Node& node) {
    file.objects[name] = read_object(node, path, "objects." + name + ".", file.settings.bench_material);
  });
  for_each_entry(map, path, "targets", [&](const std::string& name, const YAML::Node& node) {
    file.settings.targets[name] = read_target(node, path, "targets." + name + ".");
    file.targets[name] = line_of(node, path);
  });
  return file;
}

}  // namespace spring_workbench::scene
