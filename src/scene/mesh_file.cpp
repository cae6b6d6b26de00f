#include "mesh_file.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

#include "constants.h"
#include "mesh_reader.h"
#include "package_path.h"
#include "spring_workbench/geometry/orientation.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::scene {
namespace {

namespace fs = std::filesystem;

bool starts_with(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

[[noreturn]] void refuse_missing(const std::string& where, const std::string& key, const std::string& name,
                                 const std::string& rule) {
  try {
    validation::refuse(where, key, name, rule);
  } catch (const validation::InputError& error) {
    throw MissingFile(error.what());
  }
}

std::string package_file(const std::string& name, const std::string& where, const std::string& key) {
  const std::string rest = name.substr(std::string("package://").size());
  const std::string package = rest.substr(0, rest.find('/'));
  const std::string folder = find_package_in_ros_package_path(package);
  if (folder.empty()) refuse_missing(where, key, name, "a package on ROS_PACKAGE_PATH");
  return folder + rest.substr(package.size());
}

/// Whether the path, with symbolic links resolved, is in one of the folders.
bool is_in_a_root(const fs::path& path, const std::vector<std::string>& roots) {
  std::error_code error;
  const fs::path file = fs::weakly_canonical(path, error);
  return !error && std::any_of(roots.begin(), roots.end(), [&](const std::string& root) {
    const fs::path folder = fs::canonical(root, error);
    const fs::path inside = file.lexically_relative(folder);
    return !error && !inside.empty() && *inside.begin() != "..";
  });
}

std::string lower_extension(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

struct LessByCoordinates {
  bool operator()(const Vector3d& a, const Vector3d& b) const {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  }
};

/// Merges equal vertices and removes unused ones.
void merge_vertices(geometry::TriangleMesh& mesh) {
  std::map<Vector3d, int, LessByCoordinates> index_of;
  std::vector<Vector3d> vertices;
  for (Eigen::Vector3i& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const auto [place, is_new] = index_of.emplace(mesh.corner(t, k), static_cast<int>(vertices.size()));
      if (is_new) vertices.push_back(mesh.corner(t, k));
      t[k] = place->second;
    }
  }
  mesh.vertices = std::move(vertices);
}

void check_indices(const geometry::TriangleMesh& mesh, const std::string& where) {
  const int count = static_cast<int>(mesh.vertices.size());
  for (const Eigen::Vector3i& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      if (t[k] < 0 || t[k] >= count) {
        validation::refuse(where, "vertex index", std::to_string(t[k]),
                           "an integer between 0 and " + std::to_string(count - 1));
      }
      if (!mesh.corner(t, k).allFinite()) {
        validation::refuse(where, "vertex", "finite coordinates");
      }
    }
  }
}

bool is_flat(const geometry::TriangleMesh& mesh, const Eigen::Vector3i& t) {
  return (mesh.corner(t, 1) - mesh.corner(t, 0)).cross(mesh.corner(t, 2) - mesh.corner(t, 0)).norm() == 0.0;
}

/// Converts a name, as accepted by resolve_file(), to a path.
fs::path path_of(const std::string& name, const std::string& folder, const std::string& where, const std::string& key) {
  if (starts_with(name, "package://")) return package_file(name, where, key);
  if (starts_with(name, "file://")) return name.substr(std::string("file://").size());
  if (name.find("://") != name.npos) validation::refuse(where, key, name, "a path, or a file:// or package:// URI");
  return fs::path(folder) / name;
}

/// Throws InputError unless the path is in an allowed folder.
void check_folder(const fs::path& path, const std::vector<std::string>& roots, const std::string& name,
                  const std::string& where, const std::string& key) {
  if (roots.empty() || is_in_a_root(path, roots) || is_in_a_package(path)) return;
  validation::refuse(where, key, name,
                     "a file in a ROS package or in one of the folders " + validation::join(roots) +
                         " (to add folders, use the parameter scene_roots or the argument roots)");
}

}  // namespace

std::string resolve_file(const std::string& name, const std::string& folder, const std::vector<std::string>& roots,
                         const std::string& where, const std::string& key) {
  const std::string path = path_of(name, folder, where, key).string();
  std::error_code error;
  if (name.empty()) validation::refuse(where, key, name, "a path");
  check_folder(path, roots, name, where,
               key);  // checked first, so that the message does not reveal which files exist elsewhere
  const std::string absolute = fs::absolute(path).lexically_normal().string();
  if (const fs::file_status status = fs::status(path, error); !fs::is_regular_file(status)) {
    const char* const kind = fs::is_directory(status) ? "Is a directory" : "not a regular file";
    const std::string reason = error ? error.message() : kind;
    refuse_missing(where, key, name, "a readable file (" + (absolute == name ? "" : absolute + ": ") + reason + ")");
  }
  const std::uintmax_t bytes = fs::file_size(path, error);
  const auto mebibytes = [](std::uintmax_t size) { return std::to_string((size + 0xfffff) >> 20) + " MiB"; };
  if (error || bytes > max_bytes) {
    validation::refuse(where, key, name, "a file of at most " + mebibytes(max_bytes) + ", got " + mebibytes(bytes));
  }
  return absolute;
}

std::string resolve_new_file(const std::string& name, const std::vector<std::string>& roots, const std::string& where,
                             const std::string& key) {
  const fs::path path = path_of(name, "", where, key);
  std::error_code error;
  if (!path.is_absolute() || !fs::is_directory(path.parent_path(), error)) {
    validation::refuse(where, key, name, "a package:// URI or an absolute path, in a folder that exists");
  }
  check_folder(path, roots, name, where, key);
  return path.lexically_normal().string();
}

geometry::TriangleMesh clean_mesh(geometry::TriangleMesh mesh, const std::string& where) {
  check_indices(mesh, where);
  mesh.triangles.erase(std::remove_if(mesh.triangles.begin(), mesh.triangles.end(),
                                      [&](const Eigen::Vector3i& t) { return is_flat(mesh, t); }),
                       mesh.triangles.end());
  if (mesh.triangles.empty()) validation::refuse(where, "triangles", "at least one that is not flat");
  merge_vertices(mesh);
  geometry::orient(mesh);
  return mesh;
}

bool is_closed(const geometry::TriangleMesh& mesh) {
  std::multiset<std::pair<int, int>> open;  // directed edges whose opposite has not been found yet
  for (const Eigen::Vector3i& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const std::pair<int, int> edge(t[k], t[(k + 1) % 3]);
      const auto opposite = open.find({edge.second, edge.first});
      if (opposite != open.end()) {
        open.erase(opposite);
      } else {
        open.insert(edge);
      }
    }
  }
  return open.empty();
}

MeshCache::MeshCache(std::vector<std::string> roots, const std::vector<Body>& present)
    : roots_(std::move(roots)), time_left_(max_scene_time) {
  std::set<geometry::MeshPtr> counted;
  for (const Body& body : present) {
    for (const auto* shapes : {&body.collision, &body.visual}) {
      for (const geometry::Shape& shape : *shapes) {
        const auto* const mesh = std::get_if<geometry::MeshPtr>(&shape.geometry);
        if (mesh != nullptr && counted.insert(*mesh).second) triangles_ += (*mesh)->triangles.size();
      }
    }
  }
}

geometry::MeshPtr MeshCache::load(const std::string& name, const Vector3d& scale, const std::string& folder,
                                  const std::string& where) {
  if (!scale.allFinite() || scale.prod() == 0.0) validation::refuse(where, "mesh scale", "finite nonzero numbers");
  const std::string path = resolve_file(name, folder, roots_, where, "mesh");
  geometry::MeshPtr& mesh = meshes_[{path, scale.x(), scale.y(), scale.z()}];
  if (mesh) return mesh;
  static const std::array<std::string, 3> formats = {".stl", ".obj", ".dae"};
  if (std::find(formats.begin(), formats.end(), lower_extension(path)) == formats.end()) {
    validation::refuse(where, "mesh", name, "an STL, OBJ or DAE file");
  }
  const std::string mesh_where = where + ": " + name;
  geometry::TriangleMesh loaded = read_triangles(path, mesh_where, time_left_);
  triangles_ += loaded.triangles.size();
  if (triangles_ > max_scene_triangles) {
    validation::refuse(mesh_where, "triangles of the scene",
                       "at most " + std::to_string(max_scene_triangles) + ", got " + std::to_string(triangles_));
  }
  for (Vector3d& v : loaded.vertices) v = v.cwiseProduct(scale);
  loaded = clean_mesh(std::move(loaded), mesh_where);
  loaded.uri = starts_with(name, "package://") ? name : "file://" + path;
  loaded.scale = scale;
  mesh = std::make_shared<const geometry::TriangleMesh>(std::move(loaded));
  return mesh;
}

}  // namespace spring_workbench::scene
