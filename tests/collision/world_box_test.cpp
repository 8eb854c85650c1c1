#include "pipeline/world_box.h"

#include <cstdint>
#include <memory>

#include <gtest/gtest.h>

#include <glissade/collision/dop_query.h>
#include <glissade/geometry/displacement.h>
#include <glissade/geometry/mesh_generators.h>

#include "poses.h"
#include "random_numbers.h"

namespace glissade::collision {
namespace {

constexpr std::uint64_t kWorldBoxSeed = 20261122;

DopTree shifted_tree_of(geometry::TriangleMesh mesh, const Eigen::Vector3d& offset) {
  for (Eigen::Vector3d& vertex : mesh.vertices)
    vertex += offset;
  return DopTree(std::make_shared<geometry::TriangleMesh>(std::move(mesh)));
}

// R may be off a rotation.
Eigen::Isometry3d of_matrix(const Eigen::Matrix3d& R, const Eigen::Vector3d& p) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = R;
  X.translation() = p;
  return X;
}

TEST(WorldBox, TightForAnUnrotatedMesh) {
  const DopTree tree = shifted_tree_of(geometry::make_box({2.0, 4.0, 6.0}, 12), {10.0, 0.0, 0.0});
  const Eigen::AlignedBox3d box = world_box(tree, test_support::at(0.0, 1.0));
  EXPECT_LT((box.min() - Eigen::Vector3d(9.0, -1.0, -3.0)).norm(), 1e-9);
  EXPECT_LT((box.max() - Eigen::Vector3d(11.0, 3.0, 3.0)).norm(), 1e-9);
}

TEST(WorldBox, UsesTheBoundingSphereIfTheRotatedBoxIsLarger) {
  const DopTree tree = shifted_tree_of(geometry::make_sphere(1.0, 20000), {0.0, 0.0, 0.0});
  const Eigen::AngleAxisd turn(0.7, Eigen::Vector3d(1.0, 1.0, 1.0).normalized());
  const Eigen::AlignedBox3d box = world_box(tree, Eigen::Isometry3d(turn));
  EXPECT_LT(box.max().maxCoeff(), tree.radius() * (1.0 + 1e-9));
}

TEST(WorldBox, EnclosesEveryVertexAtAnyPose) {
  RecordProperty("seed", static_cast<int>(kWorldBoxSeed));
  test_support::RandomNumbers random(kWorldBoxSeed);
  for (int i = 0; i < 2000; ++i) {
    const double size = random.power_of_ten(-3.0, 3.0);
    const DopTree tree =
        shifted_tree_of(geometry::make_box(size * Eigen::Vector3d(1.0, random.uniform(0.1, 1.0), 0.3), 12),
                        random.point(random.power_of_ten(-3.0, 4.0)));
    Eigen::Matrix3d R = random.chance(0.5) ? random.rotation() : random.cube_rotation();
    for (int row = 0; row < 3; ++row)
      R.row(row) += 1e-6 * random.point(1.0).transpose();
    const Eigen::Isometry3d X_WO = *geometry::rigid_pose(of_matrix(R, random.point(random.power_of_ten(-3.0, 6.0))));
    const Eigen::AlignedBox3d box = world_box(tree, X_WO);
    for (const Eigen::Vector3d& vertex : tree.mesh().vertices)
      ASSERT_TRUE(box.contains(X_WO * vertex)) << "seed " << kWorldBoxSeed << ", case " << i;
  }
}

// Two boxes face to face, at poses that are rotations but for what `rigid_pose` lets pass: when the query says that
// they touch, so do the boxes around them.
TEST(WorldBox, BoxesOfIntersectingObjectsOverlap) {
  RecordProperty("seed", static_cast<int>(kWorldBoxSeed));
  test_support::RandomNumbers random(kWorldBoxSeed);
  QueryWorkspace workspace;
  int intersecting = 0;
  int apart = 0;
  for (int i = 0; i < 4000; ++i) {
    const DopTree tree_A =
        shifted_tree_of(geometry::make_box({1.0, 1.0, 1.0}, 12), {random.uniform(0.0, 3.0), 0.0, 0.0});
    const DopTree tree_B =
        shifted_tree_of(geometry::make_box({1.0, 1.0, 1.0}, 12), {random.uniform(-3.0, 0.0), 0.0, 0.0});
    const double off = random.power_of_ten(-17.0, -12.4);
    Eigen::Matrix3d R_A = Eigen::Matrix3d::Identity();
    Eigen::Matrix3d R_B = Eigen::Matrix3d::Identity();
    R_A(0, 0) += random.uniform(-off, off);
    R_B(0, 0) += random.uniform(-off, off);
    const Eigen::Vector3d p_A = random.point(random.power_of_ten(-1.0, 3.0));
    const Eigen::Isometry3d X_WA = *geometry::rigid_pose(of_matrix(R_A, p_A));
    // The face of A at x = c + 1/2 and that of B at x = c - 1/2.
    const double face_A = R_A(0, 0) * (tree_A.center().x() + 0.5);
    const double face_B = R_B(0, 0) * (tree_B.center().x() - 0.5);
    const double gap = random.uniform(-1.0, 1.0) * random.power_of_ten(-16.0, -9.0);
    const Eigen::Isometry3d X_WB =
        *geometry::rigid_pose(of_matrix(R_B, p_A + Eigen::Vector3d(face_A - face_B + gap, 0.3, 0.2)));
    const bool boxes_overlap = world_box(tree_A, X_WA).intersects(world_box(tree_B, X_WB));
    if (!intersects(tree_A, tree_B, X_WA.inverse() * X_WB, workspace)) {
      apart += boxes_overlap ? 0 : 1;
      continue;
    }
    ++intersecting;
    ASSERT_TRUE(boxes_overlap) << "seed " << kWorldBoxSeed << ", case " << i << ", gap " << gap << ", off " << off;
  }
  EXPECT_GT(intersecting, 1000);
  EXPECT_GT(apart, 1) << "boxes that always overlap prove nothing";
}

}  // namespace
}  // namespace glissade::collision
