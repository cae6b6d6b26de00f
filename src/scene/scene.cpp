#include "spring_workbench/scene/scene.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>

#include "mass.h"
#include "mesh_file.h"
#include "scene_file.h"
#include "spring_workbench/config/yaml_fields.h"
#include "spring_workbench/geometry/shape_queries.h"
#include "spring_workbench/scene/editing.h"
#include "urdf_bodies.h"
#include "urdf_file.h"

namespace spring_workbench::scene {
namespace {

namespace fs = std::filesystem;

double lowest_point(const Body& body) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const geometry::Shape& shape : body.collision.empty() ? body.visual : body.collision) {
    lowest = std::min(lowest, geometry::bounding_box(shape.geometry, body.X_WO * shape.X_OS).min().z());
  }
  return lowest;
}

/// Lifts or lowers the bodies of an object such that the first one, if it is movable, stands on the bench.
void lay_on_bench(double bench_height, std::vector<Body>& bodies) {
  if (bodies.empty() || !bodies.front().movable) return;
  const double lowest = lowest_point(bodies.front());
  if (!std::isfinite(lowest)) return;  // no shapes
  for (Body& body : bodies) body.X_WO.pretranslate(Vector3d(0.0, 0.0, bench_height - lowest));
}

/// The single body of an object's own URDF, at `X_WL` or on the bench. `given`: name of the URDF in messages.
Body build_object(const UrdfFile& urdf, const std::optional<RigidTransform>& X_WL, const Material& material,
                  double bench_height, MeshCache& meshes, std::vector<std::string>& warnings, const std::string& where,
                  const std::string& key, const std::string& given) {
  std::vector<Body> bodies = build_bodies(
      urdf, X_WL.value_or(RigidTransform::Identity()), [&](const std::string&) { return material; }, meshes, warnings);
  if (bodies.size() != 1 || is_bench_scene(urdf)) {
    validation::refuse(where, key, given, "the URDF of one object (one body, root not world or workbench)");
  }
  if (!X_WL) lay_on_bench(bench_height, bodies);
  return std::move(bodies.front());
}

/// Refuses an object with the name of a frame that the nodes publish.
void check_name(const std::string& name, const std::string& where, const std::string& key) {
  static const std::set<std::string> frames{"stylus", "head", "eye_left", "eye_right", "fork_handle", "fork_tip"};
  const std::size_t number = name.find_last_not_of("0123456789") + 1;  // where the digits at the end begin
  const bool numbered = number < name.size() && number > 0 && name[number - 1] == '_';
  const std::string unnumbered = numbered ? name.substr(0, number - 1) : name;
  if (name != "world" && name != "workbench" && frames.count(unnumbered) == 0) return;
  validation::refuse(where, key, name,
                     "a name that is not that of a frame (world, workbench, stylus, head, eye_left, eye_right, "
                     "fork_handle, fork_tip; also with a number, as fork_tip_2)");
}

/// Assembles a scene from its URDF, the YAML file next to it and the URDFs that this file refers to.
class SceneLoader {
 public:
  SceneLoader(const std::string& path, const std::vector<std::string>& roots)
      : path_(path), roots_(roots), meshes_(roots) {}

  Scene load() {
    const fs::path yaml = yaml_next_to(path_);
    if (fs::symlink_status(yaml).type() != fs::file_type::not_found) {
      file_ = read_scene_file(resolve_file(yaml.string(), "", roots_, path_, "the YAML file next to it"));
    }
    scene_ = file_.settings;
    scene_.name = fs::path(path_).stem().string();
    scene_.path = path_;
    add_urdf();
    for (const auto& [name, entry] : file_.objects) {
      if (entry.urdf) add_object(name, entry);
    }
    check_names();
    for (Body& body : scene_.bodies) {
      const auto entry = file_.objects.find(body.name);
      const bool massless = entry != file_.objects.end() ? entry->second.massless : file_.massless;
      if (massless) body.mass_properties = MassProperties();
    }
    return std::move(scene_);
  }

 private:
  Material material_of(const std::string& body) const {
    const auto entry = file_.objects.find(body);
    return entry != file_.objects.end() ? entry->second.material : scene_.bench_material;
  }

  UrdfFile read_urdf(const std::string& path) {
    UrdfFile urdf = read_urdf_file(path);
    scene_.warnings.insert(scene_.warnings.end(), urdf.warnings.begin(), urdf.warnings.end());
    return urdf;
  }

  void add_urdf() {
    const UrdfFile urdf = read_urdf(path_);
    scene_.bodies = build_bodies(
        urdf, RigidTransform::Identity(), [this](const std::string& body) { return material_of(body); }, meshes_,
        scene_.warnings);
    for (const Body& body : scene_.bodies) {
      if (body.movable) check_name(body.name, urdf.where(body.name), "name");
    }
    if (!is_bench_scene(urdf)) lay_on_bench(scene_.bench_height, scene_.bodies);
  }

  void add_object(const std::string& name, const ObjectEntry& entry) {
    const std::string key = "objects." + name + ".urdf";
    check_name(name, entry.where, "objects");
    const std::string folder = fs::path(path_).parent_path().string();
    const UrdfFile urdf = read_urdf(resolve_file(*entry.urdf, folder, roots_, entry.where, key));
    Body body = build_object(urdf, entry.X_WL, entry.material, scene_.bench_height, meshes_, scene_.warnings,
                             entry.where, key, *entry.urdf);
    if (find_body(scene_, name))
      validation::refuse(entry.where, "objects." + name, name, "a name that the scene's URDF does not use");
    body.name = name;
    scene_.bodies.push_back(std::move(body));
  }

  /// Checks that the bodies named in the YAML file exist.
  void check_names() const {
    std::vector<std::string> names;
    for (const Body& body : scene_.bodies) names.push_back(body.name);
    const std::string rule = "a body of the scene (" + validation::join(names) + ")";
    for (const auto& [name, entry] : file_.objects) {
      if (!find_body(scene_, name)) validation::refuse(entry.where, "objects", name, rule);
    }
    for (const auto& [name, where] : file_.targets) movable_body(scene_, name, where, "targets");
  }

  std::string path_;
  std::vector<std::string> roots_;
  MeshCache meshes_;
  SceneFile file_;
  Scene scene_;
};

}  // namespace

Scene load_scene(const std::string& path_or_uri, const std::vector<std::string>& roots, const std::string& key) {
  const std::string path = resolve_file(path_or_uri, "", roots, "", key);
  return SceneLoader(path, roots).load();
}

Body read_object(const std::string& name, const std::string& urdf, const std::optional<RigidTransform>& X_WL,
                 const Scene& scene, const std::vector<std::string>& roots, const std::string& where) {
  if (name.empty() || find_body(scene, name)) validation::refuse(where, "name", name, "a name that is not in use");
  check_name(name, where, "name");
  const std::string folder = fs::path(scene.path).parent_path().string();
  const UrdfFile file = read_urdf_file(resolve_file(urdf, folder, roots, where, "urdf"));
  std::vector<std::string> warnings;
  MeshCache meshes(roots, scene.bodies);
  Body body = build_object(file, X_WL, scene.bench_material, scene.bench_height, meshes, warnings, where, "urdf", urdf);
  body.name = name;
  return body;
}

std::size_t movable_body(const Scene& scene, const std::string& name, const std::string& where,
                         const std::string& key) {
  const std::optional<std::size_t> index = find_body(scene, name);
  if (index && scene.bodies[*index].movable) return *index;
  std::vector<std::string> movable;
  for (const Body& b : scene.bodies) {
    if (b.movable) movable.push_back(b.name);
  }
  validation::refuse(where, key, name, "a movable object of the scene (" + validation::join(movable) + ")");
}

void set_mass(Body& body, double mass, const std::string& where) {
  MassProperties& m = body.mass_properties;
  if (mass > 0.0 && m.mass > 0.0) {
    m.inertia_O *= mass / m.mass;
  } else if (mass > 0.0) {
    std::vector<std::string> warnings;
    const RigidMass solid = solid_mass(body.collision.empty() ? body.visual : body.collision, 1.0, where, warnings);
    if (!(solid.mass > 0.0)) {
      validation::refuse(where, "mass", validation::number_text(mass),
                         "0, because " + body.name + " has no volume from which to compute an inertia");
    }
    m.inertia_O = mass / solid.mass * solid.inertia;
  } else {
    m.inertia_O.setZero();
  }
  m.mass = mass;
}

std::optional<std::size_t> find_body(const Scene& scene, const std::string& name) {
  const auto body =
      std::find_if(scene.bodies.begin(), scene.bodies.end(), [&](const Body& b) { return b.name == name; });
  if (body == scene.bodies.end()) return std::nullopt;
  return static_cast<std::size_t>(body - scene.bodies.begin());
}

}  // namespace spring_workbench::scene
