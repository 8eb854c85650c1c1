#include "io/gltf_nodes.h"

#include <cstdint>

#include "io/gltf_placement.h"
#include "io/mesh_file.h"

namespace glissade::geometry {
namespace {

using nlohmann::json;

constexpr WarningKind kOtherScenes{"scene besides the default one is left out",
                                   "scenes besides the default one are left out"};

std::string name_of_node(std::size_t node) {
  return "nodes[" + std::to_string(node) + "]";
}

}  // namespace

GltfNodes::GltfNodes(GltfDocument& document)
    : document_(document), parents_(document.size("nodes")), poses_(parents_.size()) {
  for (std::size_t node = 0; node < parents_.size(); ++node) {
    const json& entry = document_.root().at("nodes").at(node);
    if (!entry.contains("children")) continue;
    for (const json& number : entry.at("children")) {
      std::optional<std::size_t>& parent = parents_[document_.index("nodes", number)];
      if (parent) {
        reject(document_.path(), "nodes[" + number.dump() + "]: the node is used twice, as a child of " +
                                     name_of_node(*parent) + " and of " + name_of_node(node));
      }
      parent = node;
    }
  }
}

std::vector<std::size_t> GltfNodes::roots() const {
  std::vector<std::size_t> result;
  if (document_.size("scenes") == 0) {
    for (std::size_t node = 0; node < parents_.size(); ++node) {
      if (!parents_[node]) result.push_back(node);
    }
    return result;
  }
  const std::size_t scene =
      document_.root().contains("scene") ? document_.index("scenes", document_.root().at("scene")) : 0;
  const std::size_t others = document_.size("scenes") - 1;
  if (others > 0) {
    document_.warnings().add(kOtherScenes, "scenes[" + std::to_string(scene == 0 ? 1 : 0) + "]",
                             static_cast<std::int64_t>(others));
  }
  const json& entry = document_.root().at("scenes").at(scene);
  if (!entry.contains("nodes")) return result;
  std::vector<bool> is_root(parents_.size());
  for (const json& number : entry.at("nodes")) {
    const std::size_t node = document_.index("nodes", number);
    if (is_root[node]) reject(document_.path(), name_of_node(node) + ": the node is used twice in the scene");
    if (parents_[node]) {
      reject(document_.path(), name_of_node(node) +
                                   ": the node is used twice, as a root of the scene and as a child of " +
                                   name_of_node(*parents_[node]));
    }
    is_root[node] = true;
    result.push_back(node);
  }
  return result;
}

std::vector<std::size_t> GltfNodes::of_scene() const {
  const std::vector<std::size_t> first = roots();
  std::vector<std::size_t> result;
  std::vector<std::size_t> waiting(first.rbegin(), first.rend());
  while (!waiting.empty()) {  // ends, because no root has a parent and no other node has two
    const std::size_t node = waiting.back();
    waiting.pop_back();
    result.push_back(node);
    const json& entry = document_.root().at("nodes").at(node);
    if (!entry.contains("children")) continue;
    const json& children = entry.at("children");
    for (auto number = children.rbegin(); number != children.rend(); ++number) {
      waiting.push_back(document_.index("nodes", *number));
    }
  }
  return result;
}

const Eigen::Affine3d& GltfNodes::pose(std::size_t node) {
  std::vector<std::size_t> path;  // from the node up to the first one whose pose is known
  std::optional<std::size_t> ancestor = node;
  for (; ancestor && !poses_.at(*ancestor); ancestor = parents_[*ancestor]) {
    path.push_back(*ancestor);
    if (path.size() > parents_.size()) reject(document_.path(), name_of_node(node) + ": it is above itself");
  }
  Eigen::Affine3d X_SceneParent = ancestor ? *poses_[*ancestor] : Eigen::Affine3d::Identity();
  for (; !path.empty(); path.pop_back()) {
    const json& entry = document_.root().at("nodes").at(path.back());
    X_SceneParent = X_SceneParent * placement(document_.path(), entry, name_of_node(path.back()));
    poses_[path.back()] = X_SceneParent;
  }
  return *poses_[node];
}

}  // namespace glissade::geometry
