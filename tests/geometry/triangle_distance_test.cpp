#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <glissade/geometry/triangle_pair.h>

#include "cgal_oracle.h"
#include "random_triangles.h"
#include "sanitizers.h"

namespace glissade::geometry {
namespace {

using Eigen::Vector3d;
using test_support::affordable;
using test_support::RandomTriangles;

const TrianglePoints kUnit{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)};

void expect_points(const TriangleDistance& actual, double distance, const Vector3d& p_a, const Vector3d& p_b) {
  EXPECT_NEAR(actual.distance, distance, 1e-15);
  EXPECT_LT((actual.p_a - p_a).norm(), 1e-15) << actual.p_a.transpose();
  EXPECT_LT((actual.p_b - p_b).norm(), 1e-15) << actual.p_b.transpose();
}

TEST(TriangleDistance, FindsTheClosestFeatures) {
  const TrianglePoints corner_above{Vector3d(.25, .25, 2), Vector3d(0, 1, 3), Vector3d(1, 0, 4)};
  expect_points(triangle_distance(kUnit, corner_above), 2.0, Vector3d(.25, .25, 0), Vector3d(.25, .25, 2));
  expect_points(triangle_distance(corner_above, kUnit), 2.0, Vector3d(.25, .25, 2), Vector3d(.25, .25, 0));

  const TrianglePoints edge_across{Vector3d(.5, -3, -1), Vector3d(.5, -3, 1), Vector3d(.5, -9, 0)};
  expect_points(triangle_distance(kUnit, edge_across), 3.0, Vector3d(.5, 0, 0), Vector3d(.5, -3, 0));

  const TrianglePoints corner_to_corner{Vector3d(-3, -4, 0), Vector3d(-9, -4, 1), Vector3d(-9, -4, -1)};
  expect_points(triangle_distance(kUnit, corner_to_corner), 5.0, Vector3d(0, 0, 0), Vector3d(-3, -4, 0));

  const TrianglePoints corner_to_edge{Vector3d(1, 1, 0), Vector3d(2, 2, 1), Vector3d(2, 2, -1)};
  expect_points(triangle_distance(kUnit, corner_to_edge), std::sqrt(.5), Vector3d(.5, .5, 0), Vector3d(1, 1, 0));
}

TEST(TriangleDistance, IsRightForParallelFacesAndEdges) {
  TrianglePoints lifted = kUnit;
  for (Vector3d& corner : lifted) {
    corner.z() += 0.5;
  }
  EXPECT_EQ(triangle_distance(kUnit, lifted).distance, 0.5);
  const TrianglePoints beside{Vector3d(.25, -2, 0), Vector3d(.75, -2, 0), Vector3d(.5, -3, 0)};
  EXPECT_EQ(triangle_distance(kUnit, beside).distance, 2.0);
  const TrianglePoints in_line{Vector3d(3, 0, 0), Vector3d(4, 0, 0), Vector3d(3, -1, 0)};
  EXPECT_EQ(triangle_distance(kUnit, in_line).distance, 2.0);
}

TEST(TriangleDistance, IsZeroExactlyWhenTheyIntersect) {
  const TrianglePoints piercing{Vector3d(.25, .25, -1), Vector3d(.25, .25, 1), Vector3d(3, 3, 0)};
  const TriangleDistance pierced = triangle_distance(kUnit, piercing);
  EXPECT_EQ(pierced.distance, 0.0);
  EXPECT_LT((pierced.p_a - pierced.p_b).norm(), 1e-15);
  EXPECT_NEAR(pierced.p_a.z(), 0.0, 1e-15);

  // One unit in the last place above the face: the gap is the coordinate's spacing, far less than the edges' rounding.
  const double height = 1e3;
  const double next = std::nextafter(height, 2 * height);
  const TrianglePoints face{Vector3d(.1, 0, height), Vector3d(1.7, .3, height), Vector3d(0, 1.3, height)};
  TrianglePoints above{Vector3d(.3, .3, height), Vector3d(.3, .5, height + 1), Vector3d(.5, .3, height + 1)};
  EXPECT_EQ(triangle_distance(face, above).distance, 0.0);
  above[0].z() = next;
  EXPECT_NEAR(triangle_distance(face, above).distance, next - height, 1e-6 * (next - height));
}

TEST(TriangleDistance, KeepsTheDistanceWhereEdgesAreNearlyParallel) {
  // Two edges of length 1 cross in projection at an angle of 1e-8, a gap of 1e-9 apart: the ends are 5 times as far.
  const double angle = 1e-8;
  const TrianglePoints a{Vector3d(-.5, 0, 0), Vector3d(.5, 0, 0), Vector3d(0, 0, -1)};
  const TrianglePoints b{Vector3d(-.5, -.5 * angle, 1e-9), Vector3d(.5, .5 * angle, 1e-9), Vector3d(0, 0, 1)};
  EXPECT_NEAR(triangle_distance(a, b).distance, 1e-9, 1e-16);
}

TEST(TriangleDistance, IsRightForNeedles) {
  // 1 m long, 10 nm wide, in a direction that is no axis; the nearest point is inside.
  const Vector3d along = Vector3d(1, 2, 3).normalized();
  const Vector3d across = along.cross(Vector3d(0, 0, 1)).normalized();
  const Vector3d up = along.cross(across);
  const TrianglePoints needle{-.5 * along - .4e-8 * across, .5 * along, -.5 * along + .6e-8 * across};
  const Vector3d tip = 1e-3 * up;
  const TrianglePoints above{tip, tip + along + up, tip - along + up};
  EXPECT_NEAR(triangle_distance(needle, above).distance, 1e-3, 1e-15);
}

TEST(TriangleDistance, IsRightForNeedlesABillionTimesAsLongAsWide) {
  // A corner comes as near to the needle's face as 1.3e-18.
  const TrianglePoints triangle{Vector3d(0x1.0ed249d38c6ap-8, 0x1.2d8c0264199b9p-2, 0x1.39408bcba20e4p-3),
                                Vector3d(0x1.394cccc7be3d9p-4, 0x1.cd58411108b3dp-5, 0x1.ed32c9a124487p-5),
                                Vector3d(0x1.833b3cb3f5eb7p-5, 0x1.9d13897588b14p-4, 0x1.fdaa1019cb99p-7)};
  const TrianglePoints needle{Vector3d(-0x1.8823e0b179be4p-4, 0x1.46f6cf3faf4ddp-1, 0x1.e2a81a9017b13p-2),
                              Vector3d(0x1.430d354f94656p-4, 0x1.8b67ea05747f4p-5, 0x1.bea3ee42ea9afp-5),
                              Vector3d(0x1.c4ce4e9031a1p-6, 0x1.c59863b931938p-3, 0x1.6a232629af946p-3)};
  EXPECT_GT(triangle_distance(triangle, needle).distance, 0.0);
  EXPECT_LT(triangle_distance(triangle, needle).distance, 1e-15);
}

TEST(TriangleDistance, FindsASmallerGapBeyondASmallOne) {
  // The edge of b on the x axis passes 1e-8 above an edge of a, but a is tilted and meets it 1 m further on, less 1e-9.
  const TrianglePoints a{Vector3d(0, -1, 0), Vector3d(0, 1, 0), Vector3d(2, 0, 1.8e-8)};
  const TrianglePoints b{Vector3d(-1, 0, 1e-8), Vector3d(1, 0, 1e-8), Vector3d(0, 0, 1)};
  EXPECT_NEAR(triangle_distance(a, b).distance, 1e-9, 1e-16);
}

double largest_coordinate(const test_support::TrianglePair& pair) {
  double largest = 0.0;
  for (const TrianglePoints* triangle : {&pair.a, &pair.b}) {
    for (const Vector3d& corner : *triangle) {
      largest = std::max(largest, corner.cwiseAbs().maxCoeff());
    }
  }
  return largest;
}

void expect_agreement(const test_support::TrianglePair& pair) {
  const double tolerance = 16 * std::numeric_limits<double>::epsilon() * largest_coordinate(pair);
  const bool intersect = test_support::cgal_intersect(pair.a, pair.b);
  const double expected = intersect ? 0.0 : test_support::cgal_distance(pair.a, pair.b);
  const TriangleDistance actual = triangle_distance(pair.a, pair.b);
  ASSERT_EQ(actual.distance == 0.0, intersect);
  ASSERT_NEAR(actual.distance, expected, tolerance);
  ASSERT_NEAR((actual.p_a - actual.p_b).norm(), expected, 4 * tolerance);
  ASSERT_LE(test_support::cgal_distance(actual.p_a, pair.a), 4 * tolerance);
  ASSERT_LE(test_support::cgal_distance(actual.p_b, pair.b), 4 * tolerance);
  ASSERT_NEAR(triangle_distance(pair.b, pair.a).distance, expected, tolerance);
}

template <typename Next>
void expect_agreement_with_cgal(int count, std::uint64_t seed, const Next& next) {
  RandomTriangles random(seed);
  for (int i = 0; i < count; ++i) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", pair " + std::to_string(i));
    expect_agreement(next(random));
    if (testing::Test::HasFatalFailure()) {
      return;
    }
  }
}

TEST(TriangleDistanceAgainstCgal, AgreesAnywhere) {
  expect_agreement_with_cgal(affordable(2'000), 11, [](RandomTriangles& random) { return random.anywhere(); });
}

TEST(TriangleDistanceAgainstCgal, AgreesOnLattices) {
  expect_agreement_with_cgal(affordable(2'000), 12, [](RandomTriangles& random) { return random.on_lattice(3); });
}

TEST(TriangleDistanceAgainstCgal, AgreesOnPairsThatNearlyTouch) {
  expect_agreement_with_cgal(affordable(2'000), 13, [](RandomTriangles& random) { return random.nearly_touching(); });
}

TEST(TriangleDistanceAgainstCgal, AgreesOnPairsThatAreNearlyCoplanar) {
  expect_agreement_with_cgal(affordable(2'000), 14, [](RandomTriangles& random) { return random.nearly_coplanar(); });
}

TEST(TriangleDistance, DegenerateTriangleActsAsASegmentOrPoint) {
  const TrianglePoints triangle{Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0)};
  const Eigen::Vector3d p(-0.1, 0.5, 0);
  EXPECT_NEAR(triangle_distance(triangle, {p, p, p}).distance, 0.1, 1e-15);
  EXPECT_NEAR(triangle_distance(triangle, {p, p, Eigen::Vector3d(-0.1, 0.7, 0)}).distance, 0.1, 1e-15);
  EXPECT_NEAR(triangle_distance(
                  triangle, {Eigen::Vector3d(0.2, 0.2, 3), Eigen::Vector3d(0.2, 0.2, 1), Eigen::Vector3d(0.2, 0.2, 2)})
                  .distance,
              1.0, 1e-15);
}

}  // namespace
}  // namespace glissade::geometry
