#include "io/gltf_instances.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include <nlohmann/json.hpp>

#include "io/gltf_extensions.h"
#include "io/gltf_placement.h"
#include "io/mesh_file.h"

namespace glissade::geometry {
namespace {

using nlohmann::json;

/// The numbers of an attribute of each copy.
struct InstanceAttribute {
  std::string where;
  std::vector<double> numbers;
  double rounding = 0;  // of quaternions

  bool is_given() const { return !numbers.empty(); }
};

/// The attribute `name` of all copies; `count`, their number, is set by the first one.
InstanceAttribute attribute(GltfAccessors& accessors, const json& attributes, const char* name, const char* type,
                            std::optional<std::uint64_t>& count) {
  if (!attributes.contains(name)) return {};
  const json& accessor = attributes.at(name);
  if (!count) count = accessors.count(accessor);
  const bool is_rotation = std::string(name) == "ROTATION";
  const GltfIntegers integers = is_rotation ? GltfIntegers::kFractions : GltfIntegers::kAsAccessorSays;
  const bool is_coarse = accessors.component(accessor) == kGltfInt8;
  return {"accessors[" + accessor.dump() + "], element ", accessors.numbers(accessor, type, integers, count),
          is_coarse ? 0.02 : 1e-3};
}

Eigen::Vector3d vector_at(const GltfDocument& document, const InstanceAttribute& attribute, std::size_t i) {
  const std::span<const double> numbers = std::span(attribute.numbers).subspan(3 * i, 3);
  for (const double number : numbers) {
    if (!is_coordinate(number)) reject_coordinate(document.path(), attribute.where + std::to_string(i), number);
  }
  return {numbers[0], numbers[1], numbers[2]};
}

}  // namespace

std::vector<Eigen::Affine3d> instances(const GltfDocument& document, GltfAccessors& accessors, std::size_t node) {
  const json& entry = document.root().at("nodes").at(node);
  if (!entry.contains("extensions") || !entry.at("extensions").contains(kGltfInstancing)) {
    return {Eigen::Affine3d::Identity()};
  }
  const json& extension = entry.at("extensions").at(kGltfInstancing);
  const json attributes = extension.contains("attributes") ? extension.at("attributes") : json::object();
  std::optional<std::uint64_t> count;
  const InstanceAttribute translations = attribute(accessors, attributes, "TRANSLATION", "VEC3", count);
  const InstanceAttribute rotations = attribute(accessors, attributes, "ROTATION", "VEC4", count);
  const InstanceAttribute scales = attribute(accessors, attributes, "SCALE", "VEC3", count);
  if (!count) return {Eigen::Affine3d::Identity()};  // all copies are at one place
  std::vector<Eigen::Affine3d> result(*count, Eigen::Affine3d::Identity());
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (translations.is_given()) result[i].translate(vector_at(document, translations, i));
    if (rotations.is_given()) {
      result[i].rotate(unit_quaternion(document.path(), std::span(rotations.numbers).subspan(4 * i, 4),
                                       rotations.rounding, rotations.where + std::to_string(i)));
    }
    if (scales.is_given()) result[i].scale(vector_at(document, scales, i));
  }
  return result;
}

}  // namespace glissade::geometry
