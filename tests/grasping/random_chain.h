#pragma once

/// Chains at random, and values for any chain.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <glissade/grasping/kinematic_chain.h>

#include "poses.h"
#include "random_numbers.h"

namespace glissade::test_support {

/// A tree of `links` links and `values` flex values; each joint depends on up to two values, or on none.
inline grasping::KinematicChain random_chain(RandomNumbers& random, int links, int values) {
  std::vector<grasping::FlexValue> flex;
  for (int i = 0; i < values; ++i)
    flex.push_back({.name = "value_" + std::to_string(i), .lower = -2.0, .upper = 2.0});
  std::vector<grasping::ChainLink> tree{{.name = "root"}};
  for (int i = 1; i < links; ++i) {
    grasping::ChainLink link{.name = "link_" + std::to_string(i)};
    link.parent = static_cast<std::size_t>(random.integer(0, i - 1));
    link.X_PJ.linear() = random.rotation();
    link.X_PJ.translation() = random.point(0.1);
    link.axis_J = random.direction();
    link.offset = random.uniform(-1.0, 1.0);
    for (int term = random.integer(0, 2); term > 0; --term) {
      const auto value = static_cast<std::size_t>(random.integer(0, values - 1));
      link.terms.push_back({.value = value, .factor = random.uniform(-1.5, 1.5)});
    }
    geometry::TriangleMesh mesh;
    for (int vertex = 0; vertex < 5; ++vertex)
      mesh.vertices.push_back(random.point(0.05));
    link.mesh = std::make_shared<const geometry::TriangleMesh>(std::move(mesh));
    tree.push_back(std::move(link));
  }
  return {std::move(flex), std::move(tree)};
}

/// Within the limits.
inline std::vector<double> random_values(RandomNumbers& random, const grasping::KinematicChain& chain) {
  std::vector<double> values;
  for (const grasping::FlexValue& value : chain.values())
    values.push_back(random.uniform(value.lower, value.upper));
  return values;
}

/// The poses of all links.
inline std::vector<Eigen::Isometry3d> poses_of(const grasping::KinematicChain& chain, const std::vector<double>& values,
                                               const Eigen::Isometry3d& X_WR = Eigen::Isometry3d::Identity()) {
  std::vector<Eigen::Isometry3d> X_WL(chain.links().size());
  chain.poses(X_WR, values, X_WL);
  return X_WL;
}

}  // namespace glissade::test_support
