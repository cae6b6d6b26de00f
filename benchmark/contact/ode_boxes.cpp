#include <ode/ode.h>

#include "benchmark/contact/box_engines.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::benchmark {
namespace {

void place(dBodyID body, const RigidTransform& X) {
  const Quaterniond q(X.linear());
  const dReal of[4] = {q.w(), q.x(), q.y(), q.z()};
  dBodySetPosition(body, X.translation().x(), X.translation().y(), X.translation().z());
  dBodySetQuaternion(body, of);
}

class OdeBoxWorld final : public BoxWorld {
 public:
  OdeBoxWorld(const BoxScene& scene, int iterations) : scene_(scene), direct_(iterations == 0) {
    dInitODE2(0);
    world_ = dWorldCreate();
    space_ = dHashSpaceCreate(nullptr);
    contacts_ = dJointGroupCreate(0);
    dWorldSetGravity(world_, 0.0, 0.0, -scene.scene.gravity);
    if (iterations > 0) dWorldSetQuickStepNumIterations(world_, iterations);
    dCreatePlane(space_, 0, 0, 1, 0);
    for (const scene::Body& body : scene.scene.bodies) {
      const dBodyID b = dBodyCreate(world_);
      dMass mass;
      const Vector3d I = body.mass_properties.inertia_O.diagonal(), size = BoxScene::size(body);
      dMassSetParameters(&mass, body.mass_properties.mass, 0, 0, 0, I.x(), I.y(), I.z(), 0, 0, 0);
      dBodySetMass(b, &mass);
      if (scene.holds(body)) dBodySetKinematic(b);
      place(b, body.X_WO);
      dGeomSetBody(dCreateBox(space_, size.x(), size.y(), size.z()), b);
      bodies_.push_back(b);
    }
  }
  ~OdeBoxWorld() override {
    dJointGroupDestroy(contacts_);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
    dCloseODE();
  }
  OdeBoxWorld(const OdeBoxWorld&) = delete;
  OdeBoxWorld& operator=(const OdeBoxWorld&) = delete;

  void step(double t, double h) override {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (!scene_.holds(scene_.scene.bodies[i])) continue;
      const RigidTransform X0 = scene_.X_WO(t), X1 = scene_.X_WO(t + h);
      const Vector3d v = (X1.translation() - X0.translation()) / h,
                     w = math::log_so3(X1.linear() * X0.linear().transpose()) / h;
      place(bodies_[i], X0);
      dBodySetLinearVel(bodies_[i], v.x(), v.y(), v.z());
      dBodySetAngularVel(bodies_[i], w.x(), w.y(), w.z());
    }
    dSpaceCollide(space_, this, &OdeBoxWorld::touch);
    direct_ ? dWorldStep(world_, h) : dWorldQuickStep(world_, h);
    dJointGroupEmpty(contacts_);
  }
  std::vector<RigidTransform> poses() const override {
    std::vector<RigidTransform> poses;
    for (const dBodyID body : bodies_) {
      const dReal* q = dBodyGetQuaternion(body);
      poses.push_back(make_transform(Vector3d(Eigen::Map<const Vector3d>(dBodyGetPosition(body))),
                                     Quaterniond(q[0], q[1], q[2], q[3])));
    }
    return poses;
  }

 private:
  static void touch(void* self, dGeomID a, dGeomID b) {
    constexpr int most = 8;
    const OdeBoxWorld& world = *static_cast<OdeBoxWorld*>(self);
    dContactGeom points[most];
    const int count = dCollide(a, b, most, points, sizeof(dContactGeom));
    for (int i = 0; i < count; ++i) {
      dContact contact{};
      contact.geom = points[i];
      contact.surface.mode = dContactApprox1;
      contact.surface.mu = world.scene_.friction();
      dJointAttach(dJointCreateContact(world.world_, world.contacts_, &contact), dGeomGetBody(a), dGeomGetBody(b));
    }
  }

  BoxScene scene_;
  bool direct_;
  dWorldID world_ = nullptr;
  dSpaceID space_ = nullptr;
  dJointGroupID contacts_ = nullptr;
  std::vector<dBodyID> bodies_;
};

}  // namespace

std::vector<BoxEngine> ode_boxes() {
  const auto with = [](int iterations) {
    return [iterations](const BoxScene& scene, double) -> std::unique_ptr<BoxWorld> {
      return std::make_unique<OdeBoxWorld>(scene, iterations);
    };
  };
  return {{"ode, 20 iterations", with(20)}, {"ode, direct", with(0)}};
}

}  // namespace spring_workbench::benchmark
