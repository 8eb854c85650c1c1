#include <random>

#include <gtest/gtest.h>

#include <glissade/collision/dop_query.h>
#include <glissade/geometry/mesh_generators.h>

#include "mesh_oracle.h"

namespace glissade::collision {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

TEST(GapLowerBound, IsTheDistanceOfSpheresAndNeverMore) {
  const auto sphere = std::make_shared<const geometry::TriangleMesh>(geometry::make_sphere(1.0, 5'000));
  const DopTree tree(sphere);
  QueryWorkspace workspace;
  for (const double gap : {1e-3, 0.1, 0.9, 3.0, 1e3}) {
    Isometry3d X_AB = Isometry3d::Identity();
    X_AB.translation().x() = 2.0 + gap;  // both have a vertex there
    const double bound = gap_lower_bound(tree, tree, X_AB, workspace);
    EXPECT_NEAR(bound, gap, 1e-9 * (1.0 + gap));
    EXPECT_FALSE(intersects(tree, tree, X_AB, workspace, bound * (1.0 - 1e-9)));
    EXPECT_TRUE(intersects(tree, tree, X_AB, workspace, bound * (1.0 + 1e-9)));
    EXPECT_EQ(gap_lower_bound(tree, tree, X_AB, workspace, 0.5 * gap), 0.5 * gap);
  }
}

TEST(GapLowerBound, AgreesWithEveryPairOfTriangles) {
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
    const double bound = gap_lower_bound(tree_A, tree_B, X_AB, workspace);
    EXPECT_LE(bound, least);
    if (least < 1.0) {  // beyond, the bounding spheres answer
      EXPECT_NEAR(bound, least, 1e-11);
    }
    if (least > 0.0) ++apart;
  }
  EXPECT_GT(apart, 10);
  EXPECT_LT(apart, 60);
}

TEST(GapLowerBound, IsTheSameFromWhereverItBeginsButCheaperWhereTheLastOneEnded) {
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
    EXPECT_EQ(gap_lower_bound(tree, tree, X_AB, remembering), gap_lower_bound(tree, tree, X_AB, fresh));
    fresh_tests += fresh.counters().triangle_tests;
    remembering_tests += remembering.counters().triangle_tests;
  }
  EXPECT_LT(remembering_tests, fresh_tests);
}

}  // namespace
}  // namespace glissade::collision
