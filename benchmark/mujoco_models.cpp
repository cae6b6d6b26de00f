#include "benchmark/mujoco_models.h"

#include <iomanip>
#include <sstream>

namespace spring_workbench::benchmark {
namespace {

std::ostringstream exact_stream() {
  std::ostringstream out;
  out << std::setprecision(17);
  return out;
}

std::string vector(const Vector3d& v) {
  std::ostringstream out = exact_stream();
  out << '"' << v.x() << ' ' << v.y() << ' ' << v.z() << '"';
  return out.str();
}

std::string inertial(double mass, const Vector3d& inertia, const Vector3d& p) {
  std::ostringstream out = exact_stream();
  out << "<inertial mass=\"" << mass << "\" diaginertia=" << vector(inertia) << " pos=" << vector(p) << "/>";
  return out.str();
}

/// The default room for contacts and constraints, 10 MB that each run would clear, is not needed.
std::string document(double gravity, const std::string& disabled, const std::string& world, const std::string& rest) {
  return "<mujoco><compiler angle=\"radian\" inertiafromgeom=\"false\" boundmass=\"0\" boundinertia=\"0\"/>"
         "<size njmax=\"50\" nconmax=\"1\"/><option gravity=" +
         vector(Vector3d(0.0, 0.0, -gravity)) + "><flag contact=\"disable\" " + disabled + "/></option><worldbody>" +
         world + "</worldbody>" + rest + "</mujoco>";
}

const char* single_joint(const Scenario& scene) { return scene.kind == SceneKind::stretch ? "slide" : "hinge"; }

std::string spring_joint(const Scenario& scene, int coordinate) {
  std::ostringstream out = exact_stream();
  out << "<joint type=\"" << (coordinate < 3 ? "slide" : "hinge")
      << "\" axis=" << vector(Vector3d::Unit(coordinate % 3)) << " stiffness=\"" << scene.stiffness[coordinate]
      << "\" damping=\"" << scene.damping[coordinate] << "\"/>";
  return out.str();
}

std::string object_model(const FreeBody& body, const std::string& joint) {
  return document(body.gravity, "constraint=\"disable\"",
                  "<body>" + joint + inertial(body.mass, body.inertia, Vector3d::Zero()) + "</body>", "");
}

}  // namespace

std::string mujoco_free_body_model(const FreeBody& body) { return object_model(body, "<freejoint/>"); }

std::string mujoco_object_model(const Scenario& scene) {
  if (scene.kind == SceneKind::six_dof) return mujoco_free_body_model(free_body(scene));
  return object_model(free_body(scene), std::string("<joint type=\"") + single_joint(scene) + "\" axis=\"0 0 1\"/>");
}

std::string mujoco_joint_model(const Scenario& scene) {
  std::string hand, springs;
  if (scene.kind == SceneKind::six_dof) {
    hand = "<freejoint/>" + inertial(kMujocoHandInertia, Vector3d::Constant(kMujocoHandInertia), Vector3d::Zero());
    for (int i = 0; i < 6; ++i) springs += spring_joint(scene, i);
  } else {
    std::ostringstream joint = exact_stream();
    joint << "<joint type=\"" << single_joint(scene) << "\" axis=\"0 0 1\" armature=\"" << kMujocoHandInertia << "\"/>";
    hand = joint.str() + inertial(1.0, Vector3d::Ones(), Vector3d::Zero());
    springs = spring_joint(scene, scene.single_coordinate());
  }
  return document(
      free_body(scene).gravity, "constraint=\"disable\"",
      "<body>" + hand + "<body>" + springs + inertial(scene.mass, scene.inertia, scene.p_EO) + "</body></body>", "");
}

std::string mujoco_weld_model(const Scenario& scene) {
  return document(free_body(scene).gravity, "refsafe=\"disable\"",
                  "<body name=\"hand\" mocap=\"true\"/><body name=\"object\"><freejoint/>" +
                      inertial(scene.mass, scene.inertia, Vector3d::Zero()) + "</body>",
                  "<equality><weld body1=\"hand\" body2=\"object\"/></equality>");
}

}  // namespace spring_workbench::benchmark
