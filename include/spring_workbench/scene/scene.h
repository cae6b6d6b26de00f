#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "spring_workbench/geometry/shapes.h"

namespace spring_workbench::scene {

/// Gravitational acceleration on Earth [m/s²]: the default of a scene, and the factor from mass to weight in a scene
/// without gravity. Weights scale with it. Test: Calibration.NoLoadNoGravityStaysPositive.
constexpr double default_gravity = 9.81;

/// Mass [kg], and inertia tensor [kg·m²] about the centre of mass in the axes of O.
struct MassProperties {
  double mass = 0.0;                      ///< [kg]
  Matrix3d inertia_O = Matrix3d::Zero();  ///< [kg·m²]
};

/// Material of a body's surface.
struct Material {
  double friction = 0.5;                                       ///< Coulomb coefficient, ≥ 0
  double restitution = 0.0;                                    ///< 0 … 1
  double density = 1000.0;                                     ///< [kg/m³], > 0
  double stiffness = std::numeric_limits<double>::infinity();  ///< of the surface against a contact force [N/m], > 0;
                                                               ///< infinite: rigid
};

/// Compliance of two materials in contact, in series [m/N]; 0: both are rigid.
inline double contact_compliance(const Material& a, const Material& b) { return 1.0 / a.stiffness + 1.0 / b.stiffness; }

/// One rigid body of the scene: a URDF link with all links that fixed joints attach to it.
struct Body {
  std::string name;      ///< the URDF link's name; unique in the scene
  bool movable = false;  ///< whether it can be held and pushed; otherwise it is fixed in world
  RigidTransform X_WO = RigidTransform::Identity();  ///< start pose of the object frame O in world
  RigidTransform X_OL = RigidTransform::Identity();  ///< the URDF link frame L in O (a translation: −centre of mass)
  MassProperties mass_properties;                    ///< zero for a body that is immovable or has no mass
  Material material;                                 ///< of its whole surface
  std::vector<geometry::Shape> collision;            ///< its shape for contact
  std::vector<geometry::Shape> visual;               ///< the collision shapes if the URDF has no visual
};

/// Contact: none; `stop`: the held or falling object stops at the others; `dynamic`: it also moves them.
enum class ContactMode { none, stop, dynamic };
/// Their words in settings and scenes.
inline std::vector<std::string> names_of(ContactMode) { return {"none", "stop", "dynamic"}; }

/// Target of an object in an assembly: pose of its link frame in world, with tolerances [m, rad].
struct Target {
  RigidTransform X_WL = RigidTransform::Identity();            ///< pose of its link frame in world
  double position_tolerance = 0.01;                            ///< [m]
  double angle_tolerance = 0.1;                                ///< [rad]
  double max_force = std::numeric_limits<double>::infinity();  ///< [N], > 0: the object breaks if another body presses
                                                               ///< it by more in the mean over 20 ms
  std::vector<Vector3d> p_LG;  ///< grip points of the hands that carry it, in its link frame [m]; empty: one hand, at
                               ///< its centre of mass
};

/// A scene as read from a URDF and the YAML file of the same name next to it.
struct Scene {
  std::string name;                         ///< name of the URDF file without .urdf
  std::string path;                         ///< path of the URDF
  std::vector<Body> bodies;                 ///< all bodies, movable and fixed
  double gravity = default_gravity;         ///< [m/s²], along −z of world; ≥ 0
  double bench_height = 0.0;                ///< z of the workbench plane in world [m]
  Material bench_material;                  ///< material of the bench, and the default for the bodies
  ContactMode contact = ContactMode::stop;  ///< the setting `contact` overrides it
  std::string tool = "spring_fork";         ///< tool of each hand at the start; the setting `tool` overrides it
  double force_scale = 1.0;                 ///< ratio of virtual to real force, > 0
  std::vector<RigidTransform> X_WH_start = {
      RigidTransform::Identity()};        ///< start pose of each hand's handle; at least one
  std::map<std::string, Target> targets;  ///< where the objects belong in an assembly, by name
  std::vector<std::string> warnings;      ///< one line for each repair made on loading, with the name of the link
};

/// Returns the folder of a package below the colon-separated folders of ROS_PACKAGE_PATH, or an empty string. Does not
/// need ROS.
std::string find_package_in_ros_package_path(const std::string& package);

/// Reads a scene from a URDF, given by its path or `package://` URI, and the YAML file next to it, if there is one.
/// After resolving symbolic links, all files must be in one of the folders `roots` or in a ROS package; with no
/// `roots`, they may be anywhere. `name` is what messages call the path, such as `command line: --scene`. Throws
/// InputError with file, field, rule and value for invalid input.
Scene load_scene(const std::string& path_or_uri, const std::vector<std::string>& roots = {},
                 const std::string& name = "scene");

/// Index of the body called `name`, or nothing.
std::optional<std::size_t> find_body(const Scene& scene, const std::string& name);

/// Compliances of the materials of all bodies, and of the bench as the last one [m/N].
inline std::vector<double> compliances(const Scene& scene) {
  std::vector<double> all;
  for (const Body& body : scene.bodies) all.push_back(1.0 / body.material.stiffness);
  all.push_back(1.0 / scene.bench_material.stiffness);
  return all;
}

}  // namespace spring_workbench::scene
