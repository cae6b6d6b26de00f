#include <iomanip>
#include <sstream>

#include "benchmark/contact/drag.h"
#include "benchmark/mujoco_world.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double hand_inertia = 1e10;  // kg, so that the box does not move the hand

std::string triple(const Vector3d& v) {
  std::ostringstream out;
  out << std::setprecision(17) << '"' << v.x() << ' ' << v.y() << ' ' << v.z() << '"';
  return out.str();
}

std::string joints(const char* type, double stiffness, double damping, double armature) {
  std::ostringstream out;
  out << std::setprecision(17);
  for (int i = 0; i < 3; ++i) {
    out << "<joint type=\"" << type << "\" axis=" << triple(Vector3d::Unit(i)) << " stiffness=\"" << stiffness
        << "\" damping=\"" << damping << "\" armature=\"" << armature << "\"/>";
  }
  return out.str();
}

/// MuJoCo model of the scene: a plane, a hand on three slide joints, and a box attached to the hand by slide and hinge
/// joints with springs; the friction cone is elliptic. Contact parameters are MuJoCo's defaults or, if `tuned`, those
/// that come nearest to rigid contact here: the shortest time constant that the step [s] allows, and iterations against
/// slip.
std::string model_of(const DragScene& s, double step, bool tuned) {
  std::ostringstream out, contact;
  if (tuned) contact << std::setprecision(17) << " solref=\"" << 2.0 * step << " 1\"";
  out << std::setprecision(17) << "<mujoco><compiler angle=\"radian\"/><option cone=\"elliptic\""
      << (tuned ? " noslip_iterations=\"10\"" : "") << " gravity=" << triple(Vector3d(0, 0, -s.gravity))
      << "/><worldbody><geom type=\"plane\" size=\"5 5 1\" friction=\"" << s.friction << '"' << contact.str()
      << "/><body>" << joints("slide", 0.0, 0.0, hand_inertia)
      << "<inertial mass=\"1\" diaginertia=\"1 1 1\" pos=\"0 0 0\"/><body>"
      << joints("slide", s.stiffness(), s.damping(), 0.0)
      << (s.turns ? joints("hinge", s.turning_stiffness(), s.turning_damping(), 0.0) : "") << "<inertial mass=\""
      << s.mass << "\" diaginertia=" << triple(s.inertia())
      << " pos=\"0 0 0\"/><geom type=\"box\" size=" << triple(Vector3d(0.5 * s.size)) << " friction=\"" << s.friction
      << '"' << contact.str() << "/></body></body></worldbody></mujoco>";
  return out.str();
}

class MujocoDrag final : public DragWorld {
 public:
  MujocoDrag(const DragScene& scene, double step, mjtIntegrator integrator, bool tuned)
      : scene_(scene), world_(model_of(scene, step, tuned)) {
    mjModel& model = *world_.model;
    model.opt.timestep = step;
    model.opt.integrator = integrator;
    // MuJoCo's solver takes them as multiples of the mean inertia, which is not to be the hand's.
    const double box_over_mean = scene.mass / model.stat.meaninertia;
    model.opt.tolerance *= box_over_mean;
    model.opt.noslip_tolerance *= box_over_mean;
    place_hand(0.0);
  }

  void step(double t, double h) override {
    place_hand(t);
    mj_step(world_.model.get(), world_.data.get());
    place_hand(t + h);
  }
  RigidTransform box() const override {
    const mjtNum* q = world_.data->qpos;
    const Matrix3d R = !scene_.turns
                           ? Matrix3d::Identity().eval()
                           : (Eigen::AngleAxisd(q[6], Vector3d::UnitX()) * Eigen::AngleAxisd(q[7], Vector3d::UnitY()) *
                              Eigen::AngleAxisd(q[8], Vector3d::UnitZ()))
                                 .toRotationMatrix();
    return make_transform(Vector3d(q[0] + q[3], q[1] + q[4], q[2] + q[5]), Quaterniond(R));
  }

 private:
  void place_hand(double t) {
    const DragHand hand = drag_hand(scene_, t);
    Eigen::Map<Vector3d>{world_.data->qpos} = hand.p_W;
    Eigen::Map<Vector3d>{world_.data->qvel} = hand.v_W;
    // The armature has no weight, but the mass of 1 kg does.
    Eigen::Map<Vector3d>{world_.data->qfrc_applied} =
        (hand_inertia + 1.0) * hand.a_W + scene_.gravity * Vector3d::UnitZ();
  }

  DragScene scene_;
  MujocoWorld world_;
};

}  // namespace

std::vector<DragMethod> mujoco_drags() {
  const auto make = [](mjtIntegrator integrator, bool tuned) {
    return [=](const DragScene& scene, double step) -> std::unique_ptr<DragWorld> {
      return std::make_unique<MujocoDrag>(scene, step, integrator, tuned);
    };
  };
  std::vector<DragMethod> drags;
  for (const auto& [name, integrator] : mujoco_joint_modes()) drags.push_back({name, true, make(integrator, false)});
  drags.push_back({"mujoco_joints_implicit_tuned", true, make(mjINT_IMPLICIT, true)});
  return drags;
}

}  // namespace spring_workbench::benchmark
