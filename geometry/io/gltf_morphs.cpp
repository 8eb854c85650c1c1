#include "io/gltf_morphs.h"

#include "io/gltf_numbers.h"
#include "io/mesh_file.h"

namespace glissade::geometry {
namespace {

using nlohmann::json;

constexpr WarningKind kOtherNumber{
    "primitive has more or fewer weights than morph targets; weights that are missing count as 0",
    "primitives have more or fewer weights than morph targets; weights that are missing count as 0"};

}  // namespace

std::vector<double> morph_weights(const GltfDocument& document, std::size_t node, std::size_t mesh) {
  const json& node_entry = document.root().at("nodes").at(node);
  if (node_entry.contains("weights")) {
    return number_array(document.path(), node_entry.at("weights"), "nodes[" + std::to_string(node) + "].weights");
  }
  const json& mesh_entry = document.root().at("meshes").at(mesh);
  if (!mesh_entry.contains("weights")) return {};
  return number_array(document.path(), mesh_entry.at("weights"), "meshes[" + std::to_string(mesh) + "].weights");
}

std::vector<Eigen::Vector3d> morphed_positions(GltfDocument& document, GltfAccessors& accessors,
                                               const GltfPrimitive& primitive, const std::vector<double>& weights) {
  std::vector<Eigen::Vector3d> result = primitive.positions;
  if (weights.empty() || !primitive.entry.contains("targets")) return result;
  const json& targets = primitive.entry.at("targets");
  if (targets.size() != weights.size()) {
    document.warnings().add(kOtherNumber, primitive.where + " with " + std::to_string(weights.size()) +
                                              " weights for " + std::to_string(targets.size()) + " targets");
  }
  for (std::size_t t = 0; t < targets.size() && t < weights.size(); ++t) {
    if (weights[t] == 0 || !targets.at(t).contains("POSITION")) continue;
    const json& accessor = targets.at(t).at("POSITION");
    const std::vector<double> shifts =
        accessors.numbers(accessor, "VEC3", GltfIntegers::kAsAccessorSays, result.size());
    for (std::size_t i = 0; i < result.size(); ++i) {
      result[i] += weights[t] * Eigen::Vector3d(shifts[3 * i], shifts[3 * i + 1], shifts[3 * i + 2]);
    }
  }
  return result;
}

}  // namespace glissade::geometry
