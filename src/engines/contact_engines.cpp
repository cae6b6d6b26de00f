#include "spring_workbench/engines/contact_engines.h"

#include <dlfcn.h>

#include <filesystem>
#include <string>

#include "spring_workbench/config/yaml_fields.h"

namespace spring_workbench {
namespace {

/// The library that makes worlds of a kind, and its function that makes one.
struct Engine {
  const char* library;
  const char* function;
};

constexpr Engine fcl = {"libspring_workbench_collision_engine.so", "spring_workbench_new_collision_world"};
constexpr Engine bullet = {"libspring_workbench_world_engine.so", "spring_workbench_new_rigid_world"};

/// Opens the library, which then stays open.
void* find_function(const Engine& engine, const Scene& scene) {
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
  const std::filesystem::path path = program.parent_path().parent_path() / engine.library;
  void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* function = library == nullptr ? nullptr : dlsym(library, engine.function);
  if (function == nullptr) {
    const char* mode = scene.contact == ContactMode::dynamic ? "dynamic" : "stop";
    refuse(scene.path, "contact", mode, std::string("a mode that this build has the engines for (") + dlerror() + ")");
  }
  return function;
}

template <typename World>
std::unique_ptr<World> make(const Engine& engine, const Scene& scene) {
  static void* const function = find_function(engine, scene);
  return std::unique_ptr<World>(reinterpret_cast<World* (*)(const Scene&)>(function)(scene));
}

}  // namespace

std::unique_ptr<CollisionWorld> open_collision_world(const Scene& scene) { return make<CollisionWorld>(fcl, scene); }
std::unique_ptr<RigidWorld> open_rigid_world(const Scene& scene) { return make<RigidWorld>(bullet, scene); }

}  // namespace spring_workbench
