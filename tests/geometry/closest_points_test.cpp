// The vector code for distances of triangles gives the same bits as the code for one pair, with every instruction set,
// and never says of triangles that intersect that they are apart.

#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include <glissade/geometry/triangle_pair.h>

#include "every_instruction_set.h"
#include "random_triangles.h"
#include "sanitizers.h"

namespace glissade::geometry {
namespace {

using test_support::RandomTriangles;

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

class ClosestPointsOfPairs : public test_support::EveryInstructionSet {};

TEST_P(ClosestPointsOfPairs, BitIdenticalToOnePairAtATime) {
  constexpr std::uint64_t kSeed = 21;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomTriangles random(kSeed);
  int compared = 0;
  int certain = 0;
  for (int trial = 0; trial < test_support::affordable(4000); ++trial) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
    std::array<test_support::TrianglePair, kPairsToMeasure> pairs;
    TrianglesToMeasure triangles;
    for (std::size_t i = 0; i < kPairsToMeasure; ++i) {
      pairs[i] = any_pair(random);
      put_triangle(pairs[i].a, i, triangles.a);
      put_triangle(pairs[i].b, i, triangles.b);
    }
    ClosestPoints closest;
    find_closest_points(triangles, closest);
    for (std::size_t i = 0; i < kPairsToMeasure; ++i) {
      if (closest.is_apart[i] != 0.0) ++certain;
      if (triangles_intersect(pairs[i].a, pairs[i].b)) {
        ASSERT_EQ(closest.is_apart[i], 0.0);
        continue;
      }
      const TriangleDistance expected = triangle_distance(pairs[i].a, pairs[i].b);
      if (closest.squared_distance[i] > 0.0) {
        ASSERT_EQ(std::sqrt(closest.squared_distance[i]), expected.distance);
      }
      ASSERT_EQ(vector_of_pair(closest.p_a, i), expected.p_a);
      ASSERT_EQ(vector_of_pair(closest.p_b, i), expected.p_b);
      ++compared;
    }
  }
  EXPECT_GT(compared, test_support::affordable(4000));
  EXPECT_GT(certain, compared / 2);
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, ClosestPointsOfPairs, ClosestPointsOfPairs::all(),
                         ClosestPointsOfPairs::name);

}  // namespace
}  // namespace glissade::geometry
