// The vector code for distances of triangles gives the same bits as the code for one pair, with every instruction set.

#include "kernels/distance_kernel.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include <glissade/geometry/triangle_pair.h>

#include "every_instruction_set.h"
#include "random_triangles.h"
#include "sanitizers.h"

namespace glissade::collision {
namespace {

using Eigen::Vector3d;
using geometry::TriangleDistance;
using geometry::TrianglePoints;
using test_support::RandomTriangles;

void put_corners(const TrianglePoints& points, std::size_t pair, std::array<VectorsOfPairs, 3>& corners) {
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      corners[c][axis][pair] = points[c][static_cast<Eigen::Index>(axis)];
  }
}

Vector3d point_of(const VectorsOfPairs& points, std::size_t pair) {
  return {points[0][pair], points[1][pair], points[2][pair]};
}

test_support::TrianglePair any_pair(RandomTriangles& random) {
  switch (random.integer(0, 3)) {
    case 0:
      return random.anywhere();
    case 1:
      return random.on_lattice(3);
    case 2:
      return random.nearly_touching();
    default:
      return random.nearly_coplanar();
  }
}

class DistanceKernel : public test_support::EveryInstructionSet {};

TEST_P(DistanceKernel, GivesTheBitsOfOnePairAtATime) {
  constexpr std::uint64_t kSeed = 21;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomTriangles random(kSeed);
  int compared = 0;
  for (int trial = 0; trial < test_support::affordable(4000); ++trial) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
    std::array<test_support::TrianglePair, kPairsToMeasure> pairs;
    TrianglesToMeasure triangles;
    for (std::size_t i = 0; i < kPairsToMeasure; ++i) {
      pairs[i] = any_pair(random);
      put_corners(pairs[i].a, i, triangles.a);
      put_corners(pairs[i].b, i, triangles.b);
    }
    ClosestPoints closest;
    find_closest_points(triangles, closest);
    for (std::size_t i = 0; i < kPairsToMeasure; ++i) {
      if (geometry::triangles_intersect(pairs[i].a, pairs[i].b)) continue;
      const TriangleDistance expected = geometry::triangle_distance(pairs[i].a, pairs[i].b);
      if (closest.squared_distance[i] > 0.0) {
        ASSERT_EQ(std::sqrt(closest.squared_distance[i]), expected.distance);
      }
      ASSERT_EQ(point_of(closest.p_a, i), expected.p_a);
      ASSERT_EQ(point_of(closest.p_b, i), expected.p_b);
      ++compared;
    }
  }
  EXPECT_GT(compared, test_support::affordable(4000));
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, DistanceKernel, DistanceKernel::all(), DistanceKernel::name);

}  // namespace
}  // namespace glissade::collision
