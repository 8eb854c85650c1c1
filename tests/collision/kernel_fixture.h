#pragma once

/// What the tests of the vector code share: trees of scattered triangles at many scales, for every instruction set.

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <glissade/collision/dop_tree.h>
#include <glissade/geometry/triangle_pair.h>

#include "kernels/instruction_set.h"
#include "random_numbers.h"

namespace glissade::collision {

inline constexpr unsigned kKernelSeed = 20;

// Two trees at random poses of many scales, for every instruction set.
class Kernels : public ::testing::TestWithParam<InstructionSet> {
 protected:
  Kernels() {
    use_instruction_set(GetParam());
    ::testing::Test::RecordProperty("seed", static_cast<int>(kKernelSeed));
  }
  ~Kernels() override { use_instruction_set(available_instruction_sets().front()); }

  Eigen::Vector3d random_vector() { return random_.point(1.0); }

  // Of B, whose middle lies at random within the cube of this half edge (metres) about the middle of A.
  Eigen::Isometry3d random_pose(const DopTree& tree_A, const DopTree& tree_B, double half_edge) {
    Eigen::Isometry3d X_AB = Eigen::Isometry3d::Identity();
    X_AB.linear() = random_.rotation();
    X_AB.translation() = half_edge * random_vector() + tree_A.center() - X_AB.linear() * tree_B.center();
    return X_AB;
  }

  // Small thin triangles scattered over a sphere of radius 1, some large ones among them.
  geometry::TriangleMesh soup(int triangles) {
    geometry::TriangleMesh mesh;
    for (std::int32_t t = 0; t < triangles; ++t) {
      const Eigen::Vector3d middle = random_vector().normalized();
      const double size = t % 10 == 0 ? 1.0 : 0.1;
      for (std::int32_t c = 0; c < 3; ++c) {
        mesh.vertices.push_back(middle + size * random_vector());
      }
      mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    return mesh;
  }

  DopTree tree(const geometry::TriangleMesh& mesh, double scale, const Eigen::Vector3d& offset,
               const DopTreeOptions& options = {}) {
    geometry::TriangleMesh placed = mesh;
    for (Eigen::Vector3d& vertex : placed.vertices)
      vertex = scale * vertex + offset;
    return DopTree(std::make_shared<const geometry::TriangleMesh>(std::move(placed)), options);
  }

  test_support::RandomNumbers random_{kKernelSeed};
};

/// Of the triangles of one list and the other.
inline double least_distance(const DopTree& tree_A, const std::vector<std::int32_t>& triangles_A, const DopTree& tree_B,
                             const std::vector<std::int32_t>& triangles_B, const Eigen::Isometry3d& X_AB) {
  double least = std::numeric_limits<double>::infinity();
  for (const std::int32_t a : triangles_A) {
    for (const std::int32_t b : triangles_B) {
      const auto corner_A = [&](int c) { return tree_A.mesh().corner(a, c); };
      const auto corner_B = [&](int c) { return X_AB * tree_B.mesh().corner(b, c); };
      least = std::min(least, geometry::triangle_distance({corner_A(0), corner_A(1), corner_A(2)},
                                                          {corner_B(0), corner_B(1), corner_B(2)})
                                  .distance);
    }
  }
  return least;
}

/// Two trees: what they are multiplied by, and how far apart they lie.
struct Setting {
  double scale_A;
  double scale_B;
  double offset;       ///< of the mesh of A from its own origin, in its radii
  double translation;  ///< of B from the middle of A, in radii of A
};

inline constexpr Setting kSettings[] = {{1, 1, 0, 0.5},     {1, 1, 0, 1.9},  {1e-6, 1e-6, 0, 1},
                                        {1e3, 1e3, 0, 1.5}, {1, 1e-3, 0, 1}, {1e-3, 1, 0, 1},
                                        {1, 0.3, 1e6, 1},   {1, 1e-6, 0, 1}, {1e-6, 1e-9, 10, 1}};

}  // namespace glissade::collision
