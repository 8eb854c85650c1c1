#pragma once

/// The triangles of a tree's leaf in world coordinates, with bounding boxes that reject most pairs of two leaves
/// quickly.

#include <array>
#include <cstdint>

#include <Eigen/Geometry>

#include "scene/contact_scene.h"

namespace glissade::contact {

/// Triangles without area are left out.
struct LeafInWorld {
  LeafInWorld(const PlacedBody& placed, std::uint32_t leaf) {
    for (const std::int32_t triangle : placed.body->tree.triangles_of_leaf(leaf)) {
      if (triangle < 0) continue;
      const auto i = static_cast<std::size_t>(count++);
      triangles[i] = triangle;
      points_W[i] = placed.triangle_W(triangle);
      for (const Eigen::Vector3d& x_W : points_W[i])
        bounds_W[i].extend(x_W);
    }
  }

  /// Whether triangle i of this leaf may be within `distance` (metres) of triangle j of another.
  bool may_be_near(int i, const LeafInWorld& other, int j, double distance) const {
    const auto& mine = bounds_W[static_cast<std::size_t>(i)];
    return mine.squaredExteriorDistance(other.bounds_W[static_cast<std::size_t>(j)]) <= distance * distance;
  }

  int count = 0;
  std::array<std::int32_t, collision::DopTree::kWidth> triangles{};  ///< numbers in the mesh
  std::array<geometry::TrianglePoints, collision::DopTree::kWidth> points_W;
  std::array<Eigen::AlignedBox3d, collision::DopTree::kWidth> bounds_W;
};

}  // namespace glissade::contact
