#include "io/gltf_meshes.h"

#include <numeric>
#include <span>
#include <utility>

#include "io/gltf_extensions.h"
#include "io/mesh_file.h"

namespace glissade::geometry {
namespace {

using nlohmann::json;

// The values of `mode` for triangles: a list, a strip, a fan. Those below are for points and lines.
constexpr std::uint64_t kTriangles = 4;
constexpr std::uint64_t kTriangleStrip = 5;
constexpr std::uint64_t kTriangleFan = 6;

constexpr WarningKind kPointsOrLines{"primitive of points or lines is left out",
                                     "primitives of points or lines are left out"};
constexpr WarningKind kWithoutPosition{"primitive without the attribute POSITION is left out",
                                       "primitives without the attribute POSITION are left out"};
constexpr WarningKind kWithoutCorners{"primitive without corners is left out",
                                      "primitives without corners are left out"};
constexpr WarningKind kWithoutNode{"mesh that no node of the scene has is left out",
                                   "meshes that no node of the scene has are left out"};
constexpr WarningKind kIntegers{"primitive has positions in integers without naming KHR_mesh_quantization",
                                "primitives have positions in integers without naming KHR_mesh_quantization"};

/// The triangles of a list, strip or fan.
std::vector<Triangle> triangles_of(std::span<const std::int32_t> corners, std::uint64_t mode) {
  std::vector<Triangle> triangles;
  if (mode == kTriangles) {
    for (std::size_t i = 0; i < corners.size(); i += 3) {
      triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
    }
    return triangles;
  }
  for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
    const std::size_t odd = mode == kTriangleStrip ? i % 2 : 0;  // every second triangle of a strip is turned round
    const std::size_t first = mode == kTriangleStrip ? i : 0;
    triangles.push_back({corners[first], corners[i + 1 + odd], corners[i + 2 - odd]});
  }
  return triangles;
}

}  // namespace

void check_has_values(const GltfDocument& document, const GltfAccessors& accessors, const json& accessor,
                      const json& primitive, const std::string& where) {
  if (accessors.has_values(accessor)) return;
  const std::string extensions = extensions_with_geometry(primitive);
  if (extensions.empty()) return;  // all zeros
  reject(document.path(), where + ": accessors[" + accessor.dump() + "] has no values, and the extension " +
                              extensions + ", which may have them, is not supported");
}

const std::vector<GltfPrimitive>& GltfMeshes::primitives(std::size_t index) {
  std::optional<std::vector<GltfPrimitive>>& mesh = meshes_.at(index);
  if (mesh) return *mesh;
  mesh.emplace();
  const std::string where = "meshes[" + std::to_string(index) + "]";
  const json& entry = document_.root().at("meshes").at(index);
  const json& given = entry.at("primitives");
  for (std::size_t p = 0; p < given.size(); ++p) {
    read(given.at(p), where + ".primitives[" + std::to_string(p) + "]", *mesh);
  }
  return *mesh;
}

void GltfMeshes::warn_of_unread() const {
  for (std::size_t mesh = 0; mesh < meshes_.size(); ++mesh) {
    if (meshes_[mesh]) continue;
    document_.warnings().add(kWithoutNode, "meshes[" + std::to_string(mesh) + "]");
  }
}

void GltfMeshes::read(const json& entry, const std::string& where, std::vector<GltfPrimitive>& primitives) {
  const std::uint64_t mode = document_.natural_or(entry, "mode", kTriangles, where);
  if (mode > kTriangleFan) {
    reject(document_.path(), where + ": the mode " + std::to_string(mode) + " is not known");
  }
  if (mode < kTriangles) {
    document_.warnings().add(kPointsOrLines, where);
    return;
  }
  const json& attributes = entry.at("attributes");
  if (!attributes.contains("POSITION")) {
    const std::string extensions = extensions_with_geometry(entry);
    if (!extensions.empty()) {
      reject(document_.path(), where + ": it has no POSITION, and the extension " + extensions +
                                   ", which may have its triangles, is not supported");
    }
    document_.warnings().add(kWithoutPosition, where);
    return;
  }
  GltfPrimitive primitive{entry, where, {}, {}};
  check_has_values(document_, accessors_, attributes.at("POSITION"), entry, where);
  primitive.positions = positions(attributes.at("POSITION"), where);
  const std::vector<std::int32_t> all = corners(entry, primitive.positions.size(), where);
  if (all.empty()) {
    document_.warnings().add(kWithoutCorners, where);
    return;
  }
  if (all.size() < 3 || (mode == kTriangles && all.size() % 3 != 0)) {
    reject(document_.path(), where + ": " + std::to_string(all.size()) + " corners do not make up triangles");
  }
  primitive.triangles = triangles_of(all, mode);
  primitives.push_back(std::move(primitive));
}

std::vector<Eigen::Vector3d> GltfMeshes::positions(const json& accessor, const std::string& where) {
  const std::uint64_t component = accessors_.component(accessor);
  if (component == kGltfUint32) {
    reject(document_.path(), where + ": POSITION must be of componentType 5126 (float) or 5120 to 5123");
  }
  if (component != kGltfFloat && !uses_extension(document_, kGltfQuantization)) {
    document_.warnings().add(kIntegers, where);
  }
  const std::vector<double> numbers = accessors_.numbers(accessor, "VEC3", GltfIntegers::kAsAccessorSays);
  std::vector<Eigen::Vector3d> result;
  result.reserve(numbers.size() / 3);
  for (std::size_t i = 0; i < numbers.size(); i += 3) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (is_coordinate(numbers[i + axis])) continue;
      reject_coordinate(document_.path(), where + ", position " + std::to_string(i / 3), numbers[i + axis]);
    }
    result.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
  }
  return result;
}

std::vector<std::int32_t> GltfMeshes::corners(const json& entry, std::size_t points, const std::string& where) {
  std::vector<std::int32_t> result;
  if (!entry.contains("indices")) {
    result.resize(points);
    std::iota(result.begin(), result.end(), 0);
    return result;
  }
  const json& accessor = entry.at("indices");
  check_has_values(document_, accessors_, accessor, entry, where);
  const std::uint64_t component = accessors_.component(accessor);
  if (component != kGltfUint8 && component != kGltfUint16 && component != kGltfUint32) {
    reject(document_.path(), where + ": indices must be of componentType 5121, 5123 or 5125");
  }
  const std::vector<double> indices = accessors_.numbers(accessor, "SCALAR", GltfIntegers::kPlain);
  result.reserve(indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const auto index = static_cast<std::uint32_t>(indices[i]);
    if (index >= points) {
      reject(document_.path(), where + ": index " + std::to_string(i) + " is " + std::to_string(index) +
                                   ", but there are " + std::to_string(points) + " positions");
    }
    result.push_back(static_cast<std::int32_t>(index));
  }
  return result;
}

}  // namespace glissade::geometry
