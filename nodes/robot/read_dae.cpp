#include "robot/read_dae.hpp"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/version.h>

#include <assimp/Importer.hpp>
#include <vector>

namespace ballflow::geometry {
namespace {

using Matrix = aiMatrix4x4t<double>;

void add(const aiScene& scene, const aiNode& node, const Matrix& above, SolidMesh& mesh, int depth) {
  if (depth > 1000) throw InputError("its scene is nested deeper than 1000 levels", "export it again");
  const Matrix here = above * Matrix(node.mTransformation);
  const bool mirrored = aiMatrix3x3t<double>(here).Determinant() < 0;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const aiMesh& part = *scene.mMeshes[node.mMeshes[i]];
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    if (mesh.vertices.size() + part.mNumVertices > 2'000'000'000)
      throw InputError("it has more than 2 000 000 000 vertices", "simplify it");
    for (unsigned v = 0; v < part.mNumVertices; ++v) {
      const aiVector3D p = part.mVertices[v];
      const aiVector3t<double> q = here * aiVector3t<double>(p.x, p.y, p.z);
      mesh.vertices.push_back({q.x, q.y, q.z});
      if (!is_finite(mesh.vertices.back())) {
        throw InputError("vertex " + std::to_string(mesh.vertices.size() - 1) + " is not finite",
                         "export it again");
      }
    }
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices != 3) continue;
      Triangle t{};
      for (std::size_t k = 0; k < 3; ++k) t[k] = first + static_cast<std::int32_t>(face.mIndices[k]);
      if (mirrored) std::swap(t[1], t[2]);
      mesh.triangles.push_back(t);
    }
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) add(scene, *node.mChildren[i], here, mesh, depth + 1);
}

}  // namespace

SolidMesh read_dae(std::string_view content, const std::string& file, Monitor& monitor) {
  monitor.step(0);
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* scene =
      importer.ReadFileFromMemory(content.data(), content.size(), aiProcess_Triangulate, "dae");
  if (scene == nullptr || scene->mRootNode == nullptr)
    throw InputError("cannot read " + file + " as a Collada file: " + importer.GetErrorString(),
                     "export it again, or as STL");
  SolidMesh mesh;
  try {
    add(*scene, *scene->mRootNode, Matrix(), mesh, 0);
  } catch (const InputError& error) {
    const std::string text = error.what();
    throw InputError(file + ": " + text.substr(0, text.find('\n')), "export it again");
  }
  if (mesh.triangles.empty()) throw InputError(file + " has no triangles", "export it with its faces");
  return mesh;
}

std::string dae_library_version() {
  return std::to_string(aiGetVersionMajor()) + "." + std::to_string(aiGetVersionMinor());
}

}  // namespace ballflow::geometry
