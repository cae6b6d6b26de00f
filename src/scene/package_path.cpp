#include "package_path.h"

#include <tinyxml.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "constants.h"
#include "spring_workbench/scene/scene.h"

namespace spring_workbench::scene {
namespace {

namespace fs = std::filesystem;

/// Package name from the folder's package.xml, or an empty string.
std::string package_name(const fs::path& folder) {
  TiXmlDocument document;
  if (!document.LoadFile((folder / "package.xml").string())) return "";
  const TiXmlElement* package = document.FirstChildElement("package");
  const TiXmlElement* name = package != nullptr ? package->FirstChildElement("name") : nullptr;
  const char* text = name != nullptr ? name->GetText() : nullptr;
  return text != nullptr ? text : "";
}

/// Searches for the package in the folder and `depth` levels below; like rospack, not inside other packages.
std::string crawl(const fs::path& folder, const std::string& package, int depth) {
  std::error_code error;
  if (fs::exists(folder / "package.xml", error)) {
    return package_name(folder) == package ? folder.string() : "";
  }
  if (depth == 0 || fs::exists(folder / "CATKIN_IGNORE", error)) return "";
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (!entry.is_directory(error) || entry.path().filename().string().front() == '.') continue;
    const std::string found = crawl(entry.path(), package, depth - 1);
    if (!found.empty()) return found;
  }
  return "";
}

}  // namespace

std::string find_package_in_ros_package_path(const std::string& package) {
  const char* path = std::getenv("ROS_PACKAGE_PATH");
  if (path == nullptr || package.empty()) return "";
  std::istringstream folders(path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (folder.empty()) continue;
    if (package_name(fs::path(folder) / package) == package) return (fs::path(folder) / package).string();
    const std::string found = crawl(folder, package, package_depth);
    if (!found.empty()) return found;
  }
  return "";
}

bool is_in_a_package(const fs::path& path) {
  std::error_code error;
  fs::path folder = fs::weakly_canonical(path, error).parent_path();
  for (; !error && folder.has_relative_path(); folder = folder.parent_path()) {
    const std::string name = package_name(folder);
    if (name.empty()) continue;
    const std::string found = find_package_in_ros_package_path(name);
    return !found.empty() && fs::equivalent(found, folder, error);
  }
  return false;
}

}  // namespace spring_workbench::scene
