#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>

#include <assimp/Importer.hpp>
#include <assimp/scene.h>

#include <glissade/geometry/mesh_import.h>
#include <glissade/geometry/triangle_mesh.h>
#include <glissade/geometry/triangle_pair.h>

#include "io/file_head.h"
#include "io/mesh_validation.h"

namespace glissade::geometry {
namespace {

struct Format {
  const char* extension;
  VettedFile (*vetted)(const std::filesystem::path&, std::string_view);
  const char* hint;  // format of the clean file, for the importer library
};

constexpr std::array<Format, 5> kFormats{{{".obj", &vetted_obj, "obj"},
                                          {".stl", &vetted_stl, "stl"},
                                          {".ply", &vetted_ply, "ply"},
                                          {".gltf", &vetted_gltf, "glb"},
                                          {".glb", &vetted_glb, "glb"}}};

const Format& format_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const Format& format : kFormats) {
    if (extension == format.extension) return format;
  }
  reject(path, "The format '" + extension + "' is not known; known are .obj, .stl, .ply, .gltf and .glb");
}

const aiScene& read_scene(Assimp::Importer& importer, const std::filesystem::path& path, const std::string& bytes,
                          const char* hint) {
  const aiScene* scene = nullptr;
  std::string problem;
  try {
    scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, hint);
    problem = importer.GetErrorString();
  } catch (const std::exception& error) {
    problem = error.what();
  }
  if (scene == nullptr || scene->mRootNode == nullptr) reject(path, "The file cannot be imported: " + problem);
  return *scene;
}

Eigen::Matrix4d matrix(const aiMatrix4x4& m) {
  Eigen::Matrix4d result;
  for (unsigned row = 0; row < 4; ++row) {
    for (unsigned column = 0; column < 4; ++column) {
      result(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) = static_cast<double>(m[row][column]);
    }
  }
  return result;
}

/// Adds the triangles of a node and of all nodes below it to `mesh_Scene`, in the frame of the scene. `M_SceneParent`
/// maps from the frame of the node's parent. The matrices may scale and shear.
void add_node(const aiScene& scene, const aiNode& node, const Eigen::Matrix4d& M_SceneParent,
              TriangleMesh& mesh_Scene) {
  const Eigen::Matrix4d M_SceneNode = M_SceneParent * matrix(node.mTransformation);
  for (unsigned m = 0; m < node.mNumMeshes; ++m) {
    const aiMesh& part = *scene.mMeshes[node.mMeshes[m]];
    const auto offset = static_cast<std::int32_t>(mesh_Scene.vertices.size());
    for (unsigned v = 0; v < part.mNumVertices; ++v) {
      const aiVector3D& p = part.mVertices[v];
      const Eigen::Vector4d p_Node(static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z), 1.0);
      mesh_Scene.vertices.emplace_back((M_SceneNode * p_Node).head<3>());
    }
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices != 3) continue;
      mesh_Scene.triangles.push_back({offset + static_cast<std::int32_t>(face.mIndices[0]),
                                      offset + static_cast<std::int32_t>(face.mIndices[1]),
                                      offset + static_cast<std::int32_t>(face.mIndices[2])});
    }
  }
  for (unsigned c = 0; c < node.mNumChildren; ++c) {
    add_node(scene, *node.mChildren[c], M_SceneNode, mesh_Scene);
  }
}

std::int64_t drop_degenerate(TriangleMesh& mesh) {
  const std::size_t before = mesh.triangles.size();
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    const auto at = [&](std::size_t corner) { return mesh.vertices[static_cast<std::size_t>(t[corner])]; };
    return is_degenerate({at(0), at(1), at(2)});
  });
  return static_cast<std::int64_t>(before - mesh.triangles.size());
}

}  // namespace

ImportedMesh import_mesh(const std::filesystem::path& path, double scale) {
  if (!std::isfinite(scale) || scale <= 0) {
    std::ostringstream message;
    message << "The scale must be positive and finite, but is " << scale;
    reject(path, message.str());
  }
  check_head(path);
  const std::string content = file_content(path);
  const Format& format = format_of(path);
  const VettedFile clean = format.vetted(path, content);

  Assimp::Importer importer;
  const aiScene& scene = read_scene(importer, path, clean.bytes, format.hint);
  ImportedMesh result;
  result.polygons_triangulated = clean.polygons_triangulated;
  TriangleMesh soup;
  add_node(scene, *scene.mRootNode, Eigen::Matrix4d::Identity(), soup);
  for (Eigen::Vector3d& vertex : soup.vertices) {
    vertex *= scale;
    for (const double coordinate : vertex) {
      check_coordinate(path, "After scaling", coordinate);
    }
  }
  result.mesh = weld(soup);
  result.degenerate_triangles = drop_degenerate(result.mesh);
  if (result.degenerate_triangles > 0) result.mesh = weld(result.mesh);  // drops the vertices that only they used
  if (result.mesh.triangles.empty()) {
    reject(path, "None of its " + std::to_string(result.degenerate_triangles) + " triangles has an area");
  }
  return result;
}

}  // namespace glissade::geometry
