#include <btBulletDynamicsCommon.h>

#include <cmath>

#include "benchmark/contact/drag.h"

namespace spring_workbench::benchmark {
namespace {

constexpr int default_iterations = 10, more_iterations = 100;  // of Bullet's solver, in a step

btVector3 to_bullet(const Vector3d& v) { return btVector3(v.x(), v.y(), v.z()); }
Vector3d from_bullet(const btVector3& v) { return Vector3d(v.x(), v.y(), v.z()); }

/// A box on a plane, and a hand that moves it.
class BulletDrag : public DragWorld {
 public:
  /// `iterations`: of the solver for contact and constraints.
  BulletDrag(const DragScene& scene, int iterations)
      : scene_(scene),
        box_shape_(to_bullet(Vector3d(0.5 * scene.size))),
        plane_(0.0, nullptr, &plane_shape_),
        box_(scene.mass, nullptr, &box_shape_, to_bullet(scene.inertia())) {
    world_.setGravity(btVector3(0.0, 0.0, -scene.gravity));
    box_.setCenterOfMassTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, 0.5 * scene.size.z())));
    box_.setInterpolationWorldTransform(box_.getCenterOfMassTransform());
    box_.setActivationState(DISABLE_DEACTIVATION);
    if (!scene.turns) box_.setAngularFactor(0.0);
    world_.getSolverInfo().m_numIterations = iterations;
    for (btRigidBody* body : {&plane_, &box_}) {
      body->setFriction(std::sqrt(scene.friction));
      world_.addRigidBody(body);
    }
  }
  ~BulletDrag() override {
    for (int i = world_.getNumConstraints() - 1; i >= 0; --i) world_.removeConstraint(world_.getConstraint(i));
    for (int i = world_.getNumCollisionObjects() - 1; i >= 0; --i) {
      world_.removeCollisionObject(world_.getCollisionObjectArray()[i]);
    }
  }
  BulletDrag(const BulletDrag&) = delete;
  BulletDrag& operator=(const BulletDrag&) = delete;

  RigidTransform box() const override {
    const btTransform& X = box_.getCenterOfMassTransform();
    const btQuaternion q = X.getRotation();
    return make_transform(from_bullet(X.getOrigin()), Quaterniond(q.w(), q.x(), q.y(), q.z()));
  }

 protected:
  DragScene scene_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  btStaticPlaneShape plane_shape_{btVector3(0, 0, 1), 0.0};
  btBoxShape box_shape_;
  btRigidBody plane_, box_;
};

/// Springs and dampers as a force at the beginning of each step.
class BulletForce final : public BulletDrag {
 public:
  using BulletDrag::BulletDrag;
  void step(double t, double h) override {
    const DragHand hand = drag_hand(scene_, t);
    const Vector3d stretched = hand.p_W - from_bullet(box_.getCenterOfMassPosition());
    const Vector3d rate = hand.v_W - from_bullet(box_.getLinearVelocity());
    const btQuaternion q = box_.getCenterOfMassTransform().getRotation();
    const btVector3 turned = q.getAngle() * q.getAxis();
    box_.applyCentralForce(to_bullet(Vector3d(scene_.stiffness() * stretched + scene_.damping() * rate)));
    box_.applyTorque(-scene_.turning_stiffness() * turned - scene_.turning_damping() * box_.getAngularVelocity());
    world_.stepSimulation(h, 0);
  }
};

/// btGeneric6DofSpring2Constraint to a kinematic hand, with its silent limit on the stiffness (its default) or without.
class BulletSpring2 final : public BulletDrag {
 public:
  BulletSpring2(const DragScene& scene, bool limited, int iterations)
      : BulletDrag(scene, iterations), hand_(0.0, nullptr, &hand_shape_) {
    hand_.setCollisionFlags(hand_.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
    hand_.setActivationState(DISABLE_DEACTIVATION);
    world_.addRigidBody(&hand_, 0, 0);  // without collisions
    const btTransform here = btTransform::getIdentity();
    coupling_ = std::make_unique<btGeneric6DofSpring2Constraint>(hand_, box_, here, here);
    for (int i = 0; i < 6; ++i) {
      coupling_->setLimit(i, 1.0, -1.0);
      coupling_->enableSpring(i, true);
      coupling_->setStiffness(i, i < 3 ? scene.stiffness() : scene.turning_stiffness(), limited);
      coupling_->setDamping(i, i < 3 ? scene.damping() : scene.turning_damping(), limited);
      coupling_->setEquilibriumPoint(i, 0.0);
    }
    world_.addConstraint(coupling_.get(), true);
  }
  ~BulletSpring2() override {
    world_.removeConstraint(coupling_.get());
    world_.removeRigidBody(&hand_);
  }
  void step(double t, double h) override {
    const btTransform now = hand_transform(t), next = hand_transform(t + h);
    hand_.setWorldTransform(now);
    // Bullet computes the hand's velocity from the difference of these two: that of the coming step.
    hand_.setInterpolationWorldTransform(btTransform(now.getBasis(), 2.0 * now.getOrigin() - next.getOrigin()));
    world_.stepSimulation(h, 0);
  }

 private:
  btTransform hand_transform(double t) const {
    return btTransform(btQuaternion::getIdentity(), to_bullet(drag_hand(scene_, t).p_W));
  }
  btSphereShape hand_shape_{0.01};
  btRigidBody hand_;
  std::unique_ptr<btGeneric6DofSpring2Constraint> coupling_;
};

}  // namespace

std::vector<DragMethod> bullet_drags() {
  const auto spring2 = [](bool limited, int iterations) {
    return [=](const DragScene& scene, double) -> std::unique_ptr<DragWorld> {
      return std::make_unique<BulletSpring2>(scene, limited, iterations);
    };
  };
  const auto force = [](const DragScene& scene, double) {
    return std::make_unique<BulletForce>(scene, default_iterations);
  };
  return {{"bullet_explicit", true, force},
          {"bullet_spring2", true, spring2(true, default_iterations)},
          {"bullet_spring2_unlimited", true, spring2(false, default_iterations)},
          {"bullet_spring2_tuned", true, spring2(true, more_iterations)}};
}

}  // namespace spring_workbench::benchmark
