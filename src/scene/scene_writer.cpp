#include <tinyxml.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <filesystem>
#include <iomanip>
#include <limits>
#include <sstream>

#include "mesh_file.h"
#include "scene_file.h"
#include "spring_workbench/config/output_file.h"
#include "spring_workbench/config/yaml_fields.h"
#include "spring_workbench/geometry/shape_queries.h"
#include "spring_workbench/scene/editing.h"
#include "spring_workbench/validation/names.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::scene {
namespace {

namespace fs = std::filesystem;

std::string text_of(const std::vector<double>& numbers) {
  std::ostringstream text;
  text << std::setprecision(std::numeric_limits<double>::max_digits10);
  for (std::size_t i = 0; i < numbers.size(); ++i) text << (i > 0 ? " " : "") << numbers[i];
  return text.str();
}

std::string text_of(double number) { return text_of(std::vector<double>{number}); }
std::string text_of(const Vector3d& v) { return text_of(std::vector<double>{v.x(), v.y(), v.z()}); }

/// Roll, pitch and yaw. Roll and pitch are computed from the rotation that remains after the yaw, which is accurate in
/// every orientation.
Vector3d roll_pitch_yaw(const Matrix3d& R) {
  const double yaw = std::atan2(R(1, 0), R(0, 0));
  const Matrix3d rest = Eigen::AngleAxisd(-yaw, Vector3d::UnitZ()) * R;
  return {std::atan2(-rest(1, 2), rest(1, 1)), std::atan2(-rest(2, 0), rest(0, 0)), yaw};
}

TiXmlElement& add(TiXmlNode& parent, const std::string& name) {
  return *parent.LinkEndChild(new TiXmlElement(name))->ToElement();
}

void add_origin(TiXmlElement& parent, const RigidTransform& X) {
  TiXmlElement& origin = add(parent, "origin");
  origin.SetAttribute("xyz", text_of(Vector3d(X.translation())));
  origin.SetAttribute("rpy", text_of(roll_pitch_yaw(X.linear())));
}

void add_geometry(TiXmlElement& parent, const geometry::Geometry& geometry, const std::string& body) {
  TiXmlElement& kind = add(parent, "geometry");
  if (const auto* box = std::get_if<geometry::Box>(&geometry)) {
    add(kind, "box").SetAttribute("size", text_of(box->size));
  } else if (const auto* sphere = std::get_if<geometry::Sphere>(&geometry)) {
    add(kind, "sphere").SetAttribute("radius", text_of(sphere->radius));
  } else if (const auto* cylinder = std::get_if<geometry::Cylinder>(&geometry)) {
    TiXmlElement& of = add(kind, "cylinder");
    of.SetAttribute("radius", text_of(cylinder->radius));
    of.SetAttribute("length", text_of(cylinder->length));
  } else {
    const geometry::TriangleMesh& mesh = *std::get<geometry::MeshPtr>(geometry);
    if (mesh.uri.empty())
      validation::refuse_because("", "mesh of " + body, "was not read from a file, so no URDF can refer to it");
    TiXmlElement& of = add(kind, "mesh");
    of.SetAttribute("filename", mesh.uri);
    of.SetAttribute("scale", text_of(mesh.scale));
  }
}

/// Adds the inertial of a movable body, at its centre of mass. A massless body gets a mass, which the YAML file sets to
/// zero again.
void add_inertial(TiXmlElement& link, const Body& body) {
  const double mass = body.mass_properties.mass;
  const std::vector<geometry::Shape>& shapes = body.collision.empty() ? body.visual : body.collision;
  const double size = shapes.empty() ? 1.0 : geometry::bounding_radius(shapes);
  const Matrix3d I = mass > 0.0 ? body.mass_properties.inertia_O : Matrix3d(0.1 * size * size * Matrix3d::Identity());
  TiXmlElement& inertial = add(link, "inertial");
  add_origin(inertial, body.X_OL.inverse());
  add(inertial, "mass").SetAttribute("value", text_of(mass > 0.0 ? mass : 1.0));
  TiXmlElement& inertia = add(inertial, "inertia");
  const char* const names[3][3] = {{"ixx", "ixy", "ixz"}, {"", "iyy", "iyz"}, {"", "", "izz"}};
  for (int row = 0; row < 3; ++row) {
    for (int column = row; column < 3; ++column) {
      inertia.SetAttribute(std::string(names[row][column]), text_of(I(row, column)));
    }
  }
}

void fill_link(TiXmlElement& link, const Body& body) {
  if (body.movable) add_inertial(link, body);
  const RigidTransform X_LO = body.X_OL.inverse();
  for (const geometry::Shape& shape : body.collision) {
    TiXmlElement& collision = add(link, "collision");
    add_origin(collision, X_LO * shape.X_OS);
    add_geometry(collision, shape.geometry, body.name);
  }
  int number = 0;
  for (const geometry::Shape& shape : body.visual) {
    TiXmlElement& visual = add(link, "visual");
    add_origin(visual, X_LO * shape.X_OS);
    add_geometry(visual, shape.geometry, body.name);
    if (!shape.color_given) continue;
    TiXmlElement& material = add(visual, "material");
    material.SetAttribute("name", body.name + " " + std::to_string(number++));
    const Eigen::Vector4d& c = shape.color;
    add(material, "color").SetAttribute("rgba", text_of(std::vector<double>{c[0], c[1], c[2], c[3]}));
  }
}

bool is_root(const Body& body) { return body.name == "world" || body.name == "workbench"; }

std::string urdf_of(const Scene& scene) {
  TiXmlDocument document;
  document.LinkEndChild(new TiXmlDeclaration("1.0", "", ""));
  TiXmlElement& robot = add(document, "robot");
  robot.SetAttribute("name", scene.name);
  const bool has_root = !scene.bodies.empty() && is_root(scene.bodies.front());
  const std::string root = has_root ? scene.bodies.front().name : "world";
  if (!has_root) add(robot, "link").SetAttribute("name", root);
  int number = 0;
  for (const Body& body : scene.bodies) {
    TiXmlElement& link = add(robot, "link");
    link.SetAttribute("name", body.name);
    fill_link(link, body);
    if (is_root(body)) continue;
    TiXmlElement& joint = add(robot, "joint");
    std::ostringstream name;  // bodies are read in the order of the joint names
    name << std::setw(6) << std::setfill('0') << number++ << " " << body.name;
    joint.SetAttribute("name", name.str());
    joint.SetAttribute("type", body.movable ? "floating" : "fixed");
    add_origin(joint, body.X_WO * body.X_OL);
    add(joint, "parent").SetAttribute("link", root);
    add(joint, "child").SetAttribute("link", body.name);
  }
  TiXmlPrinter printer;
  printer.SetIndent("  ");
  document.Accept(&printer);
  return printer.Str();
}

YAML::Node numbers(const RigidTransform& X) {
  YAML::Node list;
  const Quaterniond q(X.linear());
  for (const double number :
       {X.translation().x(), X.translation().y(), X.translation().z(), q.x(), q.y(), q.z(), q.w()}) {
    list.push_back(number);
  }
  list.SetStyle(YAML::EmitterStyle::Flow);
  return list;
}

YAML::Node node_of(const Material& material) {
  YAML::Node node;
  node["friction"] = material.friction;
  node["restitution"] = material.restitution;
  node["density"] = material.density;
  node["material_stiffness"] = config::number_node(material.stiffness);
  return node;
}

std::string yaml_of(const Scene& scene) {
  YAML::Node map;
  map["gravity"] = scene.gravity;
  map["contact"] = validation::name_of(scene.contact);
  map["tool"] = scene.tool;
  map["force_scale"] = scene.force_scale;
  map["bench_height"] = scene.bench_height;
  for (std::size_t hand = 0; hand < scene.X_WH_start.size(); ++hand)
    map["start"][handle_key(hand)] = numbers(scene.X_WH_start[hand]);
  map["defaults"] = node_of(scene.bench_material);
  for (const Body& body : scene.bodies) {
    YAML::Node object = node_of(body.material);
    if (body.movable && !(body.mass_properties.mass > 0.0)) object["massless"] = true;
    map["objects"][body.name] = object;
  }
  for (const auto& [name, target] : scene.targets) {
    YAML::Node node;
    node["pose"] = numbers(target.X_WL);
    node["position_tolerance"] = target.position_tolerance;
    node["angle_tolerance"] = target.angle_tolerance;
    node["max_force"] = config::number_node(target.max_force);
    for (const Vector3d& p : target.p_LG) node["grips"].push_back(std::vector<double>{p.x(), p.y(), p.z()});
    map["targets"][name] = node;
  }
  YAML::Emitter text;
  text.SetDoublePrecision(std::numeric_limits<double>::max_digits10);
  text << map;
  return std::string(text.c_str()) + "\n";
}

}  // namespace

std::string save_scene(const Scene& scene, const std::string& path, const std::vector<std::string>& roots) {
  const fs::path urdf = resolve_new_file(path, roots, "", "path");
  if (urdf.extension() != ".urdf") validation::refuse("", "path", path, "a path that ends in .urdf");
  config::OutputFile new_urdf(urdf.string()), new_yaml(yaml_next_to(urdf.string()));
  new_urdf.write(urdf_of(scene));
  new_yaml.write(yaml_of(scene));
  new_yaml.commit();
  new_urdf.commit();
  return urdf.string();
}

}  // namespace spring_workbench::scene
