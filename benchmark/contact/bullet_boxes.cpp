#include <btBulletDynamicsCommon.h>

#include <cmath>

#include "benchmark/contact/box_engines.h"

namespace spring_workbench::benchmark {
namespace {

btVector3 to_bullet(const Vector3d& v) { return btVector3(v.x(), v.y(), v.z()); }
btTransform to_bullet(const RigidTransform& X) {
  const Quaterniond q(X.linear());
  return btTransform(btQuaternion(q.x(), q.y(), q.z(), q.w()), to_bullet(Vector3d(X.translation())));
}
RigidTransform from_bullet(const btTransform& X) {
  const btQuaternion q = X.getRotation();
  const btVector3& p = X.getOrigin();
  return make_transform(Vector3d(p.x(), p.y(), p.z()), Quaterniond(q.w(), q.x(), q.y(), q.z()));
}

class BulletBoxWorld final : public BoxWorld {
 public:
  BulletBoxWorld(const BoxScene& scene, int iterations) : scene_(scene), plane_(0.0, nullptr, &plane_shape_) {
    world_.setGravity(btVector3(0.0, 0.0, -scene.scene.gravity));
    world_.getSolverInfo().m_numIterations = iterations;
    plane_.setFriction(std::sqrt(scene.friction()));
    world_.addRigidBody(&plane_);
    for (const scene::Body& body : scene.scene.bodies) {
      shapes_.push_back(std::make_unique<btBoxShape>(to_bullet(Vector3d(0.5 * BoxScene::size(body)))));
      const bool held = scene.holds(body);
      const Vector3d inertia = body.mass_properties.inertia_O.diagonal();
      bodies_.push_back(std::make_unique<btRigidBody>(held ? 0.0 : body.mass_properties.mass, nullptr,
                                                      shapes_.back().get(), to_bullet(inertia)));
      btRigidBody& b = *bodies_.back();
      if (held) b.setCollisionFlags(b.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
      b.setWorldTransform(to_bullet(body.X_WO));
      b.setInterpolationWorldTransform(b.getWorldTransform());
      b.setFriction(std::sqrt(scene.friction()));
      b.setActivationState(DISABLE_DEACTIVATION);
      world_.addRigidBody(&b);
    }
  }
  ~BulletBoxWorld() override {
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
    world_.removeRigidBody(&plane_);
  }
  BulletBoxWorld(const BulletBoxWorld&) = delete;
  BulletBoxWorld& operator=(const BulletBoxWorld&) = delete;

  void step(double t, double h) override {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (!scene_.holds(scene_.scene.bodies[i])) continue;
      bodies_[i]->setInterpolationWorldTransform(to_bullet(scene_.X_WO(t)));  // Bullet computes its velocity from this
      bodies_[i]->setWorldTransform(to_bullet(scene_.X_WO(t + h)));
    }
    world_.stepSimulation(h, 0);
  }
  std::vector<RigidTransform> poses() const override {
    std::vector<RigidTransform> poses;
    for (const auto& body : bodies_) poses.push_back(from_bullet(body->getWorldTransform()));
    return poses;
  }

 private:
  BoxScene scene_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  btStaticPlaneShape plane_shape_{btVector3(0, 0, 1), 0.0};
  btRigidBody plane_;
  std::vector<std::unique_ptr<btBoxShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

}  // namespace

std::vector<BoxEngine> bullet_boxes() {
  const auto with = [](int iterations) {
    return [iterations](const BoxScene& scene, double) -> std::unique_ptr<BoxWorld> {
      return std::make_unique<BulletBoxWorld>(scene, iterations);
    };
  };
  return {{"bullet, 10 iterations", with(10)}, {"bullet, 100 iterations", with(100)}};
}

}  // namespace spring_workbench::benchmark
