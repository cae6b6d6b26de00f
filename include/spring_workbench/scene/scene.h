#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "spring_workbench/geometry/shapes.h"

namespace spring_workbench::scene {

/// Gravitational acceleration on Earth [m/s²]: the default of a scene. In a scene without gravity, it is the factor
/// from mass to weight.
constexpr double default_gravity = 9.81;

/// Mass and inertia of a body.
struct MassProperties {
  double mass = 0.0;                      ///< mass [kg], ≥ 0
  Matrix3d inertia_O = Matrix3d::Zero();  ///< inertia about the centre of mass, axes of O [kg·m²]
};

/// Material of a body's surface.
struct Material {
  double friction = 0.5;     ///< Coulomb coefficient of friction, ≥ 0
  double restitution = 0.0;  ///< coefficient of restitution, 0 … 1
  double density = 1000.0;   ///< density [kg/m³], > 0
  /// Stiffness of the surface against a contact force [N/m], > 0; infinite: rigid.
  double stiffness = std::numeric_limits<double>::infinity();
};

/// Returns the compliance of two materials in contact, in series [m/N]; 0: both are rigid.
inline double contact_compliance(const Material& a, const Material& b) { return 1.0 / a.stiffness + 1.0 / b.stiffness; }

/// One rigid body of the scene: a URDF link with all links that fixed joints attach to it.
struct Body {
  std::string name;      ///< the URDF link's name; unique in the scene
  bool movable = false;  ///< whether the body can be held and pushed; otherwise it is fixed in world
  RigidTransform X_WO = RigidTransform::Identity();  ///< start pose of the object frame O in world
  RigidTransform X_OL = RigidTransform::Identity();  ///< the URDF link frame L in O (a translation: −centre of mass)
  MassProperties mass_properties;                    ///< zero for a body that is immovable or has no mass
  Material material;                                 ///< material of the whole surface
  std::vector<geometry::Shape> collision;            ///< shapes for contact
  std::vector<geometry::Shape> visual;  ///< shapes for display; if the URDF has none, the shapes for contact
};

/// Contact mode.
enum class ContactMode {
  none,     ///< no contact
  stop,     ///< a held or falling object stops at other bodies
  dynamic,  ///< it also moves other objects
};
/// The words for the contact modes in settings and scenes.
inline std::vector<std::string> names_of(ContactMode) { return {"none", "stop", "dynamic"}; }

/// Target of an object in an assembly task.
struct Target {
  RigidTransform X_WL = RigidTransform::Identity();  ///< pose of the object's link frame in world
  double position_tolerance = 0.01;                  ///< allowed distance from the target [m]
  double angle_tolerance = 0.1;                      ///< allowed angle from the target [rad]
  /// Largest force with which another body may press the object, as a mean over 20 ms [N], > 0. The object breaks if
  /// the force is larger.
  double max_force = std::numeric_limits<double>::infinity();
  /// Grip points of the hands that carry the object, in its link frame [m]; empty: one hand, at the centre of mass.
  std::vector<Vector3d> p_LG;
};

/// A scene as read from a URDF and the YAML file of the same name next to it.
struct Scene {
  std::string name;                         ///< name of the URDF file without .urdf
  std::string path;                         ///< path of the URDF
  std::vector<Body> bodies;                 ///< all bodies, movable and fixed
  double gravity = default_gravity;         ///< gravity along −z of world [m/s²], 0 … 1000
  double bench_height = 0.0;                ///< z of the workbench plane in world [m]
  Material bench_material;                  ///< material of the bench, and the default for the bodies
  ContactMode contact = ContactMode::stop;  ///< contact mode; the setting `contact` overrides it
  std::string tool = "spring_fork";         ///< tool of each hand at the start; the setting `tool` overrides it
  double force_scale = 1.0;                 ///< ratio of virtual to real force, 1e-9 … 1e9; the setting overrides it
  /// Start pose of the handle of each hand; at least one pose.
  std::vector<RigidTransform> X_WH_start = {RigidTransform::Identity()};
  std::map<std::string, Target> targets;  ///< targets of the objects in an assembly task, by the name of the object
  std::vector<std::string> warnings;      ///< one line for each repair made on loading, with the name of the link
};

/// Returns the folder of a ROS package, found below the colon-separated folders of ROS_PACKAGE_PATH, or an empty
/// string. It does not need ROS.
std::string find_package_in_ros_package_path(const std::string& package);

/// Reads a scene from a URDF, given by its path or `package://` URI, and from the YAML file of the same name next to
/// it, if there is one. If `roots` are given, all files must be in one of these folders or in a ROS package, after
/// symbolic links are resolved. `key`: what messages call the path, such as `command line: --scene`. Throws
/// InputError, with file, field, rule and value, for invalid input.
Scene load_scene(const std::string& path_or_uri, const std::vector<std::string>& roots = {},
                 const std::string& key = "scene");

/// Returns the index in `scene.bodies` of the body called `name`, or nothing if there is none.
std::optional<std::size_t> find_body(const Scene& scene, const std::string& name);

/// Returns the compliances of the materials of all bodies and, as the last one, of the bench [m/N].
inline std::vector<double> compliances(const Scene& scene) {
  std::vector<double> all;
  for (const Body& body : scene.bodies) all.push_back(1.0 / body.material.stiffness);
  all.push_back(1.0 / scene.bench_material.stiffness);
  return all;
}

}  // namespace spring_workbench::scene
