#include <nlohmann/json.hpp>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/triangle_mesh.h>

#include "gltf_writer.h"
#include "mesh_files.h"
#include "mesh_seeds.h"

namespace glissade::fuzz {
namespace {

using geometry::bytes_of;
using geometry::TriangleMesh;
using nlohmann::json;

/// A document that grows mesh by mesh.
class Document : public geometry::GltfWriter {
 public:
  Document() {
    root["asset"]["generator"] = "Tür";
    root["extensionsRequired"] = {"KHR_materials_unlit"};
    root["scenes"] = {{{"nodes", {0}}}};
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
    root["extensionsRequired"].push_back("KHR_mesh_quantization");
    std::string bytes;
    for (const Eigen::Vector3d& p : mesh.vertices) {
      for (const double coordinate : p) {
        bytes += bytes_of<std::int16_t>({static_cast<std::int16_t>(1000 * coordinate)});
      }
      bytes += std::string(2, '\x7f');
    }
    return add_accessor(bytes, 5122, "VEC3", mesh.vertices.size(), 8);
  }
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

/// A plate of which a sparse target lifts a corner, bent by two joints, and copies of a box.
Document deformed() {
  const geometry::TriangleMesh plate = geometry::make_plate({1.0, 2.0}, 8);
  const std::size_t points = plate.vertices.size();
  Document document;
  const std::size_t target = document.add_zeros(5126, "VEC3", points);
  document.root["accessors"][target]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", document.add_view(bytes_of<std::uint8_t>({0}))}, {"componentType", 5121}}},
      {"values", {{"bufferView", document.add_view(bytes_of<float>({0, 0, 1}))}}}};
  std::string joints;
  std::string weights;
  for (std::size_t i = 0; i < points; ++i) {
    joints += bytes_of<std::uint8_t>({0, 1, 0, 0});
    weights += bytes_of<std::uint8_t>({51, 204, 0, 0});
  }
  const std::size_t bind = document.add_accessor(bytes_of<float>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -5, 1,
                                                                  1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0,  1}),
                                                 5126, "MAT4", 2);
  document.add_mesh({{{"attributes",
                       {{"POSITION", document.add_positions(plate, false)},
                        {"JOINTS_0", document.add_accessor(joints, 5121, "VEC4", points)},
                        {"WEIGHTS_0", document.add_accessor(weights, 5121, "VEC4", points)}}},
                      {"indices", document.add_indices<std::uint16_t>(plate, 5123)},
                      {"targets", {{{"POSITION", target}}}}}});
  document.root["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", bind}, {"skeleton", 1}}};
  const geometry::TriangleMesh box = geometry::make_box({0.1, 0.2, 0.3}, 12);
  document.add_mesh({{{"attributes", {{"POSITION", document.add_positions(box, false)}}},
                      {"indices", document.add_indices<std::uint8_t>(box, 5121)}}});
  const json copies{
      {"TRANSLATION", document.add_accessor(bytes_of<float>({0, 0, 3, 0, 0, 4}), 5126, "VEC3", 2)},
      {"ROTATION", document.add_accessor(bytes_of<std::int16_t>({0, 0, 0, 32767, 32767, 0, 0, 0}), 5122, "VEC4", 2)},
      {"SCALE", document.add_accessor(bytes_of<float>({1, 1, 1, 1, 1, -1}), 5126, "VEC3", 2)}};
  document.add_node({{"mesh", 0}, {"skin", 0}, {"weights", {0.5}}, {"children", {1, 3}}, {"scale", {2, 2, 2}}});
  document.add_node({{"children", {2}}, {"translation", {0, 0, 5}}});
  document.add_node({{"rotation", {0, 0, 0.6, 0.8}}});
  document.add_node({{"mesh", 1}, {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", copies}}}}}});
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
            {"quantized.glb", quantized().glb()},
            {"deformed.glb", deformed().glb()}};
  }
  return {{"tetrahedron.gltf", geometry::gltf(R"({"byteLength":72,"uri":"%64ata.bin"})")},
          {"assembly.gltf", assembly().gltf()},
          {"strips.gltf", strips().gltf()},
          {"quantized.gltf", quantized().gltf()},
          {"deformed.gltf", deformed().gltf()}};
}

}  // namespace glissade::fuzz
