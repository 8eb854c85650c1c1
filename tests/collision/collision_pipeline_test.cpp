#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/collision/collision_pipeline.h>
#include <glissade/collision/dop_query.h>
#include <glissade/collision/dop_tree.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/triangle_mesh.h>

#include "poses.h"

namespace glissade::collision {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::at;
using testing::ElementsAre;
using testing::IsEmpty;

// Boxes of one metre on a long shelf.
class Pipeline : public testing::Test {
 protected:
  struct Shape {
    explicit Shape(const geometry::TriangleMesh& m)
        : tree(std::make_shared<DopTree>(std::make_shared<geometry::TriangleMesh>(m))),
          hull(std::make_shared<ConvexHull>(m)) {}
    std::shared_ptr<const DopTree> tree;
    std::shared_ptr<const ConvexHull> hull;
  };

  ObjectId add(const Isometry3d& X_WO, int group = 0) { return add(box_, X_WO, group); }
  ObjectId add(const Shape& shape, const Isometry3d& X_WO, int group = 0) {
    return world_.add({shape.tree, shape.hull, X_WO, group});
  }

  const Shape box_{geometry::make_box({1.0, 1.0, 1.0}, 48)};
  realtime::SteadyClock clock_;
  World world_{64};
};

TEST_F(Pipeline, TellsWhichObjectsMeet) {
  CollisionPipeline pipeline(world_, clock_);
  EXPECT_EQ(pipeline.result().frame, 0U);
  const ObjectId left = add(at(0.0));
  const ObjectId middle = add(at(0.9));
  const ObjectId right = add(at(2.0));
  EXPECT_THAT(pipeline.step().meeting, ElementsAre(ObjectPair{left, middle}));
  EXPECT_EQ(pipeline.result().frame, 1U);

  ASSERT_TRUE(world_.move(middle, at(1.1)));
  EXPECT_THAT(pipeline.step().meeting, ElementsAre(ObjectPair{middle, right}));
  ASSERT_TRUE(world_.move(middle, at(1.0)));
  EXPECT_THAT(pipeline.step().meeting, ElementsAre(ObjectPair{left, middle}, ObjectPair{middle, right}))
      << "touching counts";
  EXPECT_THAT(pipeline.step().meeting, ElementsAre(ObjectPair{left, middle}, ObjectPair{middle, right}))
      << "nobody has moved";
}

TEST_F(Pipeline, ReusedSlotReportsTheNewObject) {
  CollisionPipeline pipeline(world_, clock_);
  const ObjectId a = add(at(0.0));
  const ObjectId b = add(at(0.5));
  pipeline.step();
  world_.remove(b);
  EXPECT_THAT(pipeline.step().meeting, IsEmpty());

  const ObjectId c = add(at(0.5));
  ASSERT_EQ(c.index, b.index);
  EXPECT_THAT(pipeline.step().meeting, ElementsAre(ObjectPair{a, c}));
  world_.remove(c);
  const ObjectId d = add(at(-0.5));
  ASSERT_EQ(d.index, c.index);
  EXPECT_THAT(pipeline.step().meeting, ElementsAre(ObjectPair{a, d})) << "in the same frame";
}

TEST_F(Pipeline, LeavesOutPairsOfNoInterest) {
  CollisionPipeline pipeline(world_, clock_);
  const ObjectId finger = add(at(0.0), 1);
  const ObjectId next_finger = add(at(0.8), 1);
  const ObjectId part = add(at(0.4), 2);
  world_.disable_groups(1, 1);
  EXPECT_THAT(pipeline.step().meeting, ElementsAre(ObjectPair{finger, part}, ObjectPair{next_finger, part}));
  world_.disable_pair(part, finger);
  EXPECT_THAT(pipeline.step().meeting, ElementsAre(ObjectPair{next_finger, part}));
  EXPECT_EQ(pipeline.result().report.exact.in, 0) << "an answer that is known needs no query";
  world_.enable_pair(finger, part);
  world_.enable_groups(1, 1);
  EXPECT_THAT(pipeline.step().meeting,
              ElementsAre(ObjectPair{finger, next_finger}, ObjectPair{finger, part}, ObjectPair{next_finger, part}));
}

TEST_F(Pipeline, OnlyMovedObjectsCostWork) {
  CollisionPipeline pipeline(world_, clock_);
  for (int i = 0; i < 20; ++i)
    add(at(0.9 * i));
  const ObjectId last = add(at(0.9 * 20));
  const FrameReport first = pipeline.step().report;
  EXPECT_EQ(first.objects, 21);
  EXPECT_EQ(first.queue.in, 21);
  EXPECT_EQ(first.exact.out, 20);

  const FrameReport at_rest = pipeline.step().report;
  EXPECT_EQ(at_rest.queue.in, 0);
  EXPECT_EQ(at_rest.neighbor_finding.out, 0);
  EXPECT_EQ(at_rest.exact.in, 0);
  EXPECT_EQ(at_rest.neighbors, first.neighbors) << "they are still remembered";
  EXPECT_EQ(pipeline.result().meeting.size(), 20U);

  ASSERT_TRUE(world_.move(last, at(0.9 * 20 + 0.01)));
  const FrameReport one_moved = pipeline.step().report;
  EXPECT_EQ(one_moved.queue.out, 1);
  EXPECT_EQ(one_moved.exact.in, 1);
  EXPECT_EQ(one_moved.exact.out, 1);
}

TEST_F(Pipeline, LooksAtASeparatedPairAgainOnlyWhenItsGapMayBeUsedUp) {
  CollisionPipeline pipeline(world_, clock_);
  const ObjectId a = add(at(0.0));
  const ObjectId b = add(at(1.1));
  pipeline.step();
  ASSERT_EQ(pipeline.result().report.separating_planes.in, 1);
  int looked = 0;
  for (int i = 1; i <= 100; ++i) {
    ASSERT_TRUE(world_.move(b, at(1.1, 0.001 * i)));
    pipeline.step();
    EXPECT_EQ(pipeline.result().report.neighbor_finding.out, 1);
    looked += static_cast<int>(pipeline.result().report.separating_planes.in);
  }
  EXPECT_EQ(looked, 0) << "who goes sideways uses up nothing";
  ASSERT_TRUE(world_.move(b, at(1.05, 0.1)));
  EXPECT_EQ(pipeline.step().report.separating_planes.in, 0) << "a gap of 100 mm lasts for 50";
  // Straight on, and it is found out in time.
  ASSERT_TRUE(world_.move(b, at(1.0000001, 0.1)));
  EXPECT_THAT(pipeline.step().meeting, IsEmpty());
  ASSERT_TRUE(world_.move(b, at(0.9999999, 0.1)));
  EXPECT_THAT(pipeline.step().meeting, ElementsAre(ObjectPair{a, b}));
}

// The tip moves as far as turning can take any point.
TEST_F(Pipeline, DetectsContactOfARotatingRodTip) {
  CollisionPipeline pipeline(world_, clock_);
  const ObjectId box = add(at(1.45, 0.55));  // from (0.95, 0.05) on
  const ObjectId rod = add(Shape(geometry::make_box({2.0, 0.001, 0.001}, 48)), at(0.0));
  EXPECT_THAT(pipeline.step().meeting, IsEmpty());
  for (int step = 1; step <= 60; ++step) {
    const double angle = 0.001 * step;
    ASSERT_TRUE(world_.move(rod, at(0.0) * Eigen::AngleAxisd(angle, Vector3d::UnitZ())));
    const double tip = std::sin(angle) + 0.0005 * std::cos(angle);
    ASSERT_EQ(pipeline.step().meeting.size(), tip >= 0.05 ? 1U : 0U) << "at " << angle;
  }
  EXPECT_THAT(pipeline.result().meeting, ElementsAre(ObjectPair{box, rod}));
}

// Lengths in the frame of an object are not quite those in the world, which counts over a large distance.
TEST_F(Pipeline, LargeQueryDistanceMatchesTheSingleQuery) {
  Isometry3d X_WA = at(0.0);
  X_WA.linear()(0, 0) = 1.0 - 4.9e-13;  // as good as a rotation
  int meeting = 0;
  for (int i = -100; i < 100; ++i) {
    World world(2);
    CollisionPipeline pipeline(world, clock_, {.greatest_distance = 100.0, .threads = 1});
    const ObjectId a = world.add({.tree = box_.tree, .hull = box_.hull, .X_WO = X_WA});
    const ObjectId b = world.add({.tree = box_.tree, .hull = box_.hull, .X_WO = at(1.2)});
    pipeline.step();
    ASSERT_TRUE(world.move(b, at(100.0 + 1e-12 * i)));
    pipeline.step();
    QueryWorkspace workspace;
    const bool meet = intersects(*box_.tree, *box_.tree,
                                 relative_pose(world.objects()[a.index], world.objects()[b.index]), workspace, 99.0);
    ASSERT_EQ(pipeline.step(99.0).meeting.size(), meet ? 1U : 0U) << i;
    meeting += meet ? 1 : 0;
  }
  EXPECT_GT(meeting, 100);
  EXPECT_LT(meeting, 200);
}

TEST_F(Pipeline, DetectsContactByRotationInPlace) {
  CollisionPipeline pipeline(world_, clock_);
  const ObjectId a = add(at(0.0));
  const ObjectId b = add(at(1.2));
  EXPECT_THAT(pipeline.step().meeting, IsEmpty());
  for (int degrees = 1; degrees < 45; ++degrees) {
    const double angle = degrees * std::numbers::pi / 180.0;
    ASSERT_TRUE(world_.move(b, at(1.2) * Eigen::AngleAxisd(angle, Vector3d::UnitZ())));
    // Where the foremost corner is.
    const bool meet = 1.2 - std::sqrt(0.5) * std::cos(std::numbers::pi / 4.0 - angle) <= 0.5;
    ASSERT_EQ(pipeline.step().meeting.size(), meet ? 1U : 0U) << degrees << " degrees";
  }
  EXPECT_THAT(pipeline.result().meeting, ElementsAre(ObjectPair{a, b}));
}

// As poses that have been through single precision. Far from its origin, an object would move by much.
TEST_F(Pipeline, TakesTheNearestRotationForAMatrixThatIsNotQuiteOne) {
  const double c = 10.0;
  const Shape far_from_its_origin(geometry::transformed(geometry::make_box({1.0, 1.0, 1.0}, 48), at(c)));
  CollisionPipeline pipeline(world_, clock_);
  const ObjectId a = add(far_from_its_origin, at(-c));
  const ObjectId b = add(at(-1.0001));
  for (const double scale : {1.0, 1.0 + 1.5e-5, 1.0 - 1.5e-5, 1.0 + 1e-7}) {
    Isometry3d X_WA = at(-c);
    X_WA.linear() = scale * Eigen::AngleAxisd(1e-9, Vector3d::UnitZ()).toRotationMatrix();
    ASSERT_TRUE(world_.move(a, X_WA));
    EXPECT_THAT(pipeline.step().meeting, IsEmpty()) << "0.1 mm apart";
    const Eigen::Matrix3d R = world_.objects()[a.index].X_WO.linear();
    EXPECT_LT((R.transpose() * R - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    X_WA.translation().x() = -c - 0.0002;
    ASSERT_TRUE(world_.move(a, X_WA));
    EXPECT_THAT(pipeline.step().meeting, ElementsAre(ObjectPair{a, b}));
  }
}

// The sum of all motions is then so large that a short step is less than its last digit.
TEST_F(Pipeline, ShortStepsAfterLargeMotionsAreNotLost) {
  CollisionPipeline pipeline(world_, clock_);
  add(at(0.0));
  const ObjectId b = add(at(1.001));
  for (const double far : {1e8, -1e8, 1e8, -1e8}) {
    ASSERT_TRUE(world_.move(b, at(far)));
    pipeline.step();
  }
  for (int i = 0; i < 3000; ++i) {
    const double x = 1.001 - 1e-6 * i;
    ASSERT_TRUE(world_.move(b, at(x)));
    const bool meets = !pipeline.step().meeting.empty();
    ASSERT_EQ(meets, x <= 1.0) << "at " << x;
  }
}

TEST_F(Pipeline, TouchingBallsFarFromTheOriginMatchTheSingleQuery) {
  // Their centres are rounded on another way than the poses that queries see.
  const Shape ball(geometry::transformed(geometry::make_sphere(0.01, 200), at(3.0)));
  QueryWorkspace workspace;
  int meeting = 0;
  for (const double far : {0.0, 1e3, 1e6}) {
    for (int i = 0; i < 100; ++i) {
      World world(2);
      CollisionPipeline pipeline(world, clock_);
      Isometry3d X_WA = at(far, 0.3 * far, 0.7 * far);
      X_WA.linear() = Eigen::AngleAxisd(0.1 * i, Vector3d(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
      world.add({ball.tree, ball.hull, X_WA, 0});
      world.add({ball.tree, ball.hull, X_WA * at(0.0, 0.0, 0.02), 0});
      const bool meets = !pipeline.step().meeting.empty();
      const Isometry3d X_AB = relative_pose(world.objects()[0], world.objects()[1]);
      EXPECT_EQ(meets, intersects(*ball.tree, *ball.tree, X_AB, workspace)) << "turned by " << 0.1 * i << " at " << far;
      meeting += meets ? 1 : 0;
    }
  }
  EXPECT_GT(meeting, 20) << "some touch, some just do not";
  EXPECT_LT(meeting, 280);
}

TEST_F(Pipeline, GivesTheTrianglesThatMeet) {
  PipelineOptions options{.query = PairQuery::kTrianglePairs, .threads = 1};
  CollisionPipeline pipeline(world_, clock_, options);
  add(at(0.0));
  add(at(0.9));
  add(at(0.95, 0.9));
  const FrameResult& result = pipeline.step();
  ASSERT_EQ(result.meeting.size(), 3U);
  QueryWorkspace workspace;
  std::vector<TrianglePair> expected;
  for (std::size_t i = 0; i < result.meeting.size(); ++i) {
    const auto [a, b] = result.meeting[i];
    intersecting_pairs(*box_.tree, *box_.tree, relative_pose(world_.objects()[a.index], world_.objects()[b.index]),
                       workspace, expected);
    EXPECT_FALSE(expected.empty());
    EXPECT_EQ(std::vector(result.triangle_pairs(i).begin(), result.triangle_pairs(i).end()), expected);
    EXPECT_THAT(result.close_pairs(i), IsEmpty());
  }
}

TEST_F(Pipeline, DistanceOfClosePairsMayChangePerFrame) {
  CollisionPipeline pipeline(world_, clock_, {.query = PairQuery::kClosePairs, .greatest_distance = 0.2, .threads = 1});
  add(at(0.0));
  add(at(1.15));
  EXPECT_THAT(pipeline.step(0.14).meeting, IsEmpty());
  const FrameResult& result = pipeline.step(0.16);
  ASSERT_EQ(result.meeting.size(), 1U);
  ASSERT_FALSE(result.close_pairs(0).empty());
  for (const ClosePair& pair : result.close_pairs(0)) {
    EXPECT_GE(pair.distance, 0.15 - 1e-12);
    EXPECT_LE(pair.distance, 0.16);
  }
  EXPECT_THAT(pipeline.step(0.1).meeting, IsEmpty());
  EXPECT_THAT(pipeline.step(0.2).meeting.size(), 1U);
}

TEST_F(Pipeline, SelectionsApplyOnlyIfBothObjectsHaveOne) {
  CollisionPipeline pipeline(world_, clock_, {.query = PairQuery::kClosePairs, .greatest_distance = 0.2, .threads = 1});
  const geometry::TriangleMesh& mesh = box_.tree->mesh();
  const auto faces_up = [&](std::int32_t t) {  // on the side that the others, to the left and right, are not near
    return std::min({mesh.corner(t, 0).z(), mesh.corner(t, 1).z(), mesh.corner(t, 2).z()}) > 0.49;
  };
  const auto top = std::make_shared<TriangleSelection>(*box_.tree, faces_up);
  const auto nothing = std::make_shared<TriangleSelection>(*box_.tree, [](std::int32_t) { return false; });
  const ObjectId a = world_.add({box_.tree, box_.hull, at(0.0), 0, top});
  const ObjectId b = world_.add({box_.tree, box_.hull, at(1.05), 0, nothing});
  const ObjectId c = world_.add({box_.tree, box_.hull, at(2.1), 0, nothing});
  const ObjectId d = world_.add({box_.tree, box_.hull, at(3.15), 0});
  const FrameResult& result = pipeline.step(0.1);
  EXPECT_THAT(result.meeting, ElementsAre(ObjectPair{a, b}, ObjectPair{c, d})) << "b and c have nothing to meet with";
  ASSERT_EQ(result.meeting.size(), 2U);
  ASSERT_FALSE(result.close_pairs(0).empty());
  for (const ClosePair& pair : result.close_pairs(0))
    EXPECT_TRUE(faces_up(pair.triangles.triangle_A));
  std::vector<ClosePair> all;
  QueryWorkspace workspace;
  pairs_within(*box_.tree, *box_.tree, relative_pose(world_.objects()[c.index], world_.objects()[d.index]), 0.1,
               workspace, all);
  EXPECT_EQ(result.close_pairs(1).size(), all.size()) << "d has none, so all of it counts";
}

TEST_F(Pipeline, NeedsNoHulls) {
  CollisionPipeline pipeline(world_, clock_);
  const ObjectId a = world_.add({box_.tree, nullptr, at(0.0), 0});
  const ObjectId b = add(at(1.01));
  EXPECT_THAT(pipeline.step().meeting, IsEmpty());
  ASSERT_TRUE(world_.move(a, at(0.05)));
  EXPECT_THAT(pipeline.step().meeting, ElementsAre(ObjectPair{a, b}));
}

TEST_F(Pipeline, ReportsTheTimeOfPosesAndSumsReports) {
  realtime::SimulatedClock clock;
  clock.advance(std::chrono::seconds(7));
  CollisionPipeline pipeline(world_, clock);
  const FrameResult& result = pipeline.step();
  EXPECT_EQ(result.time_of_poses, std::chrono::seconds(7)) << "by the clock it was given";
  EXPECT_EQ(result.age(std::chrono::seconds(9)), std::chrono::seconds(2));
  FrameReport sum;
  sum += result.report;
  sum += result.report;
  EXPECT_EQ(sum.total, 2 * result.report.total);
}

TEST_F(Pipeline, RefusesInvalidOptionsAndDistances) {
  EXPECT_THROW(CollisionPipeline(world_, clock_, {.greatest_distance = -1.0}), std::invalid_argument);
  EXPECT_THROW(CollisionPipeline(world_, clock_, {.greatest_distance = std::nan("")}), std::invalid_argument);
  EXPECT_THROW(CollisionPipeline(world_, clock_, {.threads = -1}), std::invalid_argument);
  CollisionPipeline pipeline(world_, clock_, {.greatest_distance = 0.1});
  EXPECT_THROW(pipeline.step(0.11), std::invalid_argument);
  EXPECT_THROW(pipeline.step(-0.01), std::invalid_argument);
  EXPECT_THROW(pipeline.step(std::nan("")), std::invalid_argument);
  EXPECT_NO_THROW(pipeline.step(0.1));
}

}  // namespace
}  // namespace glissade::collision
