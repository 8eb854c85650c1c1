#include "io/gltf_skins.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>

#include "io/gltf_numbers.h"
#include "io/gltf_placement.h"
#include "io/mesh_file.h"

namespace glissade::geometry {
namespace {

using nlohmann::json;

constexpr WarningKind kBadWeights{
    "point has weights of joints that are negative or do not add up to 1; they are divided by their sum",
    "points have weights of joints that are negative or do not add up to 1; they are divided by their sum"};

}  // namespace

/// The attributes JOINTS_n and WEIGHTS_n of a primitive, for each n: four joints and weights for each point.
struct GltfSkins::Sets {
  std::vector<std::vector<double>> joints;
  std::vector<std::vector<double>> weights;
};

struct GltfSkins::Influence {
  double joint;
  double weight;
};

std::vector<Eigen::AffineCompact3d> GltfSkins::placements(const json& number, const GltfPrimitive& primitive) {
  Skin& skin = this->skin(number);
  const Sets sets = this->sets(primitive);
  std::vector<bool> is_used(primitive.positions.size());
  for (const Triangle& triangle : primitive.triangles) {
    for (const std::int32_t corner : triangle)
      is_used[static_cast<std::size_t>(corner)] = true;
  }
  std::vector<Eigen::AffineCompact3d> result(primitive.positions.size(), Eigen::AffineCompact3d::Identity());
  std::vector<Influence> influences;
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (!is_used[i]) continue;
    influences.clear();
    for (std::size_t set = 0; set < sets.joints.size(); ++set) {
      for (std::size_t k = 4 * i; k < 4 * i + 4; ++k) {
        if (sets.weights[set][k] != 0) influences.push_back({sets.joints[set][k], sets.weights[set][k]});
      }
    }
    result[i] = blended(skin, influences, primitive.where + ", point " + std::to_string(i));
  }
  return result;
}

GltfSkins::Skin& GltfSkins::skin(const json& number) {
  const json& entry = document_.entry("skins", number);
  const auto [found, is_new] = skins_.try_emplace(document_.index("skins", number));
  Skin& skin = found->second;
  if (!is_new) return skin;
  skin.where = "skins[" + number.dump() + "]";
  for (const json& joint : entry.at("joints")) {
    skin.joints.push_back(document_.index("nodes", joint));
  }
  skin.X_SceneMeshes.resize(skin.joints.size());
  if (!entry.contains("inverseBindMatrices")) return skin;
  const json& accessor = entry.at("inverseBindMatrices");
  if (accessors_.component(accessor) != kGltfFloat) {
    reject(document_.path(), skin.where + ": inverseBindMatrices must be of componentType 5126 (float)");
  }
  skin.inverse_bind = accessors_.numbers(accessor, "MAT4", GltfIntegers::kPlain);
  if (skin.inverse_bind.size() < 16 * skin.joints.size()) {
    reject(document_.path(), skin.where + ": it has " + std::to_string(skin.joints.size()) + " joints, but only " +
                                 std::to_string(skin.inverse_bind.size() / 16) + " inverse bind matrices");
  }
  return skin;
}

GltfSkins::Sets GltfSkins::sets(const GltfPrimitive& primitive) {
  constexpr std::string_view kJoints = "JOINTS_";
  constexpr std::string_view kWeights = "WEIGHTS_";
  const json& attributes = primitive.entry.at("attributes");
  const std::uint64_t points = primitive.positions.size();
  Sets result;
  std::size_t weights = 0;
  for (const auto& [name, accessor] : attributes.items()) {
    if (name.starts_with(kWeights)) ++weights;
    if (!name.starts_with(kJoints)) continue;
    const std::string name_of_weights = std::string(kWeights) + name.substr(kJoints.size());
    if (!attributes.contains(name_of_weights)) {
      reject(document_.path(), primitive.where + ": it has " + name + ", but no " + name_of_weights);
    }
    const json& accessor_of_weights = attributes.at(name_of_weights);
    check_has_values(document_, accessors_, accessor, primitive.entry, primitive.where);
    check_has_values(document_, accessors_, accessor_of_weights, primitive.entry, primitive.where);
    result.joints.push_back(accessors_.numbers(accessor, "VEC4", GltfIntegers::kPlain, points));
    result.weights.push_back(accessors_.numbers(accessor_of_weights, "VEC4", GltfIntegers::kFractions, points));
  }
  if (result.joints.empty() || result.joints.size() != weights) {
    reject(document_.path(), primitive.where +
                                 ": a mesh with a skin needs JOINTS_n and WEIGHTS_n in pairs, but it has " +
                                 std::to_string(result.joints.size()) + " and " + std::to_string(weights) + " of them");
  }
  return result;
}

const Eigen::Affine3d& GltfSkins::by_joint(Skin& skin, std::size_t joint) {
  std::optional<Eigen::Affine3d>& X_SceneMesh = skin.X_SceneMeshes[joint];
  if (X_SceneMesh) return *X_SceneMesh;
  X_SceneMesh = nodes_.pose(skin.joints[joint]);
  if (!skin.inverse_bind.empty()) {
    const std::span<const double> numbers = std::span(skin.inverse_bind).subspan(16 * joint, 16);
    *X_SceneMesh =
        *X_SceneMesh * affine(document_.path(), numbers, skin.where + ", inverse bind matrix " + std::to_string(joint));
  }
  return *X_SceneMesh;
}

Eigen::AffineCompact3d GltfSkins::blended(Skin& skin, std::vector<Influence>& influences, const std::string& where) {
  for (const auto& [joint, weight] : influences) {
    if (!(joint >= 0 && joint < static_cast<double>(skin.joints.size())) || joint != std::floor(joint)) {
      reject(document_.path(), where + ": " + skin.where + " has no joint " + json(joint).dump() + ", its joints are " +
                                   std::to_string(skin.joints.size()));
    }
    if (!std::isfinite(weight)) reject(document_.path(), where + ": a weight of its joints is not finite");
  }
  // Points at one position may name their joints in another order; their sums must be the same to the bit.
  std::sort(influences.begin(), influences.end(), [](const Influence& a, const Influence& b) {
    return std::pair(a.joint, a.weight) < std::pair(b.joint, b.weight);
  });
  double sum = 0;
  bool has_negative = false;
  for (const Influence& influence : influences) {
    sum += influence.weight;
    has_negative = has_negative || influence.weight < 0;
  }
  if (!(sum > 0 && std::isfinite(sum))) {
    reject(document_.path(),
           where + ": the weights of its joints add up to " + json(sum).dump() + ", so its place is not known");
  }
  constexpr double kRounding = 0.01;  // of four weights of 8 bits
  if (has_negative || std::abs(sum - 1) > kRounding) {
    document_.warnings().add(kBadWeights, where);
  }
  Eigen::AffineCompact3d result;
  result.matrix().setZero();
  for (const Influence& influence : influences) {
    const Eigen::Affine3d& X_SceneMesh = by_joint(skin, static_cast<std::size_t>(influence.joint));
    result.matrix() += influence.weight / sum * X_SceneMesh.affine();
  }
  return result;
}

}  // namespace glissade::geometry
