#include <ode/ode.h>

#include <cmath>

#include "benchmark/contact/drag.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::benchmark {
namespace {

/// The box on a kinematic hand by motors whose rows are implicit spring-dampers: ERP = h k / (h k + c) as target
/// velocity ERP x / h, CFM = 1 / (h k + c). Contact by up to eight points with Coulomb's law as a pyramid. Direct
/// solver.
class OdeDrag final : public DragWorld {
 public:
  explicit OdeDrag(const DragScene& scene) : scene_(scene) {
    dInitODE2(0);
    world_ = dWorldCreate();
    dWorldSetGravity(world_, 0.0, 0.0, -scene.gravity);
    dWorldSetContactSurfaceLayer(world_, 0.0);
    hand_ = dBodyCreate(world_);
    dBodySetKinematic(hand_);
    box_ = dBodyCreate(world_);
    dMass mass;
    const Vector3d I = scene.inertia();
    dMassSetParameters(&mass, scene.mass, 0, 0, 0, I.x(), I.y(), I.z(), 0, 0, 0);
    dBodySetMass(box_, &mass);
    dBodySetPosition(box_, 0.0, 0.0, 0.5 * scene.size.z());
    box_geom_ = dCreateBox(nullptr, scene.size.x(), scene.size.y(), scene.size.z());
    dGeomSetBody(box_geom_, box_);
    plane_ = dCreatePlane(nullptr, 0, 0, 1, 0);
    contacts_ = dJointGroupCreate(0);
    linear_ = dJointCreateLMotor(world_, nullptr);
    angular_ = dJointCreateAMotor(world_, nullptr);
    for (const dJointID motor : {linear_, angular_}) dJointAttach(motor, hand_, box_);
    dJointSetLMotorNumAxes(linear_, 3);
    dJointSetAMotorMode(angular_, dAMotorUser);
    dJointSetAMotorNumAxes(angular_, 3);
    for (int i = 0; i < 3; ++i) {
      const Vector3d axis = Vector3d::Unit(i);
      dJointSetLMotorAxis(linear_, i, 0, axis.x(), axis.y(), axis.z());
      dJointSetAMotorAxis(angular_, i, 0, axis.x(), axis.y(), axis.z());
      dJointSetLMotorParam(linear_, dParamFMax + dParamGroup * i, dInfinity);
      dJointSetAMotorParam(angular_, dParamFMax + dParamGroup * i, dInfinity);
    }
  }
  ~OdeDrag() override {
    dJointGroupDestroy(contacts_);
    dGeomDestroy(box_geom_);
    dGeomDestroy(plane_);
    dWorldDestroy(world_);
    dCloseODE();
  }
  OdeDrag(const OdeDrag&) = delete;
  OdeDrag& operator=(const OdeDrag&) = delete;

  void step(double t, double h) override {
    // The body of the hand is placed at the box, so that the motor acts at the box's centre; it has the hand's
    // velocity.
    const RigidTransform X_WO = box();
    const Vector3d here = drag_hand(scene_, t).p_W, v = (drag_hand(scene_, t + h).p_W - here) / h;
    dBodySetPosition(hand_, X_WO.translation().x(), X_WO.translation().y(), X_WO.translation().z());
    dBodySetLinearVel(hand_, v.x(), v.y(), v.z());
    set_rows(linear_, dJointSetLMotorParam, X_WO.translation() - here, scene_.stiffness(), scene_.damping(), h);
    set_rows(angular_, dJointSetAMotorParam, math::log_so3(X_WO.linear()), scene_.turning_stiffness(),
             scene_.turning_damping(), h);
    add_contacts();
    dWorldStep(world_, h);
    dJointGroupEmpty(contacts_);
  }
  RigidTransform box() const override {
    const dReal* q = dBodyGetQuaternion(box_);
    return make_transform(Eigen::Map<const Vector3d>(dBodyGetPosition(box_)), Quaterniond(q[0], q[1], q[2], q[3]));
  }

 private:
  static void set_rows(dJointID joint, void (*set)(dJointID, int, dReal), const Vector3d& x, double k, double c,
                       double h) {
    for (int i = 0; i < 3; ++i) {
      set(joint, dParamVel + dParamGroup * i, k / (h * k + c) * x[i]);  // hand relative to box
      set(joint, dParamCFM + dParamGroup * i, 1.0 / (h * k + c));
    }
  }
  void add_contacts() {
    constexpr int most = 8;
    dContactGeom points[most];
    const int count = dCollide(box_geom_, plane_, most, points, sizeof(dContactGeom));
    for (int i = 0; i < count; ++i) {
      dContact contact{};
      contact.geom = points[i];
      contact.surface.mode = dContactApprox1;
      contact.surface.mu = scene_.friction;
      dJointAttach(dJointCreateContact(world_, contacts_, &contact), box_, nullptr);
    }
  }

  DragScene scene_;
  dWorldID world_ = nullptr;
  dBodyID hand_ = nullptr, box_ = nullptr;
  dGeomID box_geom_ = nullptr, plane_ = nullptr;
  dJointGroupID contacts_ = nullptr;
  dJointID linear_ = nullptr, angular_ = nullptr;
};

}  // namespace

std::vector<DragMethod> ode_drags() {
  return {{"ode_erp_cfm", false, [](const DragScene& scene, double) { return std::make_unique<OdeDrag>(scene); }}};
}

}  // namespace spring_workbench::benchmark
