#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <numeric>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include <glissade/base/byte_order.h>

#include "io/gltf_document.h"
#include "io/gltf_placement.h"
#include "io/mesh_readers.h"

namespace glissade::geometry {
namespace {

using nlohmann::json;

// The values of `mode` for triangles: a list, a strip, a fan.
constexpr std::uint64_t kTriangles = 4;
constexpr std::uint64_t kTriangleStrip = 5;
constexpr std::uint64_t kTriangleFan = 6;

/// Limit for the points and corners of all triangles, both in the file and after its nodes have placed them: a small
/// file may refer to the same ones again and again. This many take a few gigabytes.
constexpr std::uint64_t kMostPointsAndCorners = 200'000'000;

/// The number at byte `at`; integers of a normalized accessor stand for fractions of the largest integer.
double position_at(std::string_view bytes, std::size_t at, std::uint64_t component, bool is_normalized) {
  const auto scaled = [&](double value, double largest) {
    return is_normalized ? std::max(value / largest, -1.0) : value;
  };
  switch (component) {
    case kGltfInt8:
      return scaled(base::number_at<std::int8_t>(bytes, at), 127);
    case kGltfUint8:
      return scaled(base::number_at<std::uint8_t>(bytes, at), 255);
    case kGltfInt16:
      return scaled(base::number_at<std::int16_t>(bytes, at), 32767);
    case kGltfUint16:
      return scaled(base::number_at<std::uint16_t>(bytes, at), 65535);
    default:
      return static_cast<double>(base::number_at<float>(bytes, at));
  }
}

std::size_t size_of_component(std::uint64_t component) {
  if (component == kGltfInt8 || component == kGltfUint8) return 1;
  return component == kGltfInt16 || component == kGltfUint16 ? 2 : 4;
}

/// Adds the triangles of a list, strip or fan.
void add_triangles(std::span<const std::int32_t> corners, std::uint64_t mode, std::vector<Triangle>& triangles) {
  if (mode == kTriangles) {
    for (std::size_t i = 0; i < corners.size(); i += 3) {
      triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
    }
    return;
  }
  for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
    const std::size_t odd = mode == kTriangleStrip ? i % 2 : 0;  // every second triangle of a strip is turned round
    const std::size_t first = mode == kTriangleStrip ? i : 0;
    triangles.push_back({corners[first], corners[i + 1 + odd], corners[i + 2 - odd]});
  }
}

/// Reads a glTF document: its meshes first, then where its nodes place them.
class GltfReader {
 public:
  explicit GltfReader(const GltfDocument& document) : document_(document) {}

  TriangleMesh read() {
    document_.check_version();
    read_meshes();
    read_nodes();
    if (placed_ == 0) reject(document_.path(), "The scene has no triangles");
    return assembled();
  }

 private:
  /// A mesh of the document. Its size counts points and corners; it is 0 if the mesh has no triangles.
  struct Mesh {
    TriangleMesh mesh;
    std::uint64_t size = 0;
  };
  struct PlacedMesh {
    std::size_t mesh;
    Eigen::Affine3d X_SceneMesh;
  };

  void read_meshes() {
    if (!document_.root().contains("meshes")) reject(document_.path(), "The file has no meshes");
    const json& meshes = document_.root().at("meshes");
    for (std::size_t m = 0; m < meshes.size(); ++m) {
      const std::uint64_t read_before = read_;
      Mesh& mesh = meshes_.emplace_back();
      const json& given = meshes.at(m).at("primitives");
      for (std::size_t p = 0; p < given.size(); ++p) {
        const std::string where = "meshes[" + std::to_string(m) + "].primitives[" + std::to_string(p) + "]";
        const std::uint64_t mode = document_.natural_or(given.at(p), "mode", kTriangles, where);
        if (mode > kTriangleFan)
          reject(document_.path(), where + ": the mode " + std::to_string(mode) + " is not known");
        if (mode >= kTriangles) read_primitive(given.at(p), mode, where, mesh.mesh);
      }
      mesh.size = read_ - read_before;
    }
  }

  void read_primitive(const json& primitive, std::uint64_t mode, const std::string& where, TriangleMesh& mesh) {
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    const std::size_t points = read_positions(primitive.at("attributes").at("POSITION"), where, mesh);
    std::vector<std::int32_t> corners;
    if (primitive.contains("indices")) {
      corners = read_indices(primitive.at("indices"), points, where);
    } else {
      corners.resize(points);
      std::iota(corners.begin(), corners.end(), 0);
    }
    if (corners.size() < 3 || (mode == kTriangles && corners.size() % 3 != 0)) {
      reject(document_.path(), where + ": " + std::to_string(corners.size()) + " corners do not make up triangles");
    }
    for (std::int32_t& corner : corners) {
      corner += first;
    }
    add_triangles(corners, mode, mesh.triangles);
  }

  /// Adds the vertices of a primitive; returns their number.
  std::size_t read_positions(const json& index, const std::string& where, TriangleMesh& mesh) {
    const std::uint64_t component = document_.component(index);
    const bool is_quantized = component >= kGltfInt8 && component <= kGltfUint16;
    if (component != kGltfFloat && !(is_quantized && document_.allows_quantized_positions()))
      reject(document_.path(), where + ": POSITION must be of componentType 5126 (float)");
    const std::size_t size = size_of_component(component);
    const bool is_normalized = document_.is_normalized(index);
    const GltfDocument::Elements points = document_.elements(index, "VEC3", 3 * size);
    count(read_, points.count, where);
    for (std::size_t i = 0; i < points.count; ++i) {
      Eigen::Vector3d& vertex = mesh.vertices.emplace_back();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t at = points.begin + i * points.stride + axis * size;
        const double value = position_at(points.bytes, at, component, is_normalized);
        if (!is_coordinate(value))
          reject_coordinate(document_.path(), where + ", position " + std::to_string(i), value);
        vertex[static_cast<Eigen::Index>(axis)] = value;
      }
    }
    return points.count;
  }

  std::vector<std::int32_t> read_indices(const json& index, std::size_t points, const std::string& where) {
    const std::uint64_t type = document_.component(index);
    if (type != kGltfUint8 && type != kGltfUint16 && type != kGltfUint32) {
      reject(document_.path(), where + ": indices must be of componentType 5121, 5123 or 5125");
    }
    const GltfDocument::Elements items = document_.elements(index, "SCALAR", size_of_component(type));
    count(read_, items.count, where);
    std::vector<std::int32_t> indices;
    indices.reserve(items.count);
    for (std::size_t i = 0; i < items.count; ++i) {
      const std::size_t at = items.begin + i * items.stride;
      const std::uint32_t value = type == kGltfUint8    ? base::number_at<std::uint8_t>(items.bytes, at)
                                  : type == kGltfUint16 ? base::number_at<std::uint16_t>(items.bytes, at)
                                                        : base::number_at<std::uint32_t>(items.bytes, at);
      if (value >= points) {
        reject(document_.path(), where + ": index " + std::to_string(i) + " is " + std::to_string(value) +
                                     ", but there are " + std::to_string(points) + " positions");
      }
      indices.push_back(static_cast<std::int32_t>(value));
    }
    return indices;
  }

  void read_nodes() {
    if (!document_.root().contains("scenes")) reject(document_.path(), "The file has no scenes");
    const json& scene =
        document_.entry("scenes", document_.root().contains("scene") ? document_.root().at("scene") : json(0U));
    if (!scene.contains("nodes")) return;
    for (const json& node : scene.at("nodes")) {
      read_node(node, Eigen::Affine3d::Identity(), 0);
    }
  }

  /// Places the meshes of a node and its descendants.
  void read_node(const json& index, const Eigen::Affine3d& X_SceneParent, int depth) {
    const json& node = document_.entry("nodes", index);
    const std::string where = "nodes[" + index.dump() + "]";
    if (depth > 200) reject(document_.path(), where + ": the tree of nodes is more than 200 deep");
    if (!visited_.insert(index.get<std::size_t>()).second) reject(document_.path(), where + ": the node is used twice");
    const Eigen::Affine3d X_SceneNode = X_SceneParent * placement(document_.path(), node, where);
    if (node.contains("mesh")) {
      document_.entry("meshes", node.at("mesh"));
      const auto mesh = node.at("mesh").get<std::size_t>();
      count(placed_, meshes_.at(mesh).size, where);
      placed_meshes_.push_back({mesh, X_SceneNode});
    }
    if (!node.contains("children")) return;
    for (const json& child : node.at("children")) {
      read_node(child, X_SceneNode, depth + 1);
    }
  }

  TriangleMesh assembled() const {
    TriangleMesh mesh_Scene;
    for (const PlacedMesh& placed : placed_meshes_) {
      const TriangleMesh& mesh = meshes_.at(placed.mesh).mesh;
      const auto first = static_cast<std::int32_t>(mesh_Scene.vertices.size());
      for (const Eigen::Vector3d& vertex : mesh.vertices) {
        mesh_Scene.vertices.emplace_back(placed.X_SceneMesh * vertex);
      }
      for (const Triangle& t : mesh.triangles) {
        mesh_Scene.triangles.push_back({first + t[0], first + t[1], first + t[2]});
      }
    }
    return mesh_Scene;
  }

  void count(std::uint64_t& sum, std::uint64_t number, const std::string& where) const {
    sum += number;
    if (sum > kMostPointsAndCorners) {
      reject(document_.path(), where + ": up to here there are more than " + std::to_string(kMostPointsAndCorners) +
                                   " points and corners of triangles");
    }
  }

  const GltfDocument& document_;
  std::uint64_t read_ = 0;    // points and corners in the file
  std::uint64_t placed_ = 0;  // the same after the nodes have placed them
  std::vector<Mesh> meshes_;
  std::vector<PlacedMesh> placed_meshes_;
  std::set<std::size_t> visited_;
};

/// Runs the reader; the JSON library throws for entries that are missing or of the wrong type.
TriangleMesh read_document(const std::filesystem::path& path, std::string_view text, std::string_view binary) {
  const json document = parsed_gltf(path, text);
  try {
    return GltfReader(GltfDocument(path, document, binary)).read();
  } catch (const json::exception& error) {
    const std::string what = error.what();  // begins with "[json.exception.type_error.302] "
    const std::size_t end = what.find("] ");
    reject(path, "An entry is missing or of the wrong kind: " + what.substr(end == std::string::npos ? 0 : end + 2));
  }
}

}  // namespace

TriangleSoup read_gltf(MeshFile& file) {
  return {read_document(file.path(), file.content(), {})};
}

TriangleSoup read_glb(MeshFile& file) {
  const std::filesystem::path& path = file.path();
  const std::string header = file.beginning(20);
  if (header.size() < 20 || !header.starts_with("glTF"))
    reject(path, "A GLB file begins with 'glTF' and a header of 20 bytes");
  if (base::number_at<std::uint32_t>(header, 4) != 2) reject(path, "The version in the header is not 2");
  const std::uint32_t length = base::number_at<std::uint32_t>(header, 8);
  if (length != file.size()) {
    reject(path, "The file is truncated or too long: it has " + std::to_string(file.size()) +
                     " bytes, its header says " + std::to_string(length));
  }
  const std::string content = file.content();
  const std::string_view bytes = content;
  std::string_view text;
  std::string_view binary;
  for (std::size_t begin = 12; begin < bytes.size();) {
    if (bytes.size() - begin < 8) reject(path, "The chunk at byte " + std::to_string(begin) + " is truncated");
    const std::uint32_t size = base::number_at<std::uint32_t>(bytes, begin);
    const std::string_view kind = bytes.substr(begin + 4, 4);
    if (size > bytes.size() - begin - 8) reject(path, "The chunk at byte " + std::to_string(begin) + " is truncated");
    if (kind == "JSON" && text.empty()) text = bytes.substr(begin + 8, size);
    if (kind == std::string_view("BIN\0", 4) && binary.empty()) binary = bytes.substr(begin + 8, size);
    begin += 8 + size;
  }
  return {read_document(path, text, binary)};
}

}  // namespace glissade::geometry
