#include <nlohmann/json.hpp>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/triangle_mesh.h>

#include "mesh_files.h"
#include "mesh_seeds.h"

namespace glissade::fuzz {
namespace {

using geometry::bytes_of;
using geometry::TriangleMesh;
using nlohmann::json;

std::string base64(const std::string& bytes) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      bits = bits << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (unsigned k = 0; k < 4; ++k) {
      text += i + k <= bytes.size() ? digits[(bits >> (18 - 6 * k)) & 63U] : '=';
    }
  }
  return text;
}

/// A document that grows mesh by mesh.
class Document {
 public:
  Document() {
    json_["asset"] = {{"version", "2.0"}, {"generator", "Tür"}};
    json_["extensionsRequired"] = {"KHR_materials_unlit"};
    json_["scenes"] = {{{"nodes", {0}}}};
    json_["nodes"] = json::array();
  }

  /// Adds the accessor of `bytes`, which are `count` elements; `stride` is 0 where they follow each other closely.
  std::size_t add_accessor(const std::string& bytes, int component, const char* type, std::size_t count, int stride) {
    json view{{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}};
    if (stride > 0) view["byteStride"] = stride;
    json_["bufferViews"].push_back(view);
    json_["accessors"].push_back({{"bufferView", json_["bufferViews"].size() - 1},
                                  {"componentType", component},
                                  {"count", count},
                                  {"type", type}});
    binary_ += bytes + std::string((4 - bytes.size() % 4) % 4, '\0');
    return json_["accessors"].size() - 1;
  }

  std::size_t add_positions(const geometry::TriangleMesh& mesh, bool with_gaps) {
    std::string bytes;
    for (const Eigen::Vector3d& p : mesh.vertices) {
      for (const double coordinate : p) {
        bytes += bytes_of<float>({static_cast<float>(coordinate)});
      }
      if (with_gaps) bytes += std::string(4, '\x7f');
    }
    return add_accessor(bytes, 5126, "VEC3", mesh.vertices.size(), with_gaps ? 16 : 0);
  }

  template <class Index>
  std::size_t add_indices(const geometry::TriangleMesh& mesh, int component) {
    std::string bytes;
    for (const geometry::Triangle& triangle : mesh.triangles) {
      for (const std::int32_t corner : triangle) {
        bytes += bytes_of<Index>({static_cast<Index>(corner)});
      }
    }
    return add_accessor(bytes, component, "SCALAR", 3 * mesh.triangles.size(), 0);
  }

  /// Positions in thousandths, as 16-bit integers with a gap.
  std::size_t add_quantized_positions(const geometry::TriangleMesh& mesh) {
    json_["extensionsRequired"].push_back("KHR_mesh_quantization");
    std::string bytes;
    for (const Eigen::Vector3d& p : mesh.vertices) {
      for (const double coordinate : p) {
        bytes += bytes_of<std::int16_t>({static_cast<std::int16_t>(1000 * coordinate)});
      }
      bytes += std::string(2, '\x7f');
    }
    return add_accessor(bytes, 5122, "VEC3", mesh.vertices.size(), 8);
  }

  void add_mesh(const json& primitives) { json_["meshes"].push_back({{"name", "扉"}, {"primitives", primitives}}); }
  void add_node(const json& node) { json_["nodes"].push_back(node); }

  std::string gltf() const { return with_buffer("data:application/octet-stream;base64," + base64(binary_)).dump(); }
  std::string glb() const { return geometry::glb(with_buffer("").dump(), binary_); }

 private:
  json with_buffer(const std::string& uri) const {
    json result = json_;
    result["buffers"] = {{{"byteLength", binary_.size()}}};
    if (!uri.empty()) result["buffers"][0]["uri"] = uri;
    return result;
  }

  json json_;
  std::string binary_;
};

/// Two meshes with indices of different sizes, placed three times by matrices, turns and scales.
Document assembly() {
  const geometry::TriangleMesh box = geometry::make_box({0.1, 0.2, 0.3}, 12);
  const geometry::TriangleMesh sphere = geometry::make_sphere(0.5, 30);
  Document document;
  const std::size_t corners = document.add_positions(box, false);
  document.add_mesh(
      {{{"attributes", {{"POSITION", corners}}}, {"indices", document.add_indices<std::uint8_t>(box, 5121)}},
       {{"attributes", {{"POSITION", corners}}}, {"mode", 1}}});
  const std::size_t points = document.add_positions(sphere, true);
  document.add_mesh(
      {{{"attributes", {{"POSITION", points}}}, {"indices", document.add_indices<std::uint32_t>(sphere, 5125)}}});
  document.add_node({{"children", {1, 2}}, {"name", "Tür"}, {"scale", {1, 2, -3}}});
  document.add_node({{"mesh", 0}, {"children", {3}}, {"rotation", {0, 0, 0.6, 0.8}}, {"translation", {1, 2, 3}}});
  document.add_node({{"mesh", 1}, {"matrix", {0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 5, 0, 0, 1}}});
  document.add_node({{"mesh", 0}});
  return document;
}

/// A strip, a fan and plain triangles, with and without indices.
Document strips() {
  const geometry::TriangleMesh plate = geometry::make_plate({1.0, 2.0}, 8);
  Document document;
  const json attributes{{"POSITION", document.add_positions(plate, false)}};
  const std::size_t indices = document.add_indices<std::uint16_t>(plate, 5123);
  document.add_mesh({{{"attributes", attributes}, {"indices", indices}, {"mode", 5}},
                     {{"attributes", attributes}, {"indices", indices}, {"mode", 6}},
                     {{"attributes", attributes}, {"indices", indices}, {"mode", 4}},
                     {{"attributes", attributes}, {"mode", 5}},
                     {{"attributes", attributes}, {"mode", 6}}});
  document.add_node({{"mesh", 0}});
  return document;
}

/// A sphere on an integer grid, scaled by its node.
Document quantized() {
  const geometry::TriangleMesh sphere = geometry::make_sphere(0.5, 60);
  Document document;
  const json attributes{{"POSITION", document.add_quantized_positions(sphere)}};
  document.add_mesh({{{"attributes", attributes}, {"indices", document.add_indices<std::uint16_t>(sphere, 5123)}}});
  document.add_node({{"mesh", 0}, {"scale", {0.001, 0.001, 0.001}}});
  return document;
}

}  // namespace

std::string mesh_buffer() {
  return geometry::gltf_binary();
}

std::vector<Seed> gltf_seeds(bool is_glb) {
  if (is_glb) {
    return {{"tetrahedron.glb", geometry::tetrahedron_glb()},
            {"assembly.glb", assembly().glb()},
            {"strips.glb", strips().glb()},
            {"quantized.glb", quantized().glb()}};
  }
  return {{"tetrahedron.gltf", geometry::gltf(R"({"byteLength":72,"uri":"%64ata.bin"})")},
          {"assembly.gltf", assembly().gltf()},
          {"strips.gltf", strips().gltf()},
          {"quantized.gltf", quantized().gltf()}};
}

}  // namespace glissade::fuzz
