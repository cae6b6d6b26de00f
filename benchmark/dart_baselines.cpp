#include <dart/dynamics/BallJoint.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/PrismaticJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/dynamics/TranslationalJoint.hpp>
#include <dart/simulation/World.hpp>
#include <utility>

#include "benchmark/baselines.h"
#include "benchmark/held_body.h"
#include "benchmark/stepping_loop.h"

namespace spring_workbench::benchmark {
namespace {

using dart::dynamics::BodyNode;
using dart::dynamics::Inertia;
using dart::dynamics::Joint;
using dart::dynamics::Skeleton;
using dart::dynamics::SkeletonPtr;

void set_spring(Joint* joint, const Scenario& scene, int first) {
  for (std::size_t i = 0; i < joint->getNumDofs(); ++i) {
    joint->setSpringStiffness(i, scene.stiffness[first + static_cast<int>(i)]);
    joint->setDampingCoefficient(i, scene.damping[first + static_cast<int>(i)]);
  }
}

Inertia object_inertia(const Scenario& scene) {
  Inertia inertia;
  inertia.setMass(scene.mass);
  inertia.setLocalCOM(scene.p_EO);
  inertia.setMoment(scene.inertia.asDiagonal().toDenseMatrix());
  return inertia;
}

/// A hand on a joint with prescribed acceleration, and the object connected to it by joints with implicit springs: a
/// slide or a hinge (A, B), or a translational and a ball joint with a body of negligible mass in between (C).
class DartWorld {
 public:
  DartWorld(const Scenario& scene, double h) : scene_(scene), skeleton_(Skeleton::create("fork")) {
    world_->setTimeStep(h);
    world_->setGravity(Vector3d(0.0, 0.0, scene.kind == SceneKind::torsion ? 0.0 : -scene.gravity));
    if (scene.kind == SceneKind::six_dof) {
      build_six_dof();
    } else if (scene.kind == SceneKind::stretch) {
      build_single<dart::dynamics::PrismaticJoint>();
    } else {
      build_single<dart::dynamics::RevoluteJoint>();
    }
    skeleton_->getRootJoint()->setActuatorType(Joint::ACCELERATION);
    world_->addSkeleton(skeleton_);
  }

  void step(double t) {
    place_hand(t);
    Joint* hand = skeleton_->getRootJoint();
    set_hand_acceleration(t);
    hand->setCommands(hand->getAccelerations());
    world_->step();
  }

  Vector3d output(double t) {
    place_hand(t);
    if (scene_.kind != SceneKind::six_dof) {
      return Vector3d(0.0, 0.0, skeleton_->getPosition(0) + skeleton_->getPosition(1));
    }
    return skeleton_->getBodyNode(2)->getCOM();
  }

 private:
  template <typename SingleJoint>
  void build_single() {
    typename SingleJoint::Properties axis;
    axis.mAxis = Vector3d::UnitZ();
    BodyNode* hand = skeleton_->createJointAndBodyNodePair<SingleJoint>(nullptr, axis).second;
    const auto object = hand->createChildJointAndBodyNodePair<SingleJoint>(axis);
    set_spring(object.first, scene_, scene_.single_coordinate());
    object.second->setInertia(object_inertia(scene_));
  }

  void build_six_dof() {
    BodyNode* hand = skeleton_->createJointAndBodyNodePair<dart::dynamics::FreeJoint>().second;
    const auto slider = hand->createChildJointAndBodyNodePair<dart::dynamics::TranslationalJoint>();
    slider.second->setInertia(Inertia(1e-9, Vector3d::Zero(), 1e-12 * Matrix3d::Identity()));
    const auto object = slider.second->createChildJointAndBodyNodePair<dart::dynamics::BallJoint>();
    set_spring(slider.first, scene_, 0);
    set_spring(object.first, scene_, 3);
    object.second->setInertia(object_inertia(scene_));
  }

  void place_hand(double t) {
    if (scene_.kind != SceneKind::six_dof) {
      const ScalarMotion& hand = single_.at(scene_, t);
      skeleton_->setPosition(0, hand.value);
      skeleton_->setVelocity(0, hand.rate);
      return;
    }
    const HandState& hand = hand_.at(scene_, t).state;
    Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();
    X_WT.linear() = hand.R_WT;
    X_WT.translation() = hand.p_WT;
    auto* joint = static_cast<dart::dynamics::FreeJoint*>(skeleton_->getRootJoint());
    joint->setTransform(X_WT);
    joint->setLinearVelocity(hand.v_WT_W);
    joint->setAngularVelocity(hand.R_WT * hand.w_WT_T);
  }

  void set_hand_acceleration(double t) {
    if (scene_.kind != SceneKind::six_dof) {
      skeleton_->setAcceleration(0, single_.at(scene_, t).acceleration);
      return;
    }
    const auto& [state, hand] = hand_.at(scene_, t);
    auto* joint = static_cast<dart::dynamics::FreeJoint*>(skeleton_->getRootJoint());
    joint->setLinearAcceleration(hand.a_WT_W);
    joint->setAngularAcceleration(state.R_WT * hand.alpha_WT_T);
  }

  Scenario scene_;
  RememberedMotion hand_;
  RememberedScalar single_;
  SkeletonPtr skeleton_;
  dart::simulation::WorldPtr world_ = dart::simulation::World::create();
};

class DartJointSprings : public Method {
 public:
  std::string name() const override { return "dart_joint_springs"; }
  bool has_scene_law(const Scenario& scene) const override { return scene.kind != SceneKind::six_dof; }

  RunResult run(const Scenario& scene, double step) const override {
    DartWorld world(scene, step_length(scene, step));
    return stepping_loop(
        scene, step, [&](double t, double) { world.step(t); }, [&](double t) { return world.output(t); });
  }
};

class DartBody final : public BodyEngine {
 public:
  DartBody(const FreeBody& body, LoadLaw load) : load_(std::move(load)) {
    const SkeletonPtr skeleton = Skeleton::create("object");
    const auto [joint, object] = skeleton->createJointAndBodyNodePair<dart::dynamics::FreeJoint>();
    object_ = object;
    Inertia inertia;
    inertia.setMass(body.mass);
    inertia.setMoment(body.inertia.asDiagonal().toDenseMatrix());
    object->setInertia(inertia);
    Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
    X_WO.linear() = body.start.R_WO.toRotationMatrix();
    X_WO.translation() = body.start.p_WO;
    joint->setTransform(X_WO);
    joint->setLinearVelocity(body.start.v_WO_W);
    joint->setAngularVelocity(body.start.R_WO * body.start.w_WO_O);
    world_->setGravity(Vector3d(0.0, 0.0, -body.gravity));
    world_->addSkeleton(skeleton);
  }

  void step(double t, double h) override {
    const Wrench load = load_(t, h, state());
    object_->addExtForce(load.force, Vector3d::Zero(), false);
    object_->addExtTorque(load.moment, false);
    world_->setTimeStep(h);
    world_->step();
  }
  BodyState state() const override {
    const Eigen::Isometry3d& X_WO = object_->getWorldTransform();
    return {X_WO.translation(), Quaterniond(X_WO.linear()), object_->getLinearVelocity(),
            X_WO.linear().transpose() * object_->getAngularVelocity()};
  }

 private:
  LoadLaw load_;
  BodyNode* object_;
  dart::simulation::WorldPtr world_ = dart::simulation::World::create();
};

}  // namespace

std::vector<RodEngine> dart_rods() {
  const auto make = [](const FreeBody& body, LoadLaw load) {
    return std::make_unique<DartBody>(body, std::move(load));
  };
  return {{"dart_explicit", RodForce::When::start_of_step, make}, {"dart_stable", RodForce::When::end_of_step, make}};
}

std::vector<MethodPtr> dart_baselines() {
  std::vector<MethodPtr> baselines;
  baselines.push_back(std::make_unique<DartJointSprings>());
  return baselines;
}

}  // namespace spring_workbench::benchmark
