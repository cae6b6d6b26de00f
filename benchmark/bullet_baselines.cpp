#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <utility>

#include "benchmark/baselines.h"
#include "benchmark/held_body.h"
#include "benchmark/single_spring.h"
#include "benchmark/stepping_loop.h"

namespace spring_workbench::benchmark {
namespace {

btVector3 to_bullet(const Vector3d& v) { return btVector3(v.x(), v.y(), v.z()); }
Vector3d from_bullet(const btVector3& v) { return Vector3d(v.x(), v.y(), v.z()); }

btTransform to_bullet(const Matrix3d& R, const Vector3d& p) {
  return btTransform(btMatrix3x3(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)),
                     to_bullet(p));
}

/// A Bullet world that contains only the held object.
class BulletWorld {
 public:
  explicit BulletWorld(const FreeBody& body)
      : dispatcher_(&configuration_),
        world_(&dispatcher_, &broadphase_, &solver_, &configuration_),
        shape_(btVector3(0.1, 0.05, 0.025)),
        object_(body.mass, nullptr, &shape_, to_bullet(body.inertia)) {
    world_.setGravity(btVector3(0.0, 0.0, -body.gravity));
    const Matrix3d R = body.start.R_WO.toRotationMatrix();
    object_.setCenterOfMassTransform(to_bullet(R, body.start.p_WO));
    object_.setInterpolationWorldTransform(object_.getCenterOfMassTransform());
    object_.setLinearVelocity(to_bullet(body.start.v_WO_W));
    object_.setAngularVelocity(to_bullet(R * body.start.w_WO_O));
    object_.setActivationState(DISABLE_DEACTIVATION);
    add(object_);
  }
  ~BulletWorld() {
    for (int i = world_.getNumConstraints() - 1; i >= 0; --i) world_.removeConstraint(world_.getConstraint(i));
    for (int i = world_.getNumCollisionObjects() - 1; i >= 0; --i) {
      world_.removeCollisionObject(world_.getCollisionObjectArray()[i]);
    }
  }
  BulletWorld(const BulletWorld&) = delete;
  BulletWorld& operator=(const BulletWorld&) = delete;

  /// Adds a body without collisions.
  void add(btRigidBody& body) { world_.addRigidBody(&body, 0, 0); }
  void add(btTypedConstraint& constraint) { world_.addConstraint(&constraint, true); }
  void step(double h) { world_.stepSimulation(h, 0); }
  btRigidBody& object() { return object_; }

  BodyState object_state() const {
    const btTransform& X = object_.getCenterOfMassTransform();
    const btQuaternion q = X.getRotation();
    BodyState state;
    state.p_WO = from_bullet(X.getOrigin());
    state.R_WO = Quaterniond(q.w(), q.x(), q.y(), q.z());
    state.v_WO_W = from_bullet(object_.getLinearVelocity());
    state.w_WO_O = state.R_WO.conjugate() * from_bullet(object_.getAngularVelocity());
    return state;
  }

  Vector3d output(const Scenario& scene) const {
    const btTransform& X = object_.getCenterOfMassTransform();
    if (scene.kind != SceneKind::torsion) return from_bullet(X.getOrigin());
    return Vector3d(0.0, 0.0, twist());
  }

  double twist() const {
    const btMatrix3x3& R = object_.getCenterOfMassTransform().getBasis();
    return std::atan2(R[1][0], R[0][0]);
  }

 private:
  static constexpr int few = 16;  // objects and contacts; the default room, 5 MB, would be cleared for each run
  static btDefaultCollisionConstructionInfo room() {
    btDefaultCollisionConstructionInfo info;
    info.m_defaultMaxPersistentManifoldPoolSize = info.m_defaultMaxCollisionAlgorithmPoolSize = few;
    return info;
  }

  btDefaultCollisionConfiguration configuration_{room()};
  btCollisionDispatcher dispatcher_;
  btSimpleBroadphase broadphase_{few};
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_;
  btBoxShape shape_;
  btRigidBody object_;
};

/// The scene's law as a force at the beginning of each step.
class BulletExplicit : public Method {
 public:
  std::string name() const override { return "bullet_explicit"; }

  RunResult run(const Scenario& scene, double step) const override {
    BulletWorld world(free_body(scene));
    const SingleSpring spring(scene);
    btRigidBody& object = world.object();
    const auto push = [&](double t) {
      if (scene.kind == SceneKind::stretch) {
        const double z = object.getCenterOfMassPosition().z();
        object.applyCentralForce(
            btVector3(0.0, 0.0, spring.force(scalar_hand(scene, t), z, object.getLinearVelocity().z())));
      } else if (scene.kind == SceneKind::torsion) {
        object.applyTorque(
            btVector3(0.0, 0.0, spring.force(scalar_hand(scene, t), world.twist(), object.getAngularVelocity().z())));
      } else {
        const BodyState body = world.object_state();
        const BodyLoad load = bushing_load(scene, hand_state(scene, t), body);
        object.applyCentralForce(to_bullet(load.force_W));
        object.applyTorque(to_bullet(body.R_WO * load.moment_O));
      }
    };
    return stepping_loop(
        scene, step,
        [&](double t, double h) {
          push(t);
          world.step(h);
        },
        [&](double) { return world.output(scene); });
  }
};

/// btGeneric6DofSpring2Constraint between a kinematic hand and the object, the springs of the scene on, the unused
/// coordinates free.
class BulletSpring2 : public Method {
 public:
  explicit BulletSpring2(bool limited) : limited_(limited) {}
  std::string name() const override { return limited_ ? "bullet_spring2" : "bullet_spring2_unlimited"; }
  bool has_scene_law(const Scenario& scene) const override { return scene.kind != SceneKind::six_dof; }

  RunResult run(const Scenario& scene, double step) const override {
    BulletWorld world(free_body(scene));
    btSphereShape hand_shape(0.01);
    btRigidBody hand(0.0, nullptr, &hand_shape);
    hand.setCollisionFlags(hand.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
    hand.setActivationState(DISABLE_DEACTIVATION);
    const auto hand_transform = [&](double t) {
      const HandState state = hand_state(scene, t);
      return to_bullet(state.R_WT, state.p_WT);
    };
    btTransform next = hand_transform(0.0);
    world.add(hand);

    btGeneric6DofSpring2Constraint coupling(hand, world.object(), btTransform::getIdentity(),
                                            to_bullet(Matrix3d::Identity(), -scene.p_EO));
    for (int i = 0; i < 6; ++i) {
      coupling.setLimit(i, 1.0, -1.0);
      if (scene.stiffness[i] == 0.0) continue;
      coupling.enableSpring(i, true);
      coupling.setStiffness(i, scene.stiffness[i], limited_);
      coupling.setDamping(i, scene.damping[i], limited_);
      coupling.setEquilibriumPoint(i, 0.0);
    }
    world.add(coupling);
    return stepping_loop(
        scene, step,
        [&](double t, double dt) {
          const btTransform now = next;
          next = hand_transform(t + dt);
          hand.setWorldTransform(now);
          // Bullet computes the hand's velocity from the difference of these two: that of the coming step.
          hand.setInterpolationWorldTransform(btTransform(now.getBasis() * next.getBasis().transpose() * now.getBasis(),
                                                          2.0 * now.getOrigin() - next.getOrigin()));
          world.step(dt);
        },
        [&](double) { return world.output(scene); });
  }

 private:
  bool limited_;
};

class BulletBody final : public BodyEngine {
 public:
  BulletBody(const FreeBody& body, LoadLaw load) : world_(body), load_(std::move(load)) {}

  void step(double t, double h) override {
    const Wrench load = load_(t, h, state());
    world_.object().applyCentralForce(to_bullet(load.force));
    world_.object().applyTorque(to_bullet(load.moment));
    world_.step(h);
  }
  BodyState state() const override { return world_.object_state(); }

 private:
  BulletWorld world_;
  LoadLaw load_;
};

}  // namespace

std::vector<RodEngine> bullet_rods() {
  const auto make = [](const FreeBody& body, LoadLaw load) {
    return std::make_unique<BulletBody>(body, std::move(load));
  };
  return {{"bullet_explicit", RodForce::When::start_of_step, make},
          {"bullet_stable", RodForce::When::end_of_step, make}};
}

std::vector<MethodPtr> bullet_baselines() {
  std::vector<MethodPtr> baselines;
  baselines.push_back(std::make_unique<BulletExplicit>());
  baselines.push_back(std::make_unique<BulletSpring2>(true));
  baselines.push_back(std::make_unique<BulletSpring2>(false));
  return baselines;
}

}  // namespace spring_workbench::benchmark
