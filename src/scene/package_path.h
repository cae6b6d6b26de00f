#pragma once

#include <filesystem>

namespace spring_workbench::scene {

/// Whether an existing file, with symbolic links resolved, is in a package that find_package_in_ros_package_path()
/// finds.
bool is_in_a_package(const std::filesystem::path& path);

}  // namespace spring_workbench::scene
