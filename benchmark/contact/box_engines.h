#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "spring_workbench/scene/scene.h"

namespace spring_workbench::benchmark {

/// A scene of movable boxes on the bench, all with the same friction. A held box follows the hand regardless of
/// contact.
struct BoxScene {
  scene::Scene scene;
  std::string held;                              ///< empty: none
  std::function<RigidTransform(double t)> X_WO;  ///< motion of the held box

  double friction() const { return scene.bodies.front().material.friction; }
  bool holds(const scene::Body& body) const { return body.name == held; }
  /// The edge lengths of a body that consists of one box.
  static const Vector3d& size(const scene::Body& body) {
    return std::get<geometry::Box>(body.collision.front().geometry).size;
  }
};

/// A simulation of the scene.
class BoxWorld {
 public:
  virtual ~BoxWorld() = default;
  /// Takes a step of `h` [s] from time `t` [s].
  virtual void step(double t, double h) = 0;
  /// Poses of all bodies, in the scene's order.
  virtual std::vector<RigidTransform> poses() const = 0;
};

struct BoxEngine {
  std::string name;
  std::function<std::unique_ptr<BoxWorld>(const BoxScene& scene, double step)> make;
};
/// Engines with default settings but without sleeping, and with two values each for the number of iterations (Bullet,
/// ODE) and the softness (MuJoCo).
std::vector<BoxEngine> bullet_boxes();
std::vector<BoxEngine> mujoco_boxes();
std::vector<BoxEngine> ode_boxes();

}  // namespace spring_workbench::benchmark
