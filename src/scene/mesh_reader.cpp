#include "mesh_reader.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cstring>

#include "constants.h"
#include "spring_workbench/validation/number_rule.h"
#include "spring_workbench/validation/run_in_child.h"

namespace spring_workbench::scene {
namespace {

constexpr char good = '+', bad = '-';

/// Opens a single file and nothing that it refers to, such as the materials of an OBJ file.
class OneFile : public Assimp::DefaultIOSystem {
 public:
  explicit OneFile(std::string path) : path_(std::move(path)) {}
  bool Exists(const char* file) const override { return path_ == file; }
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    return Exists(file) ? DefaultIOSystem::Open(file, mode) : nullptr;
  }

 private:
  std::string path_;
};

void append(const aiMesh& part, const std::string& where, geometry::TriangleMesh& mesh) {
  const std::size_t first = mesh.vertices.size();
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& v = part.mVertices[i];
    mesh.vertices.emplace_back(static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z));
  }
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (face.mNumIndices != 3) continue;  // a point or a line
    Eigen::Vector3i triangle;
    for (unsigned k = 0; k < 3; ++k) {
      if (face.mIndices[k] >= part.mNumVertices) {
        validation::refuse(where, "vertex index", std::to_string(face.mIndices[k]),
                           "an integer between 0 and " + std::to_string(part.mNumVertices - 1));
      }
      triangle[k] = static_cast<int>(first + face.mIndices[k]);
    }
    mesh.triangles.push_back(triangle);
  }
}

geometry::TriangleMesh read(const std::string& path, const std::string& where) {
  Assimp::Importer importer;
  importer.SetIOHandler(new OneFile(path));  // owned by the importer
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* scene = importer.ReadFile(path, aiProcess_Triangulate | aiProcess_PreTransformVertices);
  if (scene == nullptr)
    validation::refuse(where, "mesh", path, std::string("a readable mesh (") + importer.GetErrorString() + ")");
  std::size_t triangles = 0;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) triangles += scene->mMeshes[i]->mNumFaces;
  if (triangles > max_triangles) {
    validation::refuse(where, "triangles",
                       "at most " + std::to_string(max_triangles) + ", got " + std::to_string(triangles));
  }
  geometry::TriangleMesh mesh;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) append(*scene->mMeshes[i], where, mesh);
  return mesh;
}

template <typename T>
void pack(const std::vector<T>& rows, std::string& data) {
  const std::size_t count = rows.size();
  data.append(reinterpret_cast<const char*>(&count), sizeof count);
  data.append(reinterpret_cast<const char*>(rows.data()), count * sizeof(T));
}

template <typename T>
const char* unpack(const char* data, std::vector<T>& rows) {
  std::size_t count = 0;
  std::memcpy(&count, data, sizeof count);
  rows.resize(count);
  std::memcpy(static_cast<void*>(rows.data()), data + sizeof count, count * sizeof(T));
  return data + sizeof count + count * sizeof(T);
}

/// The bytes sent through the pipe: a mesh, or the reason why there is none.
std::string read_in_child(const std::string& path, const std::string& where) {
  try {
    const geometry::TriangleMesh mesh = read(path, where);
    std::string data(1, good);
    pack(mesh.vertices, data);
    pack(mesh.triangles, data);
    return data;
  } catch (const validation::InputError& refusal) {
    return bad + std::string(refusal.what());
  }
}

}  // namespace

geometry::TriangleMesh read_triangles(const std::string& path, const std::string& where, double& time_left) {
  double used = 0.0;
  std::optional<std::string> data;
  if (time_left > 0.0) {
    data = validation::run_in_child([&] { return read_in_child(path, where); },
                                    {std::min(max_mesh_time, time_left), max_mesh_memory}, &used);
  }
  time_left -= used;
  if (!data || time_left <= 0.0)
    validation::refuse(where, "mesh", path,
                       "a mesh that can be read within 30 s (all meshes of a scene: 60 s) and 2 GiB");
  if (data->front() == bad) throw validation::InputError(data->substr(1));
  geometry::TriangleMesh mesh;
  unpack(unpack(data->data() + 1, mesh.vertices), mesh.triangles);
  return mesh;
}

}  // namespace spring_workbench::scene
