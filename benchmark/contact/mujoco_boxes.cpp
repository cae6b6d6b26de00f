#include <iomanip>
#include <sstream>

#include "benchmark/contact/box_engines.h"
#include "benchmark/mujoco_world.h"

namespace spring_workbench::benchmark {
namespace {

/// `stiff`: contacts with a time constant of two steps, the minimum in MuJoCo, instead of 20 ms.
std::string model_of(const BoxScene& s, double step, bool stiff) {
  std::ostringstream out;
  out << std::setprecision(17);
  const auto numbers = [&](const char* name, const std::vector<double>& values) {
    out << ' ' << name << "=\"";
    for (const double value : values) out << value << ' ';
    out << '"';
  };
  out << "<mujoco><size njmax=\"" << 60 * s.scene.bodies.size() << "\" nconmax=\"" << 20 * s.scene.bodies.size()
      << "\"/><option cone=\"elliptic\" gravity=\"0 0 " << -s.scene.gravity << "\" timestep=\"" << step
      << "\"/><default><geom friction=\"" << s.friction() << "\"";
  if (stiff) numbers("solref", {2.0 * step, 1.0});
  out << "/></default><worldbody><geom type=\"plane\" size=\"5 5 1\"/>";
  for (const scene::Body& body : s.scene.bodies) {
    const Vector3d p = body.X_WO.translation(), half = 0.5 * BoxScene::size(body),
                   I = body.mass_properties.inertia_O.diagonal();
    const Quaterniond q(body.X_WO.linear());
    out << "<body";
    numbers("pos", {p.x(), p.y(), p.z()});
    numbers("quat", {q.w(), q.x(), q.y(), q.z()});
    out << (s.holds(body) ? " mocap=\"true\">" : "><freejoint/><inertial pos=\"0 0 0\"");
    if (!s.holds(body)) {
      numbers("mass", {body.mass_properties.mass});
      numbers("diaginertia", {I.x(), I.y(), I.z()});
      out << "/>";
    }
    out << "<geom type=\"box\"";
    numbers("size", {half.x(), half.y(), half.z()});
    out << "/></body>";
  }
  out << "</worldbody></mujoco>";
  return out.str();
}

class MujocoBoxWorld final : public BoxWorld {
 public:
  MujocoBoxWorld(const BoxScene& scene, double step, bool stiff) : scene_(scene), world_(model_of(scene, step, stiff)) {
    mj_forward(world_.model.get(), world_.data.get());
  }

  void step(double t, double h) override {
    if (!scene_.held.empty()) {
      const RigidTransform X = scene_.X_WO(t + h);
      const Quaterniond q(X.linear());
      for (int i = 0; i < 3; ++i) world_.data->mocap_pos[i] = X.translation()[i];
      world_.data->mocap_quat[0] = q.w();
      for (int i = 0; i < 3; ++i) world_.data->mocap_quat[i + 1] = q.vec()[i];
    }
    mj_step(world_.model.get(), world_.data.get());
  }
  std::vector<RigidTransform> poses() const override {
    mj_kinematics(world_.model.get(), world_.data.get());  // otherwise they are those of the start of the step
    std::vector<RigidTransform> poses;
    for (std::size_t i = 1; i <= scene_.scene.bodies.size(); ++i) {
      const mjtNum *p = world_.data->xpos + 3 * i, *q = world_.data->xquat + 4 * i;
      poses.push_back(make_transform(Vector3d(p[0], p[1], p[2]), Quaterniond(q[0], q[1], q[2], q[3])));
    }
    return poses;
  }

 private:
  BoxScene scene_;
  MujocoWorld world_;
};

}  // namespace

std::vector<BoxEngine> mujoco_boxes() {
  const auto with = [](bool stiff) {
    return [stiff](const BoxScene& scene, double step) -> std::unique_ptr<BoxWorld> {
      return std::make_unique<MujocoBoxWorld>(scene, step, stiff);
    };
  };
  return {{"mujoco", with(false)}, {"mujoco, stiff", with(true)}};
}

}  // namespace spring_workbench::benchmark
