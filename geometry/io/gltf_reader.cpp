#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "io/glb_container.h"
#include "io/gltf_accessors.h"
#include "io/gltf_buffers.h"
#include "io/gltf_document.h"
#include "io/gltf_extensions.h"
#include "io/gltf_instances.h"
#include "io/gltf_meshes.h"
#include "io/gltf_morphs.h"
#include "io/gltf_nodes.h"
#include "io/gltf_skins.h"
#include "io/mesh_readers.h"

namespace glissade::geometry {
namespace {

using nlohmann::json;

/// The place of a mesh with a skin does not depend on its node.
constexpr WarningKind kRepeated{
    "node has a mesh with a skin that another node has at the same place, and is left out",
    "nodes have meshes with skins that other nodes have at the same places, and are left out"};

/// Reads a glTF document: each mesh that a node of the scene has, deformed by its morph targets, and placed by the
/// node, by its instances or by the joints of its skin.
class GltfReader {
 public:
  GltfReader(GltfDocument& document, GltfBuffers& buffers)
      : document_(document),
        accessors_(document, buffers),
        nodes_(document),
        meshes_(document, accessors_),
        skins_(document, accessors_, nodes_) {}

  TriangleMesh read() {
    check_extensions(document_);
    if (document_.size("meshes") == 0) reject(document_.path(), "the file has no meshes");
    for (const std::size_t node : nodes_.of_scene()) {
      place_mesh_of(node);
    }
    meshes_.warn_of_unread();
    if (mesh_Scene_.triangles.empty()) {
      std::string message = "the scene has no triangles.";
      for (const std::string& warning : document_.warnings().sentences())
        message += " " + warning;
      reject(document_.path(), message);
    }
    return std::move(mesh_Scene_);
  }

 private:
  void place_mesh_of(std::size_t node) {
    const json& entry = document_.root().at("nodes").at(node);
    if (!entry.contains("mesh")) return;
    const std::string where = "nodes[" + std::to_string(node) + "]";
    const std::size_t mesh = document_.index("meshes", entry.at("mesh"));
    const std::vector<double> weights = morph_weights(document_, node, mesh);
    const std::vector<Eigen::Affine3d> copies = instances(document_, accessors_, node);
    const bool is_plain = copies.size() == 1 && copies.front().matrix() == Eigen::Matrix4d::Identity();
    if (entry.contains("skin") && !is_plain) {
      reject(document_.path(), where + ": it has both a skin and " + kGltfInstancing +
                                   ", and where the copies of such a mesh are is not defined");
    }
    if (entry.contains("skin") &&
        !skinned_.insert({mesh, document_.index("skins", entry.at("skin")), weights}).second) {
      document_.warnings().add(kRepeated, where);
      return;
    }
    for (const GltfPrimitive& primitive : meshes_.primitives(mesh)) {
      const std::vector<Eigen::Vector3d> points = morphed_positions(document_, accessors_, primitive, weights);
      if (entry.contains("skin")) {
        document_.count(primitive.size(), where);
        const std::vector<Eigen::AffineCompact3d> X_SceneMesh = skins_.placements(entry.at("skin"), primitive);
        add(primitive, points, [&](std::size_t point) { return X_SceneMesh[point]; });
        continue;
      }
      for (const Eigen::Affine3d& X_NodeMesh : copies) {
        document_.count(primitive.size(), where);
        const Eigen::Affine3d X_SceneMesh = nodes_.pose(node) * X_NodeMesh;
        add(primitive, points, [&](std::size_t) { return X_SceneMesh; });
      }
    }
  }

  /// Adds the triangles of a primitive. Those that `X_SceneMesh` mirrors are turned round, so that their front stays
  /// their front.
  template <class Placement>
  void add(const GltfPrimitive& primitive, const std::vector<Eigen::Vector3d>& points, Placement X_SceneMesh) {
    const auto first = static_cast<std::int32_t>(mesh_Scene_.vertices.size());
    std::vector<bool> is_mirrored(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto X = X_SceneMesh(i);
      mesh_Scene_.vertices.emplace_back(X * points[i]);
      is_mirrored[i] = X.linear().determinant() < 0;
    }
    for (const auto& [a, b, c] : primitive.triangles) {
      const bool turn = is_mirrored[static_cast<std::size_t>(a)];
      mesh_Scene_.triangles.push_back({first + a, first + (turn ? c : b), first + (turn ? b : c)});
    }
  }

  GltfDocument& document_;
  GltfAccessors accessors_;
  GltfNodes nodes_;
  GltfMeshes meshes_;
  GltfSkins skins_;
  std::set<std::tuple<std::size_t, std::size_t, std::vector<double>>> skinned_;  // meshes, skins and weights so far
  TriangleMesh mesh_Scene_;
};

}  // namespace

TriangleSoup read_gltf(MeshFile& file) {
  MeshWarnings warnings;
  const bool is_container = is_glb(file.beginning(4));
  const std::string content = is_container ? glb_content(file, warnings) : file.content();
  const GlbChunks chunks = is_container ? glb_chunks(file.path(), content) : GlbChunks{content, {}};
  const json root = parsed_gltf(file.path(), chunks.text);
  try {
    GltfDocument document(file.path(), root, std::move(warnings));
    GltfBuffers buffers(file.path(), root, chunks.binary);
    TriangleMesh mesh = GltfReader(document, buffers).read();
    return {std::move(mesh), 0, document.warnings().sentences()};
  } catch (const json::exception& error) {  // for entries that are missing or of the wrong type
    const std::string what = error.what();  // begins with "[json.exception.type_error.302] "
    const std::size_t end = what.find("] ");
    reject(file.path(),
           "an entry is missing or of the wrong kind: " + what.substr(end == std::string::npos ? 0 : end + 2));
  }
}

}  // namespace glissade::geometry
