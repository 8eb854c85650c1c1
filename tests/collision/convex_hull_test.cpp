#include <algorithm>
#include <limits>
#include <set>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <glissade/collision/convex_hull.h>
#include <glissade/geometry/mesh_generators.h>

#include "random_numbers.h"

namespace glissade::collision {
namespace {

using Eigen::Vector3d;
using test_support::RandomNumbers;

constexpr unsigned kConvexHullSeed = 41;

double farthest(const std::vector<Vector3d>& points, const Vector3d& direction) {
  double most = -std::numeric_limits<double>::infinity();
  for (const Vector3d& x : points)
    most = std::max(most, direction.dot(x));
  return most;
}

double size_of(const std::vector<Vector3d>& points) {
  double size = 0.0;
  for (const Vector3d& x : points)
    size = std::max(size, (x - points[0]).norm());
  return size;
}

// The hull reaches as far as the points in every direction, by climbing from anywhere, and no further.
void expect_hull(const std::vector<Vector3d>& points, RandomNumbers& random) {
  const ConvexHull hull(points);
  const double size = size_of(points);
  const double rounding = 1e-14 * (size + points[0].norm());
  ASSERT_LE(hull.outside(), 10.0 * rounding);
  const auto corners = static_cast<int>(hull.vertices().size());
  for (const Vector3d& corner : hull.vertices())
    ASSERT_NE(std::find(points.begin(), points.end(), corner), points.end());
  for (int trial = 0; trial < 200; ++trial) {
    const Vector3d direction = random.direction();
    const std::int32_t best = hull.support(direction, random.integer(0, corners - 1));
    const double reach = direction.dot(hull.vertices()[static_cast<std::size_t>(best)]);
    ASSERT_LE(reach, farthest(points, direction));
    ASSERT_GE(reach, farthest(points, direction) - hull.outside() - hull.climbing_error()) << "trial " << trial;
    const std::int32_t surely_best = hull.farthest(direction);
    const double most = direction.dot(hull.vertices()[static_cast<std::size_t>(surely_best)]);
    ASSERT_GE(most, farthest(points, direction) - hull.outside() - rounding) << "trial " << trial;
    ASSERT_LE(reach, most);
  }
}

// Every neighbor is a neighbor in turn, and all corners can be reached.
void expect_connected(const ConvexHull& hull) {
  std::set<std::int32_t> reached{0};
  std::vector<std::int32_t> open{0};
  while (!open.empty()) {
    const std::int32_t at = open.back();
    open.pop_back();
    for (const std::int32_t next : hull.neighbors(at)) {
      const auto back = hull.neighbors(next);
      ASSERT_NE(std::find(back.begin(), back.end(), at), back.end());
      if (reached.insert(next).second) open.push_back(next);
    }
  }
  EXPECT_EQ(reached.size(), hull.vertices().size());
}

std::vector<Vector3d> cloud(RandomNumbers& random, int count) {
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i)
    points.push_back(random.point(1.0));
  return points;
}

class ConvexHulls : public ::testing::Test {
 protected:
  ConvexHulls() { RecordProperty("seed", static_cast<int>(kConvexHullSeed)); }
  RandomNumbers random_{kConvexHullSeed};
};

TEST_F(ConvexHulls, SupportMatchesThePointsAtEveryScaleAndOffset) {
  for (const double scale : {1e-6, 1.0, 1e3}) {
    for (const double offset : {0.0, 1.0, 1e6}) {
      std::vector<Vector3d> points = cloud(random_, 300);
      for (Vector3d& x : points)
        x = scale * (x + Vector3d(offset, -offset, offset));
      ASSERT_NO_FATAL_FAILURE(expect_hull(points, random_)) << "scale " << scale << ", offset " << offset;
      expect_connected(ConvexHull(points));
    }
  }
}

TEST_F(ConvexHulls, OfSmoothAndOfFlatFacedBodies) {
  for (const std::int64_t triangles : {100, 2000, 20000}) {
    ASSERT_NO_FATAL_FAILURE(expect_hull(geometry::make_sphere(0.5, triangles).vertices, random_));
    ASSERT_NO_FATAL_FAILURE(expect_hull(geometry::make_box({1.0, 0.2, 3.0}, triangles).vertices, random_));
  }
  const ConvexHull box(geometry::make_box({1.0, 0.2, 3.0}, 5000));
  EXPECT_EQ(box.dimension(), 3);
  EXPECT_EQ(box.vertices().size(), 8U);
}

TEST_F(ConvexHulls, OfAPolygonASegmentAndAPoint) {
  const Eigen::Matrix3d R = random_.rotation();
  std::vector<Vector3d> polygon;
  std::vector<Vector3d> segment;
  for (int i = 0; i < 200; ++i) {
    const double along = random_.uniform(-1.0, 1.0);
    polygon.push_back(R * Vector3d(along, random_.uniform(-1.0, 1.0), 0.0) + Vector3d(3, 4, 5));
    segment.push_back(R * Vector3d(along, 0.0, 0.0) + Vector3d(3, 4, 5));
  }
  ASSERT_NO_FATAL_FAILURE(expect_hull(polygon, random_));
  ASSERT_NO_FATAL_FAILURE(expect_hull(segment, random_));
  ASSERT_NO_FATAL_FAILURE(expect_hull(std::vector<Vector3d>(5, Vector3d(1, 2, 3)), random_));
  EXPECT_EQ(ConvexHull(polygon).dimension(), 2);
  EXPECT_EQ(ConvexHull(segment).dimension(), 1);
  EXPECT_EQ(ConvexHull(segment).vertices().size(), 2U);
  EXPECT_EQ(ConvexHull(std::vector<Vector3d>(5, Vector3d(1, 2, 3))).dimension(), 0);
  expect_connected(ConvexHull(polygon));
}

TEST_F(ConvexHulls, NearlyFlatPointSetsLoseNoPoint) {
  for (const double thickness : {1e-16, 1e-14, 1e-12, 1e-11, 1e-10, 1e-9, 1e-7, 1e-4}) {
    std::vector<Vector3d> points = cloud(random_, 200);
    const Eigen::Matrix3d R = random_.rotation();
    for (Vector3d& x : points)
      x = R * Vector3d(x.x(), x.y(), thickness * x.z());
    ASSERT_NO_FATAL_FAILURE(expect_hull(points, random_)) << "thickness " << thickness;
  }
}

// Among corners within a millionth of each other climbing sees least of where up is.
TEST_F(ConvexHulls, HillClimbingErrorIsBoundedForClusteredPoints) {
  for (const double spread : {1e-13, 1e-11, 1e-9, 1e-6, 1e-3}) {
    std::vector<Vector3d> points;
    for (const Vector3d& place : cloud(random_, 8)) {
      for (int i = 0; i < 6; ++i)
        points.emplace_back(place + spread * random_.point(1.0));
    }
    ASSERT_NO_FATAL_FAILURE(expect_hull(points, random_)) << "spread " << spread;
    // Across an edge of the hull, all but the smallest differences are hidden.
    const ConvexHull hull(points);
    for (std::int32_t corner = 0; corner < static_cast<std::int32_t>(hull.vertices().size()); ++corner) {
      const Vector3d& at = hull.vertices()[static_cast<std::size_t>(corner)];
      for (const std::int32_t next : hull.neighbors(corner)) {
        const Vector3d edge = (hull.vertices()[static_cast<std::size_t>(next)] - at).normalized();
        const Vector3d direction = edge.cross(random_.direction()).normalized();
        const Vector3d& found = hull.vertices()[static_cast<std::size_t>(hull.support(direction, corner))];
        ASSERT_GE(direction.dot(found), farthest(points, direction) - hull.outside() - hull.climbing_error())
            << "spread " << spread;
      }
    }
  }
}

TEST_F(ConvexHulls, OfAMeshLeavesOutVerticesThatNoTriangleUses) {
  geometry::TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 9, 9}}, {{0, 1, 2}}};
  EXPECT_EQ(ConvexHull(mesh).vertices().size(), 3U);
}

TEST_F(ConvexHulls, RefusesNoPointsAndWhatIsNotFinite) {
  EXPECT_THROW(ConvexHull(geometry::TriangleMesh{}), std::invalid_argument);
  const std::vector<Vector3d> points{{0, 0, 0}, {std::numeric_limits<double>::quiet_NaN(), 0, 0}};
  EXPECT_THROW(ConvexHull{points}, std::invalid_argument);
}

}  // namespace
}  // namespace glissade::collision
