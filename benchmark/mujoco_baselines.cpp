#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "benchmark/baselines.h"
#include "benchmark/held_body.h"
#include "benchmark/mujoco_models.h"
#include "benchmark/mujoco_world.h"
#include "benchmark/single_spring.h"
#include "benchmark/stepping_loop.h"

namespace spring_workbench::benchmark {
namespace {

class SteppedWorld {
 public:
  explicit SteppedWorld(const std::string& xml) : world_(xml) {}

  mjModel& model() { return *world_.model; }
  mjData& data() { return *world_.data; }
  const mjData& data() const { return *world_.data; }
  /// One step of `h` from time `t`, which is set because MuJoCo's own sum accumulates rounding errors.
  void step(double t, double h) {
    model().opt.timestep = h;
    data().time = t;
    mj_step(&model(), &data());
  }

  /// Whether MuJoCo reset the state because it was no longer finite or bounded.
  bool was_reset() const {
    const auto& warnings = world_.data->warning;
    return warnings[mjWARN_BADQPOS].number + warnings[mjWARN_BADQVEL].number + warnings[mjWARN_BADQACC].number > 0;
  }

 private:
  MujocoWorld world_;
};

Vector3d not_a_result() { return Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()); }

void write_free_joint(const Vector3d& p, const Matrix3d& R, const Vector3d& v_W, const Vector3d& w_body, mjtNum* qpos,
                      mjtNum* qvel) {
  const Quaterniond q(R);
  Eigen::Map<Vector3d>{qpos} = p;
  Eigen::Map<Eigen::Vector4d>{qpos + 3} = Eigen::Vector4d(q.w(), q.x(), q.y(), q.z());
  Eigen::Map<Vector3d>{qvel} = v_W;
  Eigen::Map<Vector3d>{qvel + 3} = w_body;
}

BodyState read_free_joint(const mjData& data) {
  BodyState body;
  body.p_WO = Eigen::Map<const Vector3d>(data.qpos);
  body.R_WO = Quaterniond(data.qpos[3], data.qpos[4], data.qpos[5], data.qpos[6]).normalized();
  body.v_WO_W = Eigen::Map<const Vector3d>(data.qvel);
  body.w_WO_O = Eigen::Map<const Vector3d>(data.qvel + 3);
  return body;
}

/// The start of an object with one coordinate (A, B) or a free joint (C).
void write_start(const Scenario& scene, mjData& data) {
  if (scene.kind == SceneKind::six_dof) {
    const BodyState start = start_state(scene);
    write_free_joint(start.p_WO, start.R_WO.toRotationMatrix(), start.v_WO_W, start.w_WO_O, data.qpos, data.qvel);
  } else {
    data.qpos[0] = scalar_hand(scene, 0.0).value;
    data.qvel[0] = scalar_hand(scene, 0.0).rate;
  }
}

/// The scene's law as a passive force in MuJoCo's callback, so that Runge–Kutta evaluates it at each stage.
class MujocoForce : public Method {
 public:
  explicit MujocoForce(mjtIntegrator integrator) : integrator_(integrator) {}
  std::string name() const override { return integrator_ == mjINT_RK4 ? "mujoco_rk4" : "mujoco_euler"; }

  RunResult run(const Scenario& scene, double step) const override {
    SteppedWorld world(mujoco_object_model(scene));
    world.model().opt.integrator = integrator_;
    write_start(scene, world.data());
    const SingleSpring spring(scene);
    current_ = &spring;
    single_ = {};
    hand_ = {};
    mjcb_passive = scene.kind == SceneKind::six_dof ? &push_body : &push_single;
    RunResult result = stepping_loop(
        scene, step, [&](double t, double h) { world.step(t, h); },
        [&](double) -> Vector3d {
          const mjData& data = world.data();
          if (world.was_reset()) return not_a_result();
          if (scene.kind == SceneKind::six_dof) return Eigen::Map<const Vector3d>(data.qpos);
          return Vector3d(0.0, 0.0, data.qpos[0]);
        });
    mjcb_passive = nullptr;
    return result;
  }

 private:
  static void push_single(const mjModel*, mjData* data) {
    data->qfrc_passive[0] += current_->force(single_.at(current_->scene, data->time), data->qpos[0], data->qvel[0]);
  }

  static void push_body(const mjModel*, mjData* data) {
    const BodyLoad load = bushing_load(current_->scene, hand_.at(current_->scene, data->time), read_free_joint(*data));
    Eigen::Map<Vector3d>{data->qfrc_passive} += load.force_W;
    Eigen::Map<Vector3d>{data->qfrc_passive + 3} += load.moment_O;
  }

  static const SingleSpring* current_;
  static RememberedScalar single_;
  static RememberedState hand_;
  mjtIntegrator integrator_;
};

const SingleSpring* MujocoForce::current_ = nullptr;
RememberedScalar MujocoForce::single_;
RememberedState MujocoForce::hand_;

/// Joints with stiffness and damping between a hand and the object. The hand is a body too heavy for the object to
/// move; before each step it is set to its exact pose and velocity and driven with its exact acceleration. Rotation:
/// three hinges, so the law is not the scene's in C.
class MujocoJoints : public Method {
 public:
  MujocoJoints(std::string name, mjtIntegrator integrator) : name_(std::move(name)), integrator_(integrator) {}
  std::string name() const override { return name_; }
  bool has_scene_law(const Scenario& scene) const override { return scene.kind != SceneKind::six_dof; }

  RunResult run(const Scenario& scene, double step) const override {
    SteppedWorld world(mujoco_joint_model(scene));
    world.model().opt.integrator = integrator_;
    mjData& data = world.data();
    return stepping_loop(
        scene, step,
        [&](double t, double h) {
          drive_hand(scene, t, data);
          world.step(t, h);
        },
        [&](double t) { return world.was_reset() ? not_a_result() : output(scene, t, data); });
  }

 private:
  static void drive_hand(const Scenario& scene, double t, mjData& data) {
    if (scene.kind != SceneKind::six_dof) {
      const ScalarMotion hand = scalar_hand(scene, t);
      data.qpos[0] = hand.value;
      data.qvel[0] = hand.rate;
      data.qfrc_applied[0] = kMujocoHandInertia * hand.acceleration;
      return;
    }
    const auto& [hand, acceleration] = hand_motion(scene, t);
    write_free_joint(hand.p_WT, hand.R_WT, hand.v_WT_W, hand.w_WT_T, data.qpos, data.qvel);
    Eigen::Map<Vector3d>{data.qfrc_applied} =
        kMujocoHandInertia * (acceleration.a_WT_W + scene.gravity * Vector3d::UnitZ());
    Eigen::Map<Vector3d>{data.qfrc_applied + 3} = kMujocoHandInertia * acceleration.alpha_WT_T;
  }

  static Vector3d output(const Scenario& scene, double t, const mjData& data) {
    if (scene.kind != SceneKind::six_dof) return Vector3d(0.0, 0.0, scalar_hand(scene, t).value + data.qpos[1]);
    const mjtNum* q = data.qpos + 7;
    const HandState hand = hand_state(scene, t);
    const Matrix3d R_TE = (Eigen::AngleAxisd(q[3], Vector3d::UnitX()) * Eigen::AngleAxisd(q[4], Vector3d::UnitY()) *
                           Eigen::AngleAxisd(q[5], Vector3d::UnitZ()))
                              .toRotationMatrix();
    return hand.p_WT + hand.R_WT * (Vector3d(q[0], q[1], q[2]) + R_TE * scene.p_EO);
  }

  std::string name_;
  mjtIntegrator integrator_;
};

/// A weld to a mocap body in direct mode, as a spring: solref has one stiffness and damping over mass for all six rows,
/// that of the bend in C, and `torquescale` the ratio of turning to moving. The stiffness along the fork is not its
/// own. MuJoCo's mocap bodies have no velocity, so the damping acts on the absolute velocity, and the object lags
/// behind the hand at every step size.
class MujocoWeld : public Method {
 public:
  std::string name() const override { return "mujoco_weld"; }
  bool has_scene_law(const Scenario& scene) const override { return scene.kind != SceneKind::six_dof; }

  RunResult run(const Scenario& scene, double step) const override {
    SteppedWorld world(mujoco_weld_model(scene));
    mjData& data = world.data();
    const BodyState start = start_state(scene);
    write_free_joint(start.p_WO, start.R_WO.toRotationMatrix(), start.v_WO_W, start.w_WO_O, data.qpos, data.qvel);
    set_coupling(scene, world.model());
    return stepping_loop(
        scene, step,
        [&](double t, double h) {
          const HandState hand = hand_state(scene, t);
          const Quaterniond q(hand.R_WT);
          Eigen::Map<Vector3d>{data.mocap_pos} = hand.p_WT;
          Eigen::Map<Eigen::Vector4d>{data.mocap_quat} = Eigen::Vector4d(q.w(), q.x(), q.y(), q.z());
          world.step(t, h);
        },
        [&](double) -> Vector3d {
          if (world.was_reset()) return not_a_result();
          const BodyState body = read_free_joint(data);
          if (scene.kind != SceneKind::torsion) return body.p_WO;
          return Vector3d(0.0, 0.0, 2.0 * std::atan2(body.R_WO.z(), body.R_WO.w()));
        });
  }

 private:
  static void set_coupling(const Scenario& scene, mjModel& model) {
    const int i = scene.kind == SceneKind::six_dof ? 0 : scene.single_coordinate();
    const int turning = scene.kind == SceneKind::six_dof ? 3 : scene.single_coordinate();
    // The force of a row is solref times the body's mass. The rotational rows contain half the angle.
    const double torque_scale = 2.0 * std::sqrt(scene.stiffness[turning] / scene.stiffness[i]);
    const double impedance = 1e-4;  // MuJoCo's minimum: the weld then acts as a spring, with full gravity
    model.eq_solref[0] = -scene.stiffness[i] / scene.mass;
    model.eq_solref[1] = -scene.damping[i] / scene.mass;
    model.eq_solimp[0] = impedance;
    model.eq_solimp[1] = impedance;
    const Vector3d anchor = -scene.p_EO;
    const std::array<mjtNum, mjNEQDATA> data{anchor.x(), anchor.y(), anchor.z(), 0, 0, 0, 1, 0, 0, 0, torque_scale};
    std::copy(data.begin(), data.end(), model.eq_data);  // anchor in the object, in the hand, relative turn, scale
  }
};

/// Its load is a passive force in MuJoCo's callback, as above.
class MujocoBody final : public BodyEngine {
 public:
  MujocoBody(mjtIntegrator integrator, const FreeBody& body, LoadLaw load)
      : world_(mujoco_free_body_model(body)), load_(std::move(load)) {
    world_.model().opt.integrator = integrator;
    const BodyState& start = body.start;
    write_free_joint(start.p_WO, start.R_WO.toRotationMatrix(), start.v_WO_W, start.w_WO_O, world_.data().qpos,
                     world_.data().qvel);
    current_ = this;
    mjcb_passive = &push;
  }
  ~MujocoBody() override { mjcb_passive = nullptr; }
  MujocoBody(const MujocoBody&) = delete;
  MujocoBody& operator=(const MujocoBody&) = delete;

  void step(double t, double h) override { world_.step(t, h); }
  BodyState state() const override {
    BodyState state = read_free_joint(world_.data());
    if (world_.was_reset()) state.p_WO = not_a_result();
    return state;
  }

 private:
  static void push(const mjModel* model, mjData* data) {
    const BodyState body = read_free_joint(*data);
    const Wrench load = current_->load_(data->time, model->opt.timestep, body);
    Eigen::Map<Vector3d>{data->qfrc_passive} += load.force;
    Eigen::Map<Vector3d>{data->qfrc_passive + 3} += body.R_WO.conjugate() * load.moment;
  }

  static MujocoBody* current_;
  SteppedWorld world_;
  LoadLaw load_;
};

MujocoBody* MujocoBody::current_ = nullptr;

}  // namespace

std::vector<RodEngine> mujoco_rods() {
  const auto made_with = [](mjtIntegrator integrator) {
    return [integrator](const FreeBody& body, LoadLaw load) {
      return std::make_unique<MujocoBody>(integrator, body, std::move(load));
    };
  };
  return {{"mujoco_euler", RodForce::When::start_of_step, made_with(mjINT_EULER)},
          {"mujoco_rk4", RodForce::When::each_stage, made_with(mjINT_RK4)},
          {"mujoco_stable", RodForce::When::end_of_step, made_with(mjINT_EULER)}};
}

std::vector<MethodPtr> mujoco_baselines() {
  mujoco_files();
  std::vector<MethodPtr> baselines;
  baselines.push_back(std::make_unique<MujocoForce>(mjINT_EULER));
  baselines.push_back(std::make_unique<MujocoForce>(mjINT_RK4));
  for (const auto& [name, integrator] : mujoco_joint_modes()) {
    baselines.push_back(std::make_unique<MujocoJoints>(name, integrator));
  }
  baselines.push_back(std::make_unique<MujocoWeld>());
  return baselines;
}

}  // namespace spring_workbench::benchmark
