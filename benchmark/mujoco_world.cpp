#include "benchmark/mujoco_world.h"

#include <array>
#include <cstring>
#include <stdexcept>

namespace spring_workbench::benchmark {
namespace {

constexpr const char* kFile = "model.xml";

mjModel* compiled(const std::string& xml) {
  mju_user_warning = [](const char*) {};  // otherwise MuJoCo writes a log file to the working directory
  mjVFS& files = mujoco_files();
  const int size = static_cast<int>(xml.size());
#if mjVERSION_HEADER < 313
  mj_makeEmptyFileVFS(&files, kFile, size);
  std::memcpy(files.filedata[0], xml.data(), xml.size());
#else
  mj_addBufferVFS(&files, kFile, xml.data(), size);
#endif
  std::array<char, 500> error{};
  mjModel* model = mj_loadXML(kFile, &files, error.data(), static_cast<int>(error.size()));
  mj_deleteFileVFS(&files, kFile);
  if (model == nullptr) throw std::runtime_error(std::string("MuJoCo: ") + error.data());
  return model;
}

}  // namespace

mjVFS& mujoco_files() {
  static const std::unique_ptr<mjVFS> files = [] {
    std::unique_ptr<mjVFS> empty(new mjVFS);
    mj_defaultVFS(empty.get());
    return empty;
  }();
  return *files;
}

MujocoWorld::MujocoWorld(const std::string& xml)
    : model(compiled(xml), &mj_deleteModel), data(mj_makeData(model.get()), &mj_deleteData) {}

std::vector<std::pair<std::string, mjtIntegrator>> mujoco_joint_modes() {
  return {
    {"mujoco_joints_euler", mjINT_EULER}, {"mujoco_joints_implicit", mjINT_IMPLICIT},
#if mjVERSION_HEADER >= 233
        {"mujoco_joints_implicitfast", mjINT_IMPLICITFAST},
#endif
  };
}

}  // namespace spring_workbench::benchmark
