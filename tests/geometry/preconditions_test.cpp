#include <gtest/gtest.h>

#include <glissade/base/assert.h>
#include <glissade/base/byte_order.h>
#include <glissade/geometry/triangle_pair.h>

#include "assertions.h"

namespace glissade::geometry {
namespace {

using GeometryPreconditions = test_support::Preconditions;

TEST(Assertions, AreEvaluatedOnlyWhereTheyAreOn) {
  int evaluated = 0;
  GLISSADE_ASSERT(++evaluated > 0);
  EXPECT_EQ(evaluated, test_support::kHasAssertions ? 1 : 0);
}

TEST_F(GeometryPreconditions, AreReportedWithFileLineAndCondition) {
  EXPECT_DEATH(GLISSADE_ASSERT(1 + 1 == 3),
               "preconditions_test.cpp:[0-9]+: the precondition does not hold: 1 \\+ 1 == 3");
}

TEST_F(GeometryPreconditions, TheFirstTriangleHasAnArea) {
  const TrianglePoints segment{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(), 2.0 * Eigen::Vector3d::UnitX()};
  const TrianglePoints triangle{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
  EXPECT_DEATH(triangles_intersect(segment, triangle), "is_degenerate");
  EXPECT_DEATH(triangle_distance(segment, triangle), "is_degenerate");
}

TEST_F(GeometryPreconditions, NumbersLieWithinTheirBytes) {
  EXPECT_DEATH(base::number_at<double>("1234567", 0), "offset");
  EXPECT_DEATH(base::number_at<char>("1", 2), "offset");
}

}  // namespace
}  // namespace glissade::geometry
