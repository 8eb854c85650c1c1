// The direction in which two triangles stay apart: what is told of it is true, and it lasts where they slide.

#include "certificate/lasting_separation.h"

#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "random_numbers.h"
#include "sanitizers.h"

namespace glissade::haptics {
namespace {

using Eigen::Vector3d;
using test_support::RandomNumbers;

geometry::TrianglePoints triangle_near(const Vector3d& place, RandomNumbers& random) {
  return {place + random.point(1e-3), place + random.point(1e-3), place + random.point(1e-3)};
}

geometry::TrianglePoints shifted(geometry::TrianglePoints triangle, const Vector3d& by) {
  for (Vector3d& x : triangle)
    x += by;
  return triangle;
}

TEST(LastingSeparation, IsAsWideAsItSaysAndNoWiderThanTheTrianglesAreApart) {
  constexpr std::uint64_t kSeed = 93;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomNumbers random(kSeed);
  int apart = 0;
  int certified = 0;
  for (int trial = 0; trial < test_support::affordable(5000); ++trial) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
    const geometry::TrianglePoints obstacle = triangle_near(Vector3d::Zero(), random);
    const geometry::TrianglePoints part = triangle_near(2e-3 * random.direction(), random);
    const TrianglesAtMoment begin{obstacle, part};
    const TrianglesAtMoment end{shifted(obstacle, random.power_of_ten(-6.0, -4.0) * random.direction()),
                                shifted(part, random.power_of_ten(-6.0, -3.0) * random.direction())};
    const double gap = 1e-6;
    const Separation separation = lasting_separation(begin, end, gap);
    const double at_begin = geometry::triangle_distance(begin.obstacle, begin.part).distance;
    const double at_end = geometry::triangle_distance(end.obstacle, end.part).distance;
    if (at_begin > gap && at_end > gap) ++apart;
    if (!(separation.least() >= gap)) continue;
    ++certified;
    ASSERT_NEAR(separation.n.norm(), 1.0, 1e-12);
    ASSERT_LE(separation.begin, at_begin + 1e-15);
    ASSERT_LE(separation.end, at_end + 1e-15);
    for (const Vector3d& x : begin.part) {
      for (const Vector3d& y : begin.obstacle)
        ASSERT_GE(separation.n.dot(x - y), separation.begin - 1e-15) << "from the obstacle to the part";
    }
  }
  EXPECT_GT(certified, apart / 2);
}

// The closest points lie ahead, along the way of the triangle: a direction through them fails on the next step.
TEST(LastingSeparation, OfATriangleThatSlidesOverAPlaneIsTheNormal) {
  const geometry::TrianglePoints plane{Vector3d(0.0, -1.0, 0.0), Vector3d(2.0, 0.0, 0.0), Vector3d(0.0, 1.0, 0.0)};
  const geometry::TrianglePoints part{Vector3d(-1.0, -0.5, 0.01), Vector3d(-0.1, 0.0, 0.01), Vector3d(-1.0, 0.5, 0.01)};
  const TrianglesAtMoment begin{plane, part};
  const Separation separation = lasting_separation(begin, {plane, shifted(part, {0.09, 0.0, 0.0})}, 1e-3);
  EXPECT_NEAR(separation.n.z(), 1.0, 1e-12);
  EXPECT_NEAR(separation.begin, 0.01, 1e-12);
  EXPECT_NEAR(separation.end, 0.01, 1e-12);
}

}  // namespace
}  // namespace glissade::haptics
