#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <set>
#include <vector>

#include <nlohmann/json.hpp>

#include "byte_order.h"
#include "gltf_buffers.h"
#include "gltf_numbers.h"
#include "mesh_validation.h"

namespace glissade::collision {
namespace {

using nlohmann::json;

constexpr std::uint64_t kTriangles = 4;
constexpr std::uint64_t kTriangleFan = 6;
constexpr std::uint64_t kByte = 5121;
constexpr std::uint64_t kShort = 5123;
constexpr std::uint64_t kInt = 5125;
constexpr std::uint64_t kFloat = 5126;

/// Points and corners of all triangles, in the file and after its nodes have placed them: a few bytes may ask for the
/// same ones again and again. So many, of 12 and 4 bytes, still fit the lengths of 32 bits in a GLB.
constexpr std::uint64_t kMostPointsAndCorners = 200'000'000;

/// glTF itself needs about ten; the JSON library's functions recurse.
constexpr int kDeepestNesting = 100;

/// Reads a glTF document and its buffers and writes the triangles and the nodes that place them anew.
class GltfReader {
 public:
  GltfReader(const std::filesystem::path& path, const json& document, std::vector<std::string> buffers)
      : path_(path), document_(document), buffers_(std::move(buffers)) {}

  std::string clean() {
    check_version();
    read_meshes();
    read_nodes();
    if (placed_ == 0) reject(path_, "The scene has no triangles");
    output_["asset"] = {{"version", "2.0"}};
    output_["buffers"] = json::array({{{"byteLength", binary_.size()}}});
    return written();
  }

 private:
  /// Entry `index` of the array `key` of the document.
  const json& entry(const char* key, const json& index) const {
    const std::size_t size = document_.contains(key) ? document_.at(key).size() : 0;
    if (!index.is_number_unsigned() || index.get<std::uint64_t>() >= size) {
      // What is not a number may be of any size.
      const std::string shown = index.is_number() ? index.dump() : std::string(index.type_name());
      reject(path_, std::string(key) + "[" + shown + "] is out of range, there are " + std::to_string(size));
    }
    return document_.at(key).at(index.get<std::size_t>());
  }

  std::uint64_t natural_or(const json& object, const char* key, std::uint64_t otherwise,
                           const std::string& where) const {
    return object.contains(key) ? natural_at(path_, object, key, where) : otherwise;
  }

  /// The componentType of the accessor `index`.
  std::uint64_t component(const json& index) const {
    return natural_at(path_, entry("accessors", index), "componentType", "accessors[" + index.dump() + "]");
  }

  void check_version() const {
    const std::string version = document_.at("asset").at("version").get<std::string>();
    if (!version.starts_with("2.")) reject(path_, "asset.version is not 2.x, but this reads glTF 2");
    if (!document_.contains("extensionsRequired")) return;
    for (const json& extension : document_.at("extensionsRequired")) {
      const auto name = extension.get<std::string>();
      const bool is_about_looks = name.starts_with("KHR_materials_") || name.starts_with("KHR_texture_") ||
                                  name.starts_with("KHR_lights_") || name.starts_with("EXT_texture_");
      if (!is_about_looks) reject(path_, "The required extension '" + name + "' is not supported");
    }
  }

  /// The elements of an accessor: where each begins within its buffer.
  struct Elements {
    std::string_view bytes;
    std::size_t begin;
    std::size_t stride;
    std::size_t count;
  };

  Elements elements(const json& index, const std::string& type, std::size_t element_size) const {
    const json& accessor = entry("accessors", index);
    const std::string where = "accessors[" + index.dump() + "]";
    if (accessor.contains("sparse") || !accessor.contains("bufferView")) {
      reject(path_, where + ": sparse accessors are not supported");
    }
    if (accessor.at("type").get<std::string>() != type) reject(path_, where + ": its type should be " + type);
    const json& view = entry("bufferViews", accessor.at("bufferView"));
    const std::string where_of_view = "bufferViews[" + accessor.at("bufferView").dump() + "]";
    entry("buffers", view.at("buffer"));
    const std::string& buffer = buffers_.at(view.at("buffer").get<std::size_t>());
    const std::uint64_t view_begin = natural_or(view, "byteOffset", 0, where_of_view);
    const std::uint64_t view_size = natural_at(path_, view, "byteLength", where_of_view);
    if (view_begin > buffer.size() || view_size > buffer.size() - view_begin) {
      reject(path_, where_of_view + " reaches beyond its buffer of " + std::to_string(buffer.size()) + " bytes");
    }
    const std::uint64_t begin = natural_or(accessor, "byteOffset", 0, where);
    const std::uint64_t stride = natural_or(view, "byteStride", element_size, where_of_view);
    const std::uint64_t count = natural_at(path_, accessor, "count", where);
    if (stride < element_size || stride > 252) reject(path_, where + ": its byteStride is out of range");
    const bool fits = count >= 1 && begin <= view_size && element_size <= view_size - begin &&
                      (count - 1) <= (view_size - begin - element_size) / stride;
    if (!fits) {
      reject(path_, where + ": its " + std::to_string(count) + " elements do not lie within its view of " +
                        std::to_string(view_size) + " bytes");
    }
    return {buffer, static_cast<std::size_t>(view_begin + begin), static_cast<std::size_t>(stride),
            static_cast<std::size_t>(count)};
  }

  void count(std::uint64_t& sum, std::uint64_t number, const std::string& where) const {
    sum += number;
    if (sum > kMostPointsAndCorners) {
      reject(path_, where + ": up to here there are more than " + std::to_string(kMostPointsAndCorners) +
                        " points and corners of triangles");
    }
  }

  void read_meshes() {
    output_["meshes"] = json::array();
    if (!document_.contains("meshes")) reject(path_, "The file has no meshes");
    const json& meshes = document_.at("meshes");
    for (std::size_t m = 0; m < meshes.size(); ++m) {
      const std::uint64_t read_before = read_;
      json primitives = json::array();
      const json& given = meshes.at(m).at("primitives");
      for (std::size_t p = 0; p < given.size(); ++p) {
        const std::string where = "meshes[" + std::to_string(m) + "].primitives[" + std::to_string(p) + "]";
        const std::uint64_t mode = natural_or(given.at(p), "mode", kTriangles, where);
        if (mode > kTriangleFan) reject(path_, where + ": the mode " + std::to_string(mode) + " is not known");
        if (mode >= kTriangles) primitives.push_back(read_primitive(given.at(p), mode, where));
      }
      // A mesh of lines and points only stays in its place, so that indices of meshes remain valid.
      mesh_sizes_.push_back(read_ - read_before);
      output_["meshes"].push_back({{"primitives", primitives}});
    }
  }

  json read_primitive(const json& primitive, std::uint64_t mode, const std::string& where) {
    const json& positions = primitive.at("attributes").at("POSITION");
    if (component(positions) != kFloat) reject(path_, where + ": POSITION must be of componentType 5126 (float)");
    const Elements points = elements(positions, "VEC3", 12);
    count(read_, points.count, where);
    std::string bytes;
    for (std::size_t i = 0; i < points.count; ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto value = number_at<float>(points.bytes, points.begin + i * points.stride + 4 * axis);
        check_coordinate(path_, where + ", position " + std::to_string(i), static_cast<double>(value));
        append_number(bytes, value);
      }
    }
    json result{{"mode", mode}, {"attributes", {{"POSITION", add_accessor(bytes, kFloat, "VEC3", points.count)}}}};
    std::size_t corners = points.count;
    if (primitive.contains("indices")) {
      std::string indices;
      corners = read_indices(primitive.at("indices"), points.count, where, indices);
      result["indices"] = add_accessor(indices, kInt, "SCALAR", corners);
    }
    if (corners < 3 || (mode == kTriangles && corners % 3 != 0)) {
      reject(path_, where + ": " + std::to_string(corners) + " corners do not make up triangles");
    }
    return result;
  }

  std::size_t read_indices(const json& index, std::size_t points, const std::string& where, std::string& bytes) {
    const std::uint64_t type = component(index);
    if (type != kByte && type != kShort && type != kInt) {
      reject(path_, where + ": indices must be of componentType 5121, 5123 or 5125");
    }
    const std::size_t size = type == kByte ? 1 : type == kShort ? 2 : 4;
    const Elements items = elements(index, "SCALAR", size);
    count(read_, items.count, where);
    for (std::size_t i = 0; i < items.count; ++i) {
      const std::size_t at = items.begin + i * items.stride;
      const std::uint32_t value = type == kByte    ? number_at<std::uint8_t>(items.bytes, at)
                                  : type == kShort ? number_at<std::uint16_t>(items.bytes, at)
                                                   : number_at<std::uint32_t>(items.bytes, at);
      if (value >= points) {
        reject(path_, where + ": index " + std::to_string(i) + " is " + std::to_string(value) + ", but there are " +
                          std::to_string(points) + " positions");
      }
      append_number(bytes, value);
    }
    return items.count;
  }

  std::size_t add_accessor(const std::string& bytes, std::uint64_t component, const char* type, std::size_t count) {
    output_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}});
    const std::size_t view = output_["bufferViews"].size() - 1;
    output_["accessors"].push_back(
        {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
    binary_ += bytes;
    return view;
  }

  void read_nodes() {
    std::vector<std::size_t> roots;
    if (document_.contains("scenes")) {
      const json& scene = entry("scenes", document_.contains("scene") ? document_.at("scene") : json(0U));
      if (scene.contains("nodes")) {
        for (const json& node : scene.at("nodes")) {
          roots.push_back(copied_node(node, 0));
        }
      }
    } else {
      reject(path_, "The file has no scenes");
    }
    output_["scenes"] = json::array({{{"nodes", roots}}});
    output_["scene"] = 0;
  }

  /// Copies a node and what hangs on it; gives its new index.
  std::size_t copied_node(const json& index, int depth) {
    const json& node = entry("nodes", index);
    const std::string where = "nodes[" + index.dump() + "]";
    if (depth > 200) reject(path_, where + ": the tree of nodes is more than 200 deep");
    if (!visited_.insert(index.get<std::size_t>()).second) reject(path_, where + ": the node is used twice");
    json copy = copied_placement(node, where);
    if (node.contains("mesh")) {
      entry("meshes", node.at("mesh"));
      const std::uint64_t size = mesh_sizes_.at(node.at("mesh").get<std::size_t>());
      if (size > 0) copy["mesh"] = node.at("mesh");
      count(placed_, size, where);
    }
    const std::size_t result = output_["nodes"].size();
    output_["nodes"].push_back(copy);
    if (node.contains("children")) {
      std::vector<std::size_t> children;
      for (const json& child : node.at("children")) {
        children.push_back(copied_node(child, depth + 1));
      }
      if (!children.empty()) output_["nodes"][result]["children"] = children;
    }
    return result;
  }

  /// The node's place in its parent.
  json copied_placement(const json& node, const std::string& where) const {
    json copy = json::object();
    for (const auto& [key, length] :
         {std::pair<const char*, std::size_t>{"matrix", 16}, {"translation", 3}, {"rotation", 4}, {"scale", 3}}) {
      if (!node.contains(key)) continue;
      if (copy.contains("matrix")) reject(path_, where + ": it has both a matrix and a " + key);
      copy[key] = numbers(node.at(key), length, where + "." + key);
    }
    if (copy.contains("matrix")) check_last_row(copy.at("matrix"), where + ".matrix");
    if (copy.contains("rotation")) copy["rotation"] = unit_quaternion(copy.at("rotation"), where + ".rotation");
    return copy;
  }

  /// `matrix` is given column by column.
  void check_last_row(const json& matrix, const std::string& where) const {
    const json row{matrix.at(3), matrix.at(7), matrix.at(11), matrix.at(15)};
    if (row != json{0.0, 0.0, 0.0, 1.0}) reject(path_, where + ": its last row is " + row.dump() + ", not 0, 0, 0, 1");
  }

  /// Rounding is forgiven, but a quaternion of another length would scale the mesh.
  std::vector<double> unit_quaternion(const json& given, const std::string& where) const {
    auto xyzw = given.get<std::vector<double>>();
    const double length = std::sqrt(std::inner_product(xyzw.begin(), xyzw.end(), xyzw.begin(), 0.0));
    if (std::abs(length - 1.0) > 1e-3) {
      reject(path_, where + ": the quaternion " + given.dump() + " has the length " + json(length).dump() + ", not 1");
    }
    for (double& number : xyzw) {
      number /= length;
    }
    return xyzw;
  }

  std::vector<double> numbers(const json& value, std::size_t length, const std::string& where) const {
    // The JSON library's own conversion takes truth values too.
    const bool are_numbers = std::all_of(value.begin(), value.end(), [](const json& v) { return v.is_number(); });
    if (!value.is_array() || !are_numbers || value.size() != length)
      reject(path_, where + " must have " + std::to_string(length) + " numbers");
    auto result = value.get<std::vector<double>>();
    for (const double number : result) {
      check_coordinate(path_, where, number);
    }
    return result;
  }

  std::string written() const {
    std::string text = output_.dump();
    text.append((4 - text.size() % 4) % 4, ' ');
    std::string result = "glTF";
    append_number(result, std::uint32_t{2});
    append_number(result, static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + binary_.size()));
    append_number(result, static_cast<std::uint32_t>(text.size()));
    result += "JSON" + text;
    append_number(result, static_cast<std::uint32_t>(binary_.size()));
    result += std::string("BIN\0", 4) + binary_;
    return result;
  }

  const std::filesystem::path& path_;
  const json& document_;
  std::vector<std::string> buffers_;
  json output_ = json::object();
  std::string binary_;
  std::uint64_t read_ = 0;                 // points and corners in the clean file
  std::uint64_t placed_ = 0;               // and after the nodes have placed them
  std::vector<std::uint64_t> mesh_sizes_;  // the same for each mesh; 0 where it has lines and points only
  std::set<std::size_t> visited_;
};

json parsed(const std::filesystem::path& path, std::string_view text) {
  const auto check_depth = [&](int depth, json::parse_event_t event, const json&) {
    const bool goes_deeper = event == json::parse_event_t::array_start || event == json::parse_event_t::object_start;
    if (goes_deeper && depth >= kDeepestNesting) {
      reject(path, "Its JSON is nested more than " + std::to_string(kDeepestNesting) + " deep");
    }
    return true;
  };
  try {
    return json::parse(text, check_depth);
  } catch (const json::parse_error& error) {
    reject(path, "This is not JSON, or truncated: byte " + std::to_string(error.byte) + " makes no sense");
  } catch (const json::out_of_range&) {
    reject(path, "A number in its JSON is beyond every double");
  }
}

/// Runs the reader; entries that are missing or of the wrong kind come as exceptions of the JSON library.
std::string cleaned(const std::filesystem::path& path, std::string_view text, std::string_view binary) {
  const json document = parsed(path, text);
  try {
    return GltfReader(path, document, gltf_buffers(path, document, binary)).clean();
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
  if (number_at<std::uint32_t>(bytes, 4) != 2) reject(path, "The version in the header is not 2");
  const std::uint32_t length = number_at<std::uint32_t>(bytes, 8);
  if (length != bytes.size()) {
    reject(path, "The file is truncated or too long: it has " + std::to_string(bytes.size()) +
                     " bytes, its header says " + std::to_string(length));
  }
  std::string_view text;
  std::string_view binary;
  for (std::size_t begin = 12; begin < bytes.size();) {
    if (bytes.size() - begin < 8) reject(path, "The chunk at byte " + std::to_string(begin) + " is truncated");
    const std::uint32_t size = number_at<std::uint32_t>(bytes, begin);
    const std::string_view kind = bytes.substr(begin + 4, 4);
    if (size > bytes.size() - begin - 8) reject(path, "The chunk at byte " + std::to_string(begin) + " is truncated");
    if (kind == "JSON" && text.empty()) text = bytes.substr(begin + 8, size);
    if (kind == std::string_view("BIN\0", 4) && binary.empty()) binary = bytes.substr(begin + 8, size);
    begin += 8 + size;
  }
  return {cleaned(path, text, binary)};
}

}  // namespace glissade::collision
