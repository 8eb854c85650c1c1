#pragma once

/// Answers of a tree against those without one.

#include <cstdint>
#include <random>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <glissade/collision/dop_query.h>
#include <glissade/reference/brute_force.h>

namespace glissade::collision {

/// Poses, the same in every run: in turns, a corner of B comes to lie on a corner of A, or B anywhere about A.
class PosesOfContact {
 public:
  Eigen::Isometry3d next(const DopTree& tree_A, const DopTree& tree_B) {
    on_corner_ = !on_corner_;
    Eigen::Isometry3d X_AB = Eigen::Isometry3d::Identity();
    X_AB.linear() = Eigen::Quaterniond(uniform(), uniform(), uniform(), uniform()).normalized().toRotationMatrix();
    if (on_corner_) {
      X_AB.translation() = corner_of(tree_A.mesh()) - X_AB.linear() * corner_of(tree_B.mesh());
    } else {
      const Eigen::Vector3d offset = tree_A.radius() * Eigen::Vector3d(uniform(), uniform(), uniform());
      X_AB.translation() = tree_A.center() - X_AB.linear() * tree_B.center() + offset;
    }
    return X_AB;
  }

 private:
  double uniform() { return uniform_(random_); }
  Eigen::Vector3d corner_of(const geometry::TriangleMesh& mesh) {
    std::uniform_int_distribution<std::size_t> any(0, mesh.triangles.size() - 1);
    return mesh.corner(static_cast<std::int32_t>(any(random_)), 0);
  }

  std::mt19937 random_{20};
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
  bool on_corner_ = false;
};

/// Expects the pairs that brute force finds, at some poses; returns how many there were.
inline std::size_t expect_right_answers(const DopTree& tree_A, const DopTree& tree_B, int poses) {
  PosesOfContact contact;
  QueryWorkspace workspace;
  std::vector<TrianglePair> pairs;
  std::size_t total = 0;
  for (int i = 0; i < poses; ++i) {
    SCOPED_TRACE(testing::Message() << "pose " << i);
    const Eigen::Isometry3d X_AB = contact.next(tree_A, tree_B);
    const std::vector<TrianglePair> expected = reference::brute_force_pairs(tree_A.mesh(), tree_B.mesh(), X_AB);
    intersecting_pairs(tree_A, tree_B, X_AB, workspace, pairs);
    EXPECT_EQ(pairs, expected);
    EXPECT_EQ(intersects(tree_A, tree_B, X_AB, workspace), !expected.empty());
    total += expected.size();
  }
  return total;
}

}  // namespace glissade::collision
