#include <random>

#include <gtest/gtest.h>

#include <glissade/collision/dop_query.h>
#include <glissade/geometry/mesh_generators.h>

#include "mesh_oracle.h"

namespace glissade::collision {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

TEST(MeshDistance, MatchesSpheresAtAnyDistance) {
  const auto sphere = std::make_shared<const geometry::TriangleMesh>(geometry::make_sphere(1.0, 5'000));
  const DopTree tree(sphere);
  QueryWorkspace workspace;
  for (const double gap : {1e-3, 0.1, 0.9, 3.0, 1e3, 1e6}) {
    Isometry3d X_AB = Isometry3d::Identity();
    X_AB.translation().x() = 2.0 + gap;  // both have a vertex there
    const MeshDistance found = distance(tree, tree, X_AB, workspace);
    EXPECT_NEAR(found.distance, gap, 1e-12 * (1.0 + gap));
    ASSERT_TRUE(found.nearest.has_value());
    EXPECT_LT((found.nearest->p_A - Vector3d(1.0, 0.0, 0.0)).norm(), 1e-12);
    EXPECT_LT((found.nearest->p_B - Vector3d(1.0 + gap, 0.0, 0.0)).norm(), 1e-12 * (1.0 + gap));
    const MeshDistance limited = distance(tree, tree, X_AB, workspace, 0.5 * gap);
    EXPECT_EQ(limited.distance, 0.5 * gap);
    EXPECT_FALSE(limited.nearest.has_value());
  }
}

TEST(MeshDistance, AgreesWithEveryPairOfTriangles) {
  constexpr unsigned kSeed = 5;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937 generator(kSeed);
  std::normal_distribution<double> normal;
  const auto mesh_A = std::make_shared<const geometry::TriangleMesh>(geometry::make_torus(1.0, 0.3, 200));
  const auto mesh_B = std::make_shared<const geometry::TriangleMesh>(geometry::make_plate({0.5, 0.3}, 50));
  const DopTree tree_A(mesh_A);
  const DopTree tree_B(mesh_B);
  const test_support::MeshOracle oracle(*mesh_A, *mesh_B);
  QueryWorkspace workspace;
  int apart = 0;
  for (int trial = 0; trial < 60; ++trial) {
    Isometry3d X_AB = Isometry3d::Identity();
    X_AB.linear() = Eigen::Quaterniond(normal(generator), normal(generator), normal(generator), normal(generator))
                        .normalized()
                        .toRotationMatrix();
    X_AB.translation() = 0.5 * Vector3d(normal(generator), normal(generator), normal(generator));
    double least = std::numeric_limits<double>::infinity();
    for (const ClosePair& pair : oracle.pairs_within(X_AB, 10.0))
      least = std::min(least, pair.distance);
    const MeshDistance found = distance(tree_A, tree_B, X_AB, workspace);
    EXPECT_NEAR(found.distance, least, 1e-14);
    EXPECT_EQ(found.nearest.has_value(), least > 0.0);
    if (least > 0.0) ++apart;
  }
  EXPECT_GT(apart, 10);
  EXPECT_LT(apart, 60);
}

// Of meshes far apart nearly all nodes were opened as long as their bounds got looser with the distance.
TEST(MeshDistance, CostIndependentOfDistance) {
  const auto sphere = std::make_shared<const geometry::TriangleMesh>(geometry::make_sphere(1.0, 20'000));
  const DopTree tree(sphere);
  QueryWorkspace workspace;
  for (const double gap : {0.1, 1.0, 10.0, 1e3, 1e5}) {
    SCOPED_TRACE(gap);
    Isometry3d X_AB(Eigen::AngleAxisd(0.5, Vector3d(1, 2, 3).normalized()));
    X_AB.translation() = (2.0 + gap) * Vector3d(0.6, 0.0, 0.8);
    distance(tree, tree, X_AB, workspace);
    EXPECT_LT(workspace.counters().node_tests, 20'000);
  }
}

// The nearest points are a corner of each, which six triangles share.
TEST(MeshDistance, NamesTheFirstOfPairsThatAreEquallyNear) {
  const auto sphere = std::make_shared<const geometry::TriangleMesh>(geometry::make_sphere(1.0, 1'000));
  const DopTree tree(sphere);
  QueryWorkspace workspace;
  Isometry3d X_AB = Isometry3d::Identity();
  X_AB.translation().x() = 3.0;
  const MeshDistance found = distance(tree, tree, X_AB, workspace);
  std::vector<ClosePair> pairs;
  pairs_within(tree, tree, X_AB, found.distance, workspace, pairs);
  ASSERT_GT(pairs.size(), 1U);
  ASSERT_TRUE(found.nearest.has_value());
  EXPECT_EQ(found.nearest->triangles, pairs.front().triangles);
}

TEST(MeshDistance, IsFoundHoweverFarTheMeshesAreApart) {
  const auto box = std::make_shared<const geometry::TriangleMesh>(geometry::make_box({1, 1, 1}, 12));
  const DopTree tree(box);
  QueryWorkspace workspace;
  for (const double far : {1e4, 1e9, 1e12}) {
    Isometry3d X_AB = Isometry3d::Identity();
    X_AB.translation().y() = far;
    EXPECT_NEAR(distance(tree, tree, X_AB, workspace).distance, far - 1.0, 1e-15 * far);
    EXPECT_FALSE(intersects(tree, tree, X_AB, workspace, 0.9 * far));
    EXPECT_TRUE(intersects(tree, tree, X_AB, workspace, 1e300));
  }
}

// An overflow of the distance in radii.
TEST(MeshDistance, IsRefusedIfTheMeshesAreTooSmallForIt) {
  QueryWorkspace workspace;
  for (const double edge : {1e-8, 1e-11, 1e-20, 1e-60}) {
    const DopTree tree(std::make_shared<const geometry::TriangleMesh>(geometry::make_box({edge, edge, edge}, 12)));
    const double far = edge * 1e17;
    Isometry3d X_AB = Isometry3d::Identity();
    X_AB.translation().y() = far;
    EXPECT_NEAR(distance(tree, tree, X_AB, workspace).distance, far - edge, 1e-15 * far);
    EXPECT_TRUE(intersects(tree, tree, X_AB, workspace, 1.1 * far));
    X_AB.translation().y() = 1e3 * far;
    EXPECT_THROW(distance(tree, tree, X_AB, workspace), std::invalid_argument);
  }
  const DopTree tiny(std::make_shared<const geometry::TriangleMesh>(geometry::make_box({1e-147, 1e-147, 1e-147}, 12)));
  Isometry3d X_AB = Isometry3d::Identity();
  X_AB.translation().y() = 1e9;
  EXPECT_THROW(distance(tiny, tiny, X_AB, workspace), std::invalid_argument);
}

TEST(MeshDistance, WarmStartKeepsTheResultAtLowerCost) {
  const auto sphere = std::make_shared<const geometry::TriangleMesh>(geometry::make_sphere(1.0, 5'000));
  const DopTree tree(sphere);
  QueryWorkspace fresh;
  CoherentWorkspace remembering;
  std::int64_t fresh_tests = 0;
  std::int64_t remembering_tests = 0;
  for (int frame = 0; frame < 100; ++frame) {
    Isometry3d X_AB = Isometry3d::Identity();
    X_AB.rotate(Eigen::AngleAxisd(1e-4 * frame, Vector3d(1, 2, 3).normalized()));
    X_AB.translation() = Vector3d(2.1 + 1e-4 * frame, 1e-4 * frame, 0.0);
    const MeshDistance found = distance(tree, tree, X_AB, remembering);
    const MeshDistance expected = distance(tree, tree, X_AB, fresh);
    EXPECT_EQ(found.distance, expected.distance);
    EXPECT_EQ(found.nearest->triangles, expected.nearest->triangles);
    fresh_tests += fresh.counters().triangle_tests;
    remembering_tests += remembering.counters().triangle_tests;
  }
  EXPECT_LT(remembering_tests, fresh_tests);
}

}  // namespace
}  // namespace glissade::collision
