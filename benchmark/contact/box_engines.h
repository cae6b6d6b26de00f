#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "spring_workbench/scene/scene.h"

namespace spring_workbench::benchmark {

/// A scene of movable boxes on the bench, all of one friction. A held one goes where the hand has it, whatever it
/// meets.
struct BoxScene {
  scene::Scene scene;
  std::string held;                              ///< empty: none
  std::function<RigidTransform(double t)> X_WO;  ///< of the held one

  double friction() const { return scene.bodies.front().material.friction; }
  bool holds(const scene::Body& body) const { return body.name == held; }
  /// The edge lengths of a body, which is one box.
  static const Vector3d& size(const scene::Body& body) {
    return std::get<geometry::Box>(body.collision.front().geometry).size;
  }
};

/// A simulation of it.
class BoxWorld {
 public:
  virtual ~BoxWorld() = default;
  /// From `t` on, `h` [s] long.
  virtual void step(double t, double h) = 0;
  /// Of all bodies, in the scene's order.
  virtual std::vector<RigidTransform> poses() const = 0;
};

struct BoxEngine {
  std::string name;
  std::function<std::unique_ptr<BoxWorld>(const BoxScene& scene, double step)> make;
};
/// Engines as they are by default, but for Bullet's and ODE's numbers of iterations and MuJoCo's softness, which have
/// two values each, and without sleep.
std::vector<BoxEngine> bullet_boxes();
std::vector<BoxEngine> mujoco_boxes();
std::vector<BoxEngine> ode_boxes();

}  // namespace spring_workbench::benchmark
