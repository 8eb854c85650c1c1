#include "model/glb.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <utility>

#include <glissade/base/byte_order.h>

namespace glissade::viewer {

namespace {

// Numbers of glTF.
constexpr int kByte = 5120;
constexpr int kUnsignedShort = 5123;
constexpr int kUnsignedInt = 5125;
constexpr int kVertices = 34962;
constexpr int kIndices = 34963;
constexpr int kLines = 1;

constexpr std::uint32_t kMagic = 0x46546C67;  // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;

void fill(std::string& bytes, char filler) {
  while (bytes.size() % 4 != 0)
    bytes.push_back(filler);
}

nlohmann::json array_of(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

}  // namespace

template <typename Value>
std::size_t GlbWriter::add_view(const std::vector<Value>& values, int target, std::size_t stride) {
  const std::size_t bytes = values.size() * sizeof(Value);
  nlohmann::json view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes}, {"target", target}};
  if (stride > 0) view["byteStride"] = stride;
  views_.push_back(std::move(view));
  binary_.append(reinterpret_cast<const char*>(values.data()), bytes);  // little endian, as all our machines
  fill(binary_, '\0');
  return views_.size() - 1;
}

std::size_t GlbWriter::add_positions(const std::vector<std::array<std::uint16_t, 4>>& positions) {
  std::array<std::uint16_t, 3> least{65535, 65535, 65535};
  std::array<std::uint16_t, 3> most{0, 0, 0};
  for (const auto& position : positions) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      least[axis] = std::min(least[axis], position[axis]);
      most[axis] = std::max(most[axis], position[axis]);
    }
  }
  accessors_.push_back({{"bufferView", add_view(positions, kVertices, 8)},
                        {"componentType", kUnsignedShort},
                        {"count", positions.size()},
                        {"type", "VEC3"},
                        {"min", least},
                        {"max", most}});
  return accessors_.size() - 1;
}

std::size_t GlbWriter::add_mesh(const DisplayMesh& mesh, const std::array<double, 4>& color_rgba) {
  grids_.push_back({mesh.lower, mesh.step});
  const std::size_t first = add_positions(mesh.positions);
  accessors_.push_back({{"bufferView", add_view(mesh.normals, kVertices, 4)},
                        {"componentType", kByte},
                        {"normalized", true},
                        {"count", mesh.normals.size()},
                        {"type", "VEC3"}});
  const bool is_small = mesh.positions.size() <= std::numeric_limits<std::uint16_t>::max();
  const std::vector<std::uint16_t> small =
      is_small ? std::vector<std::uint16_t>(mesh.indices.begin(), mesh.indices.end()) : std::vector<std::uint16_t>{};
  accessors_.push_back({{"bufferView", is_small ? add_view(small, kIndices, 0) : add_view(mesh.indices, kIndices, 0)},
                        {"componentType", is_small ? kUnsignedShort : kUnsignedInt},
                        {"count", mesh.indices.size()},
                        {"type", "SCALAR"}});
  materials_.push_back({{"doubleSided", true},
                        {"pbrMetallicRoughness",
                         {{"baseColorFactor", color_rgba}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.65}}}});
  nlohmann::json primitives = nlohmann::json::array();
  primitives.push_back({{"attributes", {{"POSITION", first}, {"NORMAL", first + 1}}},
                        {"indices", first + 2},
                        {"material", materials_.size() - 1}});
  if (!mesh.edges.empty())
    primitives.push_back({{"attributes", {{"POSITION", add_positions(mesh.edges)}}}, {"mode", kLines}});
  meshes_.push_back({{"primitives", std::move(primitives)}});
  return meshes_.size() - 1;
}

void GlbWriter::add_node(const std::string& name, const Eigen::Isometry3d& X, std::optional<std::size_t> mesh,
                         const nlohmann::json& extras) {
  const Eigen::Quaterniond q(X.linear());
  nlohmann::json node = {{"name", name},
                         {"translation", array_of(X.translation())},
                         {"rotation", {q.x(), q.y(), q.z(), q.w()}},
                         {"extras", extras}};
  if (mesh) {
    // From the grid of the mesh to metres.
    const Grid& grid = grids_[*mesh];
    nodes_.push_back(
        {{"mesh", *mesh}, {"translation", array_of(grid.lower)}, {"scale", {grid.step, grid.step, grid.step}}});
    node["children"] = {nodes_.size() - 1};
  }
  nodes_.push_back(std::move(node));
  roots_.push_back(nodes_.size() - 1);
}

std::string GlbWriter::finish(const nlohmann::json& scene_extras) const {
  nlohmann::json document = {{"asset", {{"version", "2.0"}, {"generator", "glissade"}}},
                             {"scene", 0},
                             {"scenes", {{{"nodes", roots_}, {"extras", scene_extras}}}},
                             {"nodes", nodes_}};
  if (!meshes_.empty()) {
    document["extensionsUsed"] = document["extensionsRequired"] = {"KHR_mesh_quantization"};
    document["meshes"] = meshes_;
    document["materials"] = materials_;
    document["accessors"] = accessors_;
    document["bufferViews"] = views_;
    document["buffers"] = {{{"byteLength", binary_.size()}}};
  }
  // A name of a file may be no UTF-8.
  std::string json = document.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  fill(json, ' ');
  const std::size_t size = 12 + 8 + json.size() + 8 + binary_.size();
  if (size > std::numeric_limits<std::uint32_t>::max())
    throw std::invalid_argument("the scene is too large for binary glTF, which ends at 4 GiB");
  const auto number = [](std::string& bytes, std::size_t value) {
    base::append_number(bytes, static_cast<std::uint32_t>(value));
  };
  std::string file;
  file.reserve(size);
  number(file, kMagic);
  number(file, 2);
  number(file, size);
  number(file, json.size());
  number(file, kJsonChunk);
  file += json;
  number(file, binary_.size());
  number(file, kBinaryChunk);
  return file + binary_;
}

}  // namespace glissade::viewer
