#include <dart/collision/dart/DARTCollisionDetector.hpp>
#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
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
using dart::dynamics::Skeleton;
using dart::dynamics::SkeletonPtr;

void add_shape(BodyNode* body, const Vector3d& size, double friction) {
  auto* node = body->createShapeNodeWith<CollisionAspect, DynamicsAspect>(std::make_shared<BoxShape>(size));
  node->getDynamicsAspect()->setFrictionCoeff(friction);
}

/// Springs and dampers as a force at the beginning of each step; the plane is the top of a large block.
class DartDrag final : public DragWorld {
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
    const SkeletonPtr box = Skeleton::create("box");
    const auto free = box->createJointAndBodyNodePair<FreeJoint>();
    joint_ = free.first;
    box_ = free.second;
    add_shape(box_, scene.size, scene.friction);
    dart::dynamics::Inertia inertia;
    inertia.setMass(scene.mass);
    inertia.setMoment(scene.inertia().asDiagonal().toDenseMatrix());
    box_->setInertia(inertia);
    Eigen::Isometry3d start = Eigen::Isometry3d::Identity();
    start.translation().z() = 0.5 * scene.size.z();
    joint_->setTransform(start);
    world_->addSkeleton(ground);
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
  RigidTransform box() const override {
    const Eigen::Isometry3d X_WO = box_->getWorldTransform();
    RigidTransform X = RigidTransform::Identity();
    X.linear() = X_WO.linear();
    X.translation() = X_WO.translation();
    return X;
  }

 private:
  DragScene scene_;
  dart::simulation::WorldPtr world_ = dart::simulation::World::create();
  FreeJoint* joint_ = nullptr;
  BodyNode* box_ = nullptr;
};

}  // namespace

std::vector<DragMethod> dart_drags() {
  return {{"dart_explicit", false,
           [](const DragScene& scene, double step) { return std::make_unique<DartDrag>(scene, step); }}};
}

}  // namespace spring_workbench::benchmark
