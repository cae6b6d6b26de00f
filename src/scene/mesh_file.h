#pragma once

#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "spring_workbench/scene/scene.h"
#include "spring_workbench/validation/input_error.h"

namespace spring_workbench::scene {

/// A file that a scene names, or its package, does not exist.
class MissingFile : public validation::InputError {
 public:
  using InputError::InputError;
};

/// Resolves a file name in a scene: `package://`, `file://`, absolute, or relative to `folder`. Throws MissingFile
/// naming `where`, `key` and the name if there is no such file, and InputError if it is neither in one of `roots` nor
/// in a package (see load_scene()), whether it exists or not, or if it is too large.
std::string resolve_file(const std::string& name, const std::string& folder, const std::vector<std::string>& roots,
                         const std::string& where, const std::string& key);

/// Resolves the name of a file to be written, which may exist or not, by the same rules. Throws InputError if its
/// folder does not exist.
std::string resolve_new_file(const std::string& name, const std::vector<std::string>& roots, const std::string& where,
                             const std::string& key);

/// Cleans a mesh: merges equal vertices, removes degenerate triangles, and orients the others (see geometry::orient).
/// Throws InputError naming `where` for invalid indices, values that are not finite, or if no triangle is left.
geometry::TriangleMesh clean_mesh(geometry::TriangleMesh mesh, const std::string& where);

/// Whether every edge has a triangle on both sides with opposite directions, so that the mesh has a volume.
bool is_closed(const geometry::TriangleMesh& mesh);

/// Loads the STL, OBJ and DAE files of a scene, each once, within the scene's budget of triangles and time.
class MeshCache {
 public:
  /// `roots`: as in load_scene(). `present`: bodies that the scene has already. Their meshes count, each once.
  explicit MeshCache(std::vector<std::string> roots, const std::vector<Body>& present = {});

  /// The mesh that a URDF in `folder` refers to as `name`, multiplied by `scale`. Throws InputError naming `where`.
  geometry::MeshPtr load(const std::string& name, const Vector3d& scale, const std::string& folder,
                         const std::string& where);

 private:
  std::vector<std::string> roots_;
  std::size_t triangles_ = 0;  ///< total number in the scene so far
  double time_left_;           ///< processor time left for reading [s]
  std::map<std::tuple<std::string, double, double, double>, geometry::MeshPtr> meshes_;
};

}  // namespace spring_workbench::scene
