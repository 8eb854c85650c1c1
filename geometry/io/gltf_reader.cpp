#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <glissade/base/byte_order.h>

#include "io/glb_writer.h"
#include "io/gltf_document.h"
#include "io/gltf_placement.h"
#include "io/mesh_validation.h"

namespace glissade::geometry {
namespace {

using nlohmann::json;

// The values of `mode` for triangles: a list, a strip, a fan.
constexpr std::uint64_t kTriangles = 4;
constexpr std::uint64_t kTriangleFan = 6;

/// Limit for the points and corners of all triangles, both in the file and after its nodes have placed them: a small
/// file may refer to the same ones again and again. This many, of 12 and 4 bytes each, still fit the 32-bit lengths of
/// a GLB.
constexpr std::uint64_t kMostPointsAndCorners = 200'000'000;

/// Reads a glTF document, and writes a new one of its triangles and the nodes that place them.
class GltfReader {
 public:
  explicit GltfReader(const GltfDocument& document) : document_(document) {}

  std::string clean() {
    document_.check_version();
    read_meshes();
    read_nodes();
    if (placed_ == 0) reject(document_.path(), "The scene has no triangles");
    return output_.written();
  }

 private:
  void read_meshes() {
    output_.document()["meshes"] = json::array();
    if (!document_.root().contains("meshes")) reject(document_.path(), "The file has no meshes");
    const json& meshes = document_.root().at("meshes");
    for (std::size_t m = 0; m < meshes.size(); ++m) {
      const std::uint64_t read_before = read_;
      json primitives = json::array();
      const json& given = meshes.at(m).at("primitives");
      for (std::size_t p = 0; p < given.size(); ++p) {
        const std::string where = "meshes[" + std::to_string(m) + "].primitives[" + std::to_string(p) + "]";
        const std::uint64_t mode = document_.natural_or(given.at(p), "mode", kTriangles, where);
        if (mode > kTriangleFan)
          reject(document_.path(), where + ": the mode " + std::to_string(mode) + " is not known");
        if (mode >= kTriangles) primitives.push_back(read_primitive(given.at(p), mode, where));
      }
      // A mesh of lines and points only is kept, without primitives, so that indices of meshes remain valid.
      mesh_sizes_.push_back(read_ - read_before);
      output_.document()["meshes"].push_back({{"primitives", primitives}});
    }
  }

  json read_primitive(const json& primitive, std::uint64_t mode, const std::string& where) {
    const json& positions = primitive.at("attributes").at("POSITION");
    if (document_.component(positions) != kGltfFloat)
      reject(document_.path(), where + ": POSITION must be of componentType 5126 (float)");
    const GltfDocument::Elements points = document_.elements(positions, "VEC3", 12);
    count(read_, points.count, where);
    std::string bytes;
    for (std::size_t i = 0; i < points.count; ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto value = base::number_at<float>(points.bytes, points.begin + i * points.stride + 4 * axis);
        check_coordinate(document_.path(), where + ", position " + std::to_string(i), static_cast<double>(value));
        base::append_number(bytes, value);
      }
    }
    json result{{"mode", mode},
                {"attributes", {{"POSITION", output_.add_accessor(bytes, kGltfFloat, "VEC3", points.count)}}}};
    std::size_t corners = points.count;
    if (primitive.contains("indices")) {
      std::string indices;
      corners = read_indices(primitive.at("indices"), points.count, where, indices);
      result["indices"] = output_.add_accessor(indices, kGltfInt, "SCALAR", corners);
    }
    if (corners < 3 || (mode == kTriangles && corners % 3 != 0)) {
      reject(document_.path(), where + ": " + std::to_string(corners) + " corners do not make up triangles");
    }
    return result;
  }

  std::size_t read_indices(const json& index, std::size_t points, const std::string& where, std::string& bytes) {
    const std::uint64_t type = document_.component(index);
    if (type != kGltfByte && type != kGltfShort && type != kGltfInt) {
      reject(document_.path(), where + ": indices must be of componentType 5121, 5123 or 5125");
    }
    const std::size_t size = type == kGltfByte ? 1 : type == kGltfShort ? 2 : 4;
    const GltfDocument::Elements items = document_.elements(index, "SCALAR", size);
    count(read_, items.count, where);
    for (std::size_t i = 0; i < items.count; ++i) {
      const std::size_t at = items.begin + i * items.stride;
      const std::uint32_t value = type == kGltfByte    ? base::number_at<std::uint8_t>(items.bytes, at)
                                  : type == kGltfShort ? base::number_at<std::uint16_t>(items.bytes, at)
                                                       : base::number_at<std::uint32_t>(items.bytes, at);
      if (value >= points) {
        reject(document_.path(), where + ": index " + std::to_string(i) + " is " + std::to_string(value) +
                                     ", but there are " + std::to_string(points) + " positions");
      }
      base::append_number(bytes, value);
    }
    return items.count;
  }

  void read_nodes() {
    std::vector<std::size_t> roots;
    if (document_.root().contains("scenes")) {
      const json& scene =
          document_.entry("scenes", document_.root().contains("scene") ? document_.root().at("scene") : json(0U));
      if (scene.contains("nodes")) {
        for (const json& node : scene.at("nodes")) {
          roots.push_back(copied_node(node, 0));
        }
      }
    } else {
      reject(document_.path(), "The file has no scenes");
    }
    output_.document()["scenes"] = json::array({{{"nodes", roots}}});
    output_.document()["scene"] = 0;
  }

  /// Copies a node and its descendants; returns its new index.
  std::size_t copied_node(const json& index, int depth) {
    const json& node = document_.entry("nodes", index);
    const std::string where = "nodes[" + index.dump() + "]";
    if (depth > 200) reject(document_.path(), where + ": the tree of nodes is more than 200 deep");
    if (!visited_.insert(index.get<std::size_t>()).second) reject(document_.path(), where + ": the node is used twice");
    json copy = copied_placement(document_.path(), node, where);
    if (node.contains("mesh")) {
      document_.entry("meshes", node.at("mesh"));
      const std::uint64_t size = mesh_sizes_.at(node.at("mesh").get<std::size_t>());
      if (size > 0) copy["mesh"] = node.at("mesh");
      count(placed_, size, where);
    }
    const std::size_t result = output_.document()["nodes"].size();
    output_.document()["nodes"].push_back(copy);
    if (node.contains("children")) {
      std::vector<std::size_t> children;
      for (const json& child : node.at("children")) {
        children.push_back(copied_node(child, depth + 1));
      }
      if (!children.empty()) output_.document()["nodes"][result]["children"] = children;
    }
    return result;
  }

  void count(std::uint64_t& sum, std::uint64_t number, const std::string& where) const {
    sum += number;
    if (sum > kMostPointsAndCorners) {
      reject(document_.path(), where + ": up to here there are more than " + std::to_string(kMostPointsAndCorners) +
                                   " points and corners of triangles");
    }
  }

  const GltfDocument& document_;
  GlbWriter output_;
  std::uint64_t read_ = 0;                 // points and corners in the clean file
  std::uint64_t placed_ = 0;               // the same after the nodes have placed them
  std::vector<std::uint64_t> mesh_sizes_;  // points and corners in each mesh; 0 if it has no triangles
  std::set<std::size_t> visited_;
};

/// Runs the reader; the JSON library throws for entries that are missing or of the wrong type.
std::string cleaned(const std::filesystem::path& path, std::string_view text, std::string_view binary) {
  const json document = parsed_gltf(path, text);
  try {
    return GltfReader(GltfDocument(path, document, binary)).clean();
  } catch (const json::exception& error) {
    const std::string what = error.what();  // begins with "[json.exception.type_error.302] "
    const std::size_t end = what.find("] ");
    reject(path, "An entry is missing or of the wrong kind: " + what.substr(end == std::string::npos ? 0 : end + 2));
  }
}

}  // namespace

VettedFile vetted_gltf(const std::filesystem::path& path, std::string_view bytes) {
  return {cleaned(path, bytes, {})};
}

VettedFile vetted_glb(const std::filesystem::path& path, std::string_view bytes) {
  if (bytes.size() < 20 || !bytes.starts_with("glTF"))
    reject(path, "A GLB file begins with 'glTF' and a header of 20 bytes");
  if (base::number_at<std::uint32_t>(bytes, 4) != 2) reject(path, "The version in the header is not 2");
  const std::uint32_t length = base::number_at<std::uint32_t>(bytes, 8);
  if (length != bytes.size()) {
    reject(path, "The file is truncated or too long: it has " + std::to_string(bytes.size()) +
                     " bytes, its header says " + std::to_string(length));
  }
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
  return {cleaned(path, text, binary)};
}

}  // namespace glissade::geometry
