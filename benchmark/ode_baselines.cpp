#include <ode/ode.h>

#include <cmath>
#include <utility>

#include "benchmark/baselines.h"
#include "benchmark/held_body.h"
#include "benchmark/stepping_loop.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::benchmark {
namespace {

void set_rotation(dBodyID body, const Matrix3d& R) {
  const Quaterniond q(R);
  const dQuaternion values = {q.w(), q.x(), q.y(), q.z()};
  dBodySetQuaternion(body, values);
}

Matrix3d rotation(dBodyID body) {
  const dReal* R = dBodyGetRotation(body);  // rows of four
  Matrix3d m;
  m << R[0], R[1], R[2], R[4], R[5], R[6], R[8], R[9], R[10];
  return m;
}

Vector3d position(dBodyID body) { return Eigen::Map<const Vector3d>(dBodyGetPosition(body)); }

/// Sets the gravity of a world, and puts a body into it.
dBodyID add_body(const FreeBody& body, dWorldID world) {
  dWorldSetGravity(world, 0.0, 0.0, -body.gravity);
  const dBodyID object = dBodyCreate(world);
  dMass mass;
  dMassSetParameters(&mass, body.mass, 0, 0, 0, body.inertia.x(), body.inertia.y(), body.inertia.z(), 0, 0, 0);
  dBodySetMass(object, &mass);
  const Matrix3d R = body.start.R_WO.toRotationMatrix();
  const Vector3d &p = body.start.p_WO, &v = body.start.v_WO_W, w = R * body.start.w_WO_O;
  dBodySetPosition(object, p.x(), p.y(), p.z());
  set_rotation(object, R);
  dBodySetLinearVel(object, v.x(), v.y(), v.z());
  dBodySetAngularVel(object, w.x(), w.y(), w.z());
  return object;
}

/// The object on a kinematic hand by a linear and an angular motor, whose rows are implicit spring-dampers: ODE's
/// ERP = h k / (h k + c) and CFM = 1 / (h k + c), as target velocity −(ERP/h) x and CFM per axis.
///
/// ODE's linear motor holds the material points half way between the two bodies' centres. The hand is kinematic, so its
/// body frame is free: it is placed such that the midpoint is the tip.
class OdeWorld {
 public:
  explicit OdeWorld(const Scenario& scene)
      : scene_(scene),
        next_(hand_state(scene, 0.0)),
        world_(dWorldCreate()),
        hand_(dBodyCreate(world_)),
        object_(add_body(free_body(scene), world_)) {
    dBodySetKinematic(hand_);
    set_rotation(hand_, next_.R_WT);
    add_motor(dJointCreateLMotor(world_, nullptr), 0, dJointSetLMotorParam, linear_);
    add_motor(dJointCreateAMotor(world_, nullptr), 3, dJointSetAMotorParam, angular_);
  }
  ~OdeWorld() { dWorldDestroy(world_); }
  OdeWorld(const OdeWorld&) = delete;
  OdeWorld& operator=(const OdeWorld&) = delete;

  void step(double t, double h) {
    const HandState hand = next_, next = hand_state(scene_, t + h);
    next_ = next;
    const Matrix3d R_WO = rotation(object_);
    const Vector3d p_WE = position(object_) - R_WO * scene_.p_EO;
    place_hand(hand, next, p_WE, h);
    const Vector3d d = hand.R_WT.transpose() * (p_WE - hand.p_WT);
    set_rows(linear_, d, h);
    set_rows(angular_, math::log_so3(hand.R_WT.transpose() * R_WO), h);
    dWorldStep(world_, h);
  }

  Vector3d output() const {
    if (scene_.kind != SceneKind::torsion) return position(object_);
    const Matrix3d R = rotation(object_);
    return Vector3d(0.0, 0.0, std::atan2(R(1, 0), R(0, 0)));
  }

 private:
  struct Motor {
    dJointID joint = nullptr;
    void (*set)(dJointID, int, dReal) = nullptr;
    int rows = 0;
    int coordinate[3] = {0, 0, 0};  ///< coordinate of each row, as an index of q
  };

  /// Adds a motor with a row for each of the three coordinates from `first` on that has a spring, with axes fixed to
  /// the hand.
  void add_motor(dJointID joint, int first, void (*set)(dJointID, int, dReal), Motor& motor) {
    motor.joint = joint;
    motor.set = set;
    for (int i = first; i < first + 3; ++i) {
      if (scene_.stiffness[i] > 0.0) motor.coordinate[motor.rows++] = i;
    }
    const bool is_linear = first == 0;
    dJointAttach(joint, hand_, object_);
    if (!is_linear) dJointSetAMotorMode(joint, dAMotorUser);
    (is_linear ? dJointSetLMotorNumAxes : dJointSetAMotorNumAxes)(joint, motor.rows);
    for (int row = 0; row < motor.rows; ++row) {
      const Vector3d axis = rotation(hand_) * Vector3d::Unit(motor.coordinate[row] % 3);
      (is_linear ? dJointSetLMotorAxis : dJointSetAMotorAxis)(joint, row, 1, axis.x(), axis.y(), axis.z());
      set(joint, dParamFMax + dParamGroup * row, dInfinity);
    }
  }

  /// Places the hand's body at time t such that the tip `p_WE` is the midpoint between it and the object, with the
  /// velocity that moves the hand's point at the tip, and its rotation, exactly to their values at t + h.
  void place_hand(const HandState& now, const HandState& next, const Vector3d& p_WE, double h) {
    const Vector3d p_TE = now.R_WT.transpose() * (p_WE - now.p_WT);
    const Vector3d v_tip = (next.p_WT + next.R_WT * p_TE - p_WE) / h;
    const Vector3d w = now.R_WT * math::log_so3(now.R_WT.transpose() * next.R_WT) / h;
    const Vector3d from_tip = p_WE - position(object_);
    const Vector3d p = p_WE + from_tip;
    const Vector3d v = v_tip + w.cross(from_tip);
    dBodySetPosition(hand_, p.x(), p.y(), p.z());
    set_rotation(hand_, now.R_WT);
    dBodySetLinearVel(hand_, v.x(), v.y(), v.z());
    dBodySetAngularVel(hand_, w.x(), w.y(), w.z());
  }

  /// Sets the spring–damper rows for the deflection `x`; ODE measures the motion of the hand relative to the object.
  void set_rows(const Motor& motor, const Vector3d& x, double h) const {
    for (int row = 0; row < motor.rows; ++row) {
      const int i = motor.coordinate[row];
      const double softness = 1.0 / (h * scene_.stiffness[i] + scene_.damping[i]);
      motor.set(motor.joint, dParamVel + dParamGroup * row, scene_.stiffness[i] * softness * x[i % 3]);
      motor.set(motor.joint, dParamCFM + dParamGroup * row, softness);
    }
  }

  Scenario scene_;
  HandState next_;  ///< the hand at the end of the last step
  dWorldID world_;
  dBodyID hand_, object_;
  Motor linear_, angular_;
};

class OdeErpCfm : public Method {
 public:
  std::string name() const override { return "ode_erp_cfm"; }
  bool has_scene_law(const Scenario& scene) const override { return scene.kind != SceneKind::six_dof; }

  RunResult run(const Scenario& scene, double step) const override {
    dInitODE2(0);
    RunResult result;
    {
      OdeWorld world(scene);
      result = stepping_loop(
          scene, step, [&](double t, double h) { world.step(t, h); }, [&](double) { return world.output(); });
    }
    dCloseODE();
    return result;
  }
};

class OdeBody final : public BodyEngine {
 public:
  OdeBody(const FreeBody& body, LoadLaw load) : load_(std::move(load)) {
    dInitODE2(0);
    world_ = dWorldCreate();
    object_ = add_body(body, world_);
  }
  ~OdeBody() override {
    dWorldDestroy(world_);
    dCloseODE();
  }
  OdeBody(const OdeBody&) = delete;
  OdeBody& operator=(const OdeBody&) = delete;

  void step(double t, double h) override {
    const Wrench load = load_(t, h, state());
    dBodyAddForce(object_, load.force.x(), load.force.y(), load.force.z());
    dBodyAddTorque(object_, load.moment.x(), load.moment.y(), load.moment.z());
    dWorldStep(world_, h);
  }
  BodyState state() const override {
    const dReal* q = dBodyGetQuaternion(object_);
    const Quaterniond R_WO(q[0], q[1], q[2], q[3]);
    const Vector3d w = Eigen::Map<const Vector3d>(dBodyGetAngularVel(object_));
    return {position(object_), R_WO, Eigen::Map<const Vector3d>(dBodyGetLinearVel(object_)), R_WO.conjugate() * w};
  }

 private:
  LoadLaw load_;
  dWorldID world_;
  dBodyID object_;
};

}  // namespace

std::vector<RodEngine> ode_rods() {
  const auto make = [](const FreeBody& body, LoadLaw load) { return std::make_unique<OdeBody>(body, std::move(load)); };
  return {{"ode_explicit", RodForce::When::start_of_step, make}, {"ode_stable", RodForce::When::end_of_step, make}};
}

std::vector<MethodPtr> ode_baselines() {
  std::vector<MethodPtr> baselines;
  baselines.push_back(std::make_unique<OdeErpCfm>());
  return baselines;
}

}  // namespace spring_workbench::benchmark
