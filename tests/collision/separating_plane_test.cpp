#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <glissade/collision/convex_hull.h>
#include <glissade/geometry/mesh_generators.h>

#include "allocation_counter.h"
#include "hull_oracle.h"
#include "random_numbers.h"
#include "sanitizers.h"

namespace glissade::collision {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::affordable;
using test_support::HullOracle;
using test_support::RandomNumbers;

constexpr unsigned kSeparatingPlaneSeed = 42;

class SeparatingPlanes : public ::testing::Test {
 protected:
  SeparatingPlanes() { RecordProperty("seed", static_cast<int>(kSeparatingPlaneSeed)); }

  Isometry3d pose(const Vector3d& p_AB) {
    Isometry3d X_AB = Isometry3d::Identity();
    X_AB.linear() = random_.rotation();
    X_AB.translation() = p_AB;
    return X_AB;
  }

  RandomNumbers random_{kSeparatingPlaneSeed};
};

TEST_F(SeparatingPlanes, TellBoxesApartAtTheirFaces) {
  const ConvexHull box(geometry::make_box({2.0, 2.0, 2.0}, 12));
  for (const HullTest test : {HullTest::kExact, HullTest::kPerceptron}) {
    for (const double gap : {1e-1, 1e-3, 1e-6}) {
      HullMemory memory;
      const Isometry3d X_AB(Eigen::Translation3d(2.0 + gap, 0.3, -0.2));
      EXPECT_TRUE(hulls_apart(box, box, X_AB, memory, test)) << gap;
      EXPECT_GT(memory.gap, 0.0);
      EXPECT_LE(memory.gap, gap);
    }
    HullMemory memory;
    EXPECT_FALSE(hulls_apart(box, box, Isometry3d(Eigen::Translation3d(2.0, 0.3, -0.2)), memory, test)) << "touching";
    EXPECT_FALSE(hulls_apart(box, box, Isometry3d(Eigen::Translation3d(1.99, 0.3, -0.2)), memory, test));
    EXPECT_EQ(memory.gap, 0.0);
  }
}

// Two bodies roll about each other through contact; memory must never change an answer, and every answer is proved.
TEST_F(SeparatingPlanes, WarmStartKeepsTheResult) {
  const std::vector<ConvexHull> hulls{
      ConvexHull(geometry::make_sphere(0.5, 200)), ConvexHull(geometry::make_box({1.0, 0.4, 0.1}, 12)),
      ConvexHull(geometry::make_plate({0.7, 0.7}, 2)), ConvexHull(std::vector<Vector3d>{{-0.5, 0, 0}, {0.5, 0.1, 0}}),
      ConvexHull(std::vector<Vector3d>{{0, 0, 0}})};
  int apart = 0;
  int meeting = 0;
  for (const ConvexHull& hull_A : hulls) {
    for (const ConvexHull& hull_B : hulls) {
      HullMemory remembering;
      HullMemory perceptron;
      Isometry3d X_AB = pose(random_.point(0.5));
      for (int step = 0; step < affordable(160); ++step) {
        const double stride = random_.power_of_ten(-4.0, -0.5);
        X_AB.translation() = 0.98 * X_AB.translation() + stride * random_.point(1.0);
        X_AB.linear() = (X_AB.linear() * Eigen::AngleAxisd(stride, random_.direction())).eval();
        const double distance = HullOracle(hull_A.vertices(), hull_B.vertices(), X_AB).distance();
        const bool answer = hulls_apart(hull_A, hull_B, X_AB, remembering);
        HullMemory blank;
        ASSERT_EQ(answer, hulls_apart(hull_A, hull_B, X_AB, blank));
        ASSERT_EQ(answer, distance > 0.0) << "step " << step << ", seed " << kSeparatingPlaneSeed;
        if (hulls_apart(hull_A, hull_B, X_AB, perceptron, HullTest::kPerceptron)) {
          ASSERT_TRUE(answer);
        }
        (answer ? apart : meeting)++;
        if (answer) {
          ASSERT_LE(remembering.gap, distance + 1e-12);
        }
      }
    }
  }
  EXPECT_GT(apart, meeting / 5);
  EXPECT_GT(meeting, apart / 5);
}

// The plane fixed to B knows how far B reached before it grew by a hundred millionth.
TEST_F(SeparatingPlanes, MissNoContactWhenThePoseIsNotQuiteARotation) {
  const ConvexHull box(geometry::make_box({2.0, 2.0, 2.0}, 12));
  HullMemory memory;
  Isometry3d X_AB(Eigen::Translation3d(2.0 + 1e-9, 0.3, -0.2));
  ASSERT_TRUE(hulls_apart(box, box, X_AB, memory));
  X_AB.linear() *= 1.0 + 1e-8;
  EXPECT_FALSE(hulls_apart(box, box, X_AB, memory));
}

// The same for what bounding spheres know.
TEST_F(SeparatingPlanes, MissNoContactOfBallsWhenThePoseIsNotQuiteARotation) {
  const ConvexHull sphere(geometry::make_sphere(1.0, 2000));
  std::vector<Vector3d> points;  // with one at the pole, where the other ball comes
  for (const Vector3d& x : sphere.vertices())
    points.insert(points.end(), {x, -x});
  for (const Vector3d& pole : {Vector3d(Vector3d::UnitX()), Vector3d(Vector3d::UnitY()), Vector3d(Vector3d::UnitZ())})
    points.insert(points.end(), {pole, -pole});
  const ConvexHull ball(points);
  HullMemory memory;
  Isometry3d X_AB(Eigen::Translation3d(0.0, 0.0, 2.0 + 1e-9));
  ASSERT_TRUE(hulls_apart(ball, ball, X_AB, memory));
  ASSERT_EQ(memory.loops, 0) << "the spheres are enough";
  EXPECT_LE(memory.gap, 1e-9);
  X_AB.linear() *= 1.0 + 1e-8;
  EXPECT_FALSE(hulls_apart(ball, ball, X_AB, memory));
}

// Balls and boxes at one per cent of distance, which turn by five degrees a step.
TEST_F(SeparatingPlanes, ClearlySeparatedHullsNeedNoIterations) {
  for (const auto& [hull, reach] : {std::pair{ConvexHull(geometry::make_sphere(1.0, 20000)), 1.0},
                                    std::pair{ConvexHull(geometry::make_sphere(1.0, 100)), 1.0},
                                    std::pair{ConvexHull(geometry::make_box({1.0, 1.0, 1.0}, 12)), std::sqrt(0.75)}}) {
    HullMemory memory;
    for (int step = 0; step < 72; step += test_support::kSanitized ? 8 : 1) {
      const double angle = 5.0 * step * std::numbers::pi / 180.0;
      const Isometry3d X_AB = Eigen::Translation3d(2.02 * reach * Vector3d(std::cos(angle), std::sin(angle), 0.0)) *
                              Eigen::AngleAxisd(2.0 * angle, Vector3d::UnitX());
      ASSERT_TRUE(hulls_apart(hull, hull, X_AB, memory));
      ASSERT_EQ(memory.loops, 0) << "step " << step << " of " << hull.vertices().size() << " corners";
      ASSERT_LE(memory.gap, HullOracle(hull.vertices(), hull.vertices(), X_AB).distance());
      ASSERT_GT(memory.gap, 0.0);
    }
  }
}

TEST_F(SeparatingPlanes, HoldForManyStepsOnceFound) {
  const ConvexHull ball(geometry::make_sphere(1.0, 20000));
  HullMemory memory;
  int loops = 0;
  for (int step = 0; step < 1000; ++step) {
    const double angle = 0.05 * step * std::numbers::pi / 180.0;
    const Isometry3d X_AB = Eigen::Translation3d(2.02 * Vector3d(std::cos(angle), std::sin(angle), 0.0)) *
                            Eigen::AngleAxisd(2.0 * angle, Vector3d::UnitZ());
    ASSERT_TRUE(hulls_apart(ball, ball, X_AB, memory));
    loops += memory.loops;
  }
  EXPECT_LT(loops, 50);
}

TEST_F(SeparatingPlanes, AllocateNothing) {
  const ConvexHull ball(geometry::make_sphere(1.0, 2000));
  HullMemory memory;
  if (!test_support::allocations_are_counted()) GTEST_SKIP() << "a sanitizer's allocator cannot be counted";
  const std::int64_t before = test_support::allocations_of_this_thread();
  for (int step = 0; step < 200; ++step)
    hulls_apart(ball, ball, pose(random_.point(2.0)), memory);
  EXPECT_EQ(test_support::allocations_of_this_thread(), before);
}

}  // namespace
}  // namespace glissade::collision
