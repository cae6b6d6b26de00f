#include "spring_workbench/contact/contact_engines.h"

#include <dlfcn.h>

#include <string>

#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::contact {
namespace {

/// The library that makes worlds of a kind, its function that makes one, and what it is built on.
struct Engine {
  const char* library;
  const char* function;
  const char* base;
};

constexpr Engine fcl = {"libspring_workbench_collision_engine.so", "spring_workbench_new_collision_world", "FCL"};
constexpr Engine bullet = {"libspring_workbench_rigid_bodies_engine.so", "spring_workbench_new_rigid_world", "Bullet"};

/// Opens the library, which then stays open. It is looked for where this code's own run path says.
void* find_function(const Engine& engine, const scene::Scene& scene) {
  void* library = dlopen(engine.library, RTLD_NOW | RTLD_LOCAL);
  void* function = library == nullptr ? nullptr : dlsym(library, engine.function);
  if (function == nullptr) {
    const std::string mode = scene.contact == scene::ContactMode::dynamic ? "dynamic" : "stop";
    validation::refuse_because("", "contact",
                               "mode '" + mode + "' needs " + engine.library + ", which cannot be loaded (" +
                                   dlerror() + "): install " + engine.base + " and build again, or use contact: none");
  }
  return function;
}

template <typename World>
std::unique_ptr<World> make(const Engine& engine, const scene::Scene& scene) {
  static void* const function = find_function(engine, scene);
  return std::unique_ptr<World>(reinterpret_cast<World* (*)(const scene::Scene&)>(function)(scene));
}

}  // namespace

std::unique_ptr<collision::CollisionWorld> open_collision_world(const scene::Scene& scene) {
  return make<collision::CollisionWorld>(fcl, scene);
}
std::unique_ptr<rigid_bodies::RigidWorld> open_rigid_world(const scene::Scene& scene) {
  return make<rigid_bodies::RigidWorld>(bullet, scene);
}

}  // namespace spring_workbench::contact
