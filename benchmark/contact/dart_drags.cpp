#include <dart/collision/dart/DARTCollisionDetector.hpp>
#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/dynamics/BallJoint.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/dynamics/TranslationalJoint.hpp>
#include <dart/dynamics/WeldJoint.hpp>
#include <dart/simulation/World.hpp>

#include "benchmark/contact/drag.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::benchmark {
namespace {

using dart::dynamics::BodyNode;
using dart::dynamics::BoxShape;
using dart::dynamics::CollisionAspect;
using dart::dynamics::DynamicsAspect;
using dart::dynamics::FreeJoint;
using dart::dynamics::Joint;
using dart::dynamics::Skeleton;
using dart::dynamics::SkeletonPtr;
using dart::dynamics::TranslationalJoint;

void add_shape(BodyNode* body, const Vector3d& size, double friction) {
  auto* node = body->createShapeNodeWith<CollisionAspect, DynamicsAspect>(std::make_shared<BoxShape>(size));
  node->getDynamicsAspect()->setFrictionCoeff(friction);
}

RigidTransform as_transform(const Eigen::Isometry3d& X_WO) {
  RigidTransform X = RigidTransform::Identity();
  X.linear() = X_WO.linear();
  X.translation() = X_WO.translation();
  return X;
}

dart::dynamics::Inertia inertia_of(const DragScene& scene) {
  dart::dynamics::Inertia inertia;
  inertia.setMass(scene.mass);
  inertia.setMoment(scene.inertia().asDiagonal().toDenseMatrix());
  return inertia;
}

/// The plane, which is the top of a large block.
class DartDrag : public DragWorld {
 public:
  DartDrag(const DragScene& scene, double step) : scene_(scene) {
    world_->setTimeStep(step);
    world_->setGravity(Vector3d(0.0, 0.0, -scene.gravity));
    world_->getConstraintSolver()->setCollisionDetector(dart::collision::DARTCollisionDetector::create());
    const SkeletonPtr ground = Skeleton::create("ground");
    const auto fixed = ground->createJointAndBodyNodePair<dart::dynamics::WeldJoint>();
    add_shape(fixed.second, Vector3d(10.0, 10.0, 1.0), scene.friction);
    Eigen::Isometry3d below = Eigen::Isometry3d::Identity();
    below.translation().z() = -0.5;
    fixed.first->setTransformFromParentBodyNode(below);
    world_->addSkeleton(ground);
  }
  RigidTransform box() const override { return as_transform(box_->getWorldTransform()); }

 protected:
  DragScene scene_;
  dart::simulation::WorldPtr world_ = dart::simulation::World::create();
  BodyNode* box_ = nullptr;
};

/// Springs and dampers as a force at the beginning of each step.
class DartForce final : public DartDrag {
 public:
  DartForce(const DragScene& scene, double step) : DartDrag(scene, step) {
    const SkeletonPtr box = Skeleton::create("box");
    const auto free = box->createJointAndBodyNodePair<FreeJoint>();
    box_ = free.second;
    add_shape(box_, scene.size, scene.friction);
    box_->setInertia(inertia_of(scene));
    Eigen::Isometry3d start = Eigen::Isometry3d::Identity();
    start.translation().z() = 0.5 * scene.size.z();
    free.first->setTransform(start);
    world_->addSkeleton(box);
  }
  void step(double t, double) override {
    const DragHand hand = drag_hand(scene_, t);
    const Eigen::Isometry3d X_WO = box_->getWorldTransform();
    const Vector3d force = scene_.stiffness() * (hand.p_W - X_WO.translation()) +
                           scene_.damping() * (hand.v_W - box_->getCOMLinearVelocity());
    const Vector3d moment = -scene_.turning_stiffness() * math::log_so3(X_WO.linear()) -
                            scene_.turning_damping() * box_->getAngularVelocity();
    box_->addExtForce(force, Vector3d::Zero(), false);
    box_->addExtTorque(moment, false);
    world_->step();
  }
};

/// Translational and ball joint with DART's implicit springs between the box and a hand of prescribed acceleration, as
/// in the scenes.
class DartSprings final : public DartDrag {
 public:
  DartSprings(const DragScene& scene, double step) : DartDrag(scene, step) {
    using dart::dynamics::Inertia;
    const auto hand = skeleton_->createJointAndBodyNodePair<TranslationalJoint>();
    hand.first->setActuatorType(Joint::ACCELERATION);
    const auto slider = hand.second->createChildJointAndBodyNodePair<TranslationalJoint>();
    slider.second->setInertia(Inertia(1e-9, Vector3d::Zero(), 1e-12 * Matrix3d::Identity()));
    const auto turning = slider.second->createChildJointAndBodyNodePair<dart::dynamics::BallJoint>();
    for (std::size_t i = 0; i < 3; ++i) {
      slider.first->setSpringStiffness(i, scene.stiffness());
      slider.first->setDampingCoefficient(i, scene.damping());
      turning.first->setSpringStiffness(i, scene.turning_stiffness());
      turning.first->setDampingCoefficient(i, scene.turning_damping());
    }
    box_ = turning.second;
    box_->setInertia(inertia_of(scene));
    add_shape(box_, scene.size, scene.friction);
    place_hand(0.0);
    world_->addSkeleton(skeleton_);
  }
  void step(double t, double h) override {
    place_hand(t);
    skeleton_->getRootJoint()->setCommands(drag_hand(scene_, t).a_W);
    world_->step();
    place_hand(t + h);
  }

 private:
  void place_hand(double t) {
    const DragHand hand = drag_hand(scene_, t);
    skeleton_->getRootJoint()->setPositions(hand.p_W);
    skeleton_->getRootJoint()->setVelocities(hand.v_W);
  }
  SkeletonPtr skeleton_ = Skeleton::create("fork");
};

}  // namespace

std::vector<DragMethod> dart_drags() {
  return {{"dart_explicit", false,
           [](const DragScene& scene, double step) { return std::make_unique<DartForce>(scene, step); }},
          {"dart_joint_springs", false,
           [](const DragScene& scene, double step) { return std::make_unique<DartSprings>(scene, step); }}};
}

}  // namespace spring_workbench::benchmark
