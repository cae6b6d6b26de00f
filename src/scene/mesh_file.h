#pragma once

#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "spring_workbench/scene/scene.h"

namespace spring_workbench::scene {

/// The path that a file name in a scene means: `package://`, `file://`, absolute, or relative to `folder`.
/// Throws InputError naming `where`, `key` and the name where there is no such file, it is neither in one of `roots`
/// nor in a package (as load_scene() says), or it is larger than a scene's files may be.
std::string resolve_file(const std::string& name, const std::string& folder, const std::vector<std::string>& roots,
                         const std::string& where, const std::string& key);

/// The path of a file that may be written, there or not, by the same rules. Throws InputError where its folder is not.
std::string resolve_new_file(const std::string& name, const std::vector<std::string>& roots, const std::string& where,
                             const std::string& key);

/// Makes a mesh fit for use: equal vertices become one, flat triangles go, a mesh that is inside out is turned.
/// Throws InputError naming `where` for bad indices, values that are not finite, or no triangle left.
geometry::TriangleMesh clean_mesh(geometry::TriangleMesh mesh, const std::string& where);

/// Whether every edge has a triangle on both sides, in opposite directions: only then a mesh has a volume.
bool is_closed(const geometry::TriangleMesh& mesh);

/// Loads the STL, OBJ and DAE files of a scene, each once, within the scene's budget of triangles and time.
class MeshCache {
 public:
  /// `roots`: as of load_scene().
  explicit MeshCache(std::vector<std::string> roots);

  /// The mesh called `name` in a URDF in `folder`, times `scale`. Throws InputError naming `where`.
  geometry::MeshPtr load(const std::string& name, const Vector3d& scale, const std::string& folder,
                         const std::string& where);

 private:
  std::vector<std::string> roots_;
  std::size_t triangles_ = 0;  ///< of all so far
  double time_left_;           ///< of the processor, for reading [s]
  std::map<std::tuple<std::string, double, double, double>, geometry::MeshPtr> meshes_;
};

}  // namespace spring_workbench::scene
