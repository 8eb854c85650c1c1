#include "assimp_oracle.h"

#include <algorithm>

#include <assimp/cimport.h>
#include <assimp/scene.h>

namespace glissade::test_support {

std::int64_t triangles_by_assimp(const std::string& path) {
  const aiScene* scene = aiImportFile(path.c_str(), 0);  // assimp's own triangulation ends the program on some meshes
  if (scene == nullptr) return 0;
  std::int64_t triangles = 0;
  for (unsigned int m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& mesh = *scene->mMeshes[m];
    for (unsigned int f = 0; f < mesh.mNumFaces; ++f)
      triangles += std::max(std::int64_t{mesh.mFaces[f].mNumIndices}, std::int64_t{2}) - 2;
  }
  aiReleaseImport(scene);
  return triangles;
}

}  // namespace glissade::test_support
