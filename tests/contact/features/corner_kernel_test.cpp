// The vector code for corners over faces gives the same bits as the code for one corner, with every instruction set.

#include "features/corner_kernel.h"

#include <array>
#include <cstdint>
#include <limits>

#include <gtest/gtest.h>

#include <glissade/geometry/triangle_pair.h>

#include "every_instruction_set.h"
#include "random_numbers.h"
#include "sanitizers.h"

namespace glissade::contact {
namespace {

using Eigen::Vector3d;
using geometry::TrianglePoints;
using test_support::RandomNumbers;

/// A corner near the plane of a triangle, over its face or beside it, and the edges of that triangle that are rims.
struct CornerOverTriangle {
  Vector3d x;
  TrianglePoints triangle;
  std::array<bool, 3> is_rim;
  bool is_of_obstacle;
};

CornerOverTriangle random_corner(RandomNumbers& random) {
  const auto anywhere = [&] { return Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)); };
  CornerOverTriangle corner;
  const Vector3d place = 3.0 * anywhere();
  for (Vector3d& point : corner.triangle)
    point = place + 0.05 * anywhere();
  const double u = random.uniform(-0.2, 1.0);
  const double v = random.uniform(-0.2, 1.0);
  corner.x = corner.triangle[0] + u * (corner.triangle[1] - corner.triangle[0]) +
             v * (corner.triangle[2] - corner.triangle[0]) + random.power_of_ten(-7.0, -2.0) * anywhere();
  for (bool& is_rim : corner.is_rim)
    is_rim = random.chance(0.5);
  corner.is_of_obstacle = random.chance(0.5);
  return corner;
}

void put_at(const Vector3d& from, std::size_t corner, VectorsOfCorners& to) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    to[axis][corner] = from[static_cast<Eigen::Index>(axis)];
}

Vector3d vector_at(const VectorsOfCorners& vectors, std::size_t corner) {
  return {vectors[0][corner], vectors[1][corner], vectors[2][corner]};
}

double distance_to_rims(const CornerOverTriangle& corner, const Vector3d& point) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d& begin = corner.triangle[i];
    const Vector3d along = corner.triangle[(i + 1) % 3] - begin;
    if (corner.is_rim[i]) least = std::min(least, along.cross(point - begin).norm() / along.norm());
  }
  return least;
}

class CornerKernel : public test_support::EveryInstructionSet {};

TEST_P(CornerKernel, BitIdenticalToOneCornerAtATime) {
  constexpr std::uint64_t kSeed = 41;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomNumbers random(kSeed);
  int inside = 0;
  int beside = 0;
  for (int trial = 0; trial < test_support::affordable(4000); ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    std::array<CornerOverTriangle, kCornersAtOnce> corners;
    CornersOverTriangles over_triangles;
    for (std::size_t i = 0; i < kCornersAtOnce; ++i) {
      corners[i] = random_corner(random);
      put_at(corners[i].x, i, over_triangles.x);
      over_triangles.is_of_obstacle[i] = corners[i].is_of_obstacle ? 1.0 : 0.0;
      for (std::size_t c = 0; c < 3; ++c) {
        put_at(corners[i].triangle[c], i, over_triangles.triangle[c]);
        over_triangles.is_rim[c][i] = corners[i].is_rim[c] ? 1.0 : 0.0;
      }
    }
    CornersOverFaces over;
    find_corners_over_faces(over_triangles, over);
    for (std::size_t i = 0; i < kCornersAtOnce; ++i) {
      const CornerOverTriangle& corner = corners[i];
      const geometry::ClosestOnTriangle expected = geometry::closest_on_triangle(corner.x, corner.triangle);
      ASSERT_EQ(over.is_inside[i], expected.region == geometry::Region::kFace ? 1.0 : 0.0);
      if (expected.region != geometry::Region::kFace) {
        ++beside;
        continue;
      }
      ++inside;
      const Vector3d between =
          corner.is_of_obstacle ? (expected.point - corner.x).eval() : (corner.x - expected.point).eval();
      ASSERT_EQ(vector_at(over.point, i), expected.point);
      ASSERT_EQ(over.gap[i], between.norm());
      ASSERT_EQ(vector_at(over.n, i), between / between.norm());
      ASSERT_EQ(over.to_rims[i], distance_to_rims(corner, expected.point));
    }
  }
  EXPECT_GT(inside, test_support::affordable(4000));
  EXPECT_GT(beside, test_support::affordable(4000));
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, CornerKernel, CornerKernel::all(), CornerKernel::name);

}  // namespace
}  // namespace glissade::contact
