// Riders: bodies that stand in the way of parts, or move with a part as the hand that holds it does.

#include <array>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/contact/multi_part_sliding.h>
#include <glissade/reference/brute_force.h>

#include "held_part.h"
#include "poses.h"
#include "scene/scene_access.h"

namespace glissade::contact {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::cube;
using test_support::pose;
using test_support::turn;
using test_support::wall;

constexpr double kMarginOfRider_m = 20e-6;

/// A cube of 40 mm at the origin, a wall at x = 0.1 m, and a chain of one cube of 20 mm.
class CubeAndRider : public ::testing::Test {
 protected:
  MultiPartSliding sliding_{{wall(0.1)}, {{.part_V = cube(0.04)}}, {}, {{{cube(0.02)}, kMarginOfRider_m}}};

  Isometry3d X_WV() const { return sliding_.result(0).X_WV; }
  Isometry3d X_WRider() const { return scene_of(sliding_).bodies()[2].X_WB; }

  void place(double x, double y, double z) {
    const std::array X_WB{pose({x, y, z})};
    sliding_.place_riders(0, X_WB);
  }
  void lead(const Isometry3d& X_WG, int calls) {
    const Isometry3d X_start = sliding_.result(0).X_WG;
    for (int i = 1; i <= calls; ++i) {
      const std::array ghost{test_support::between(X_start, X_WG, static_cast<double>(i) / calls)};
      sliding_.advance(ghost);
    }
    for (int i = 0; i < 50; ++i)
      sliding_.advance(std::array{X_WG});
  }
};

TEST_F(CubeAndRider, NothingTouchesARiderBeforeItIsPlaced) {
  lead(pose({0.05, 0.0, 0.0}), 100);
  EXPECT_EQ(X_WV().translation().x(), 0.05);
}

TEST_F(CubeAndRider, AStandingRiderStopsAPart) {
  place(0.06, 0.0, 0.0);
  lead(pose({0.05, 0.0, 0.0}), 100);
  EXPECT_NEAR(X_WV().translation().x(), 0.06 - 0.01 - 0.02, 2.0 * kMarginOfRider_m);
  ASSERT_FALSE(sliding_.result(0).contacts.empty());
  EXPECT_EQ(sliding_.result(0).contacts.front().obstacle, 2);
  EXPECT_EQ(sliding_.result(0).contacts.front().rider, -1);
  EXPECT_LT(sliding_.result(0).contacts.front().n_W.x(), -0.99) << "from the rider to the part";
}

TEST_F(CubeAndRider, AnAttachedRiderMovesWithThePartAndStopsItAtAWall) {
  place(0.035, 0.0, 0.0);
  sliding_.attach(0, 0);
  const Isometry3d X_VRider = X_WV().inverse() * X_WRider();
  lead(pose({0.09, 0.03, 0.0}, turn(0.02, Vector3d::UnitZ())), 100);
  EXPECT_TRUE(X_WRider().isApprox(X_WV() * X_VRider, 1e-12));
  EXPECT_LT(X_WV().translation().x(), 0.1 - 0.045 + 1e-3);
  EXPECT_GT(X_WV().translation().x(), 0.1 - 0.045 - 2e-3) << "the rider's corner is at the wall";
  EXPECT_GT(X_WV().translation().y(), 0.025) << "it slides along the wall";
  const geometry::TriangleMesh& rider = scene_of(sliding_).bodies()[2].body->tree.mesh();
  const geometry::TriangleMesh& obstacle = scene_of(sliding_).bodies()[0].body->tree.mesh();
  EXPECT_FALSE(
      reference::brute_force_intersects(rider, obstacle, X_WRider().inverse() * scene_of(sliding_).bodies()[0].X_WB));
  ASSERT_GT(sliding_.result(0).pushing, 0);
  for (const Contact& contact : sliding_.result(0).contacts) {
    if (contact.force > 0.0) {
      EXPECT_EQ(contact.rider, 0);
    }
  }
}

TEST_F(CubeAndRider, ADetachedRiderStaysWhereItIs) {
  place(0.0, 0.0, 0.035);
  sliding_.attach(0, 0);
  lead(pose({0.0, 0.02, 0.0}), 50);
  sliding_.detach(0);
  const Isometry3d X_WRider_left = X_WRider();
  lead(pose({0.0, 0.03, 0.0}), 50);
  EXPECT_EQ(X_WRider().matrix(), X_WRider_left.matrix());
  lead(pose({0.0, 0.03, 0.03}), 50);
  EXPECT_LT(X_WV().translation().z(), 0.006) << "it is in the way again";
  sliding_.remove_riders(0);
  lead(pose({0.0, 0.03, 0.03}), 200);
  EXPECT_EQ(X_WV().translation().z(), 0.03);
}

TEST_F(CubeAndRider, ARiderFarFromThePartLimitsItsTurns) {
  // The rider sits 95 mm to the side: a turn of the part swings it into the wall.
  place(0.02, 0.095, 0.0);
  sliding_.attach(0, 0);
  lead(pose({0.0, 0.0, 0.0}, turn(-1.4, Vector3d::UnitZ())), 400);
  const geometry::TriangleMesh& rider = scene_of(sliding_).bodies()[2].body->tree.mesh();
  const geometry::TriangleMesh& obstacle = scene_of(sliding_).bodies()[0].body->tree.mesh();
  EXPECT_FALSE(
      reference::brute_force_intersects(rider, obstacle, X_WRider().inverse() * scene_of(sliding_).bodies()[0].X_WB));
  EXPECT_NEAR((X_WRider().translation() - X_WV().translation()).norm(), std::hypot(0.02, 0.095), 1e-9);
  EXPECT_GT(sliding_.result(0).pushing, 0);
}

// Hands may come into each other: nothing stops them.
TEST(Riders, OverlappingRidersOfTwoChainsDoNotBlockAPart) {
  MultiPartSliding sliding({wall(0.1)}, {{.part_V = cube(0.04)}}, {},
                           {{{cube(0.02)}, kMarginOfRider_m}, {{cube(0.02)}, kMarginOfRider_m}});
  sliding.place_riders(0, std::array{pose({0.0, 0.0, 0.035})});
  sliding.place_riders(1, std::array{pose({0.005, 0.0, 0.04})});
  sliding.attach(0, 0);
  for (int i = 1; i <= 100; ++i)
    sliding.advance(std::array{pose({0.0, 1e-4 * i, 0.0})});
  EXPECT_NEAR(sliding.result(0).X_WV.translation().y(), 0.01, 1e-9);
}

TEST(Riders, OfAHeldPartPushAnotherPart) {
  const std::vector<HeldPart> parts{
      {.part_V = cube(0.04), .stiffness = CouplingStiffness{3000.0, 3.0}},
      {.part_V = cube(0.04), .X_WV_start = pose({0.0665, 0.0, 0.0}), .stiffness = CouplingStiffness{1000.0, 1.0}}};
  MultiPartSliding sliding({}, parts, {}, {{{cube(0.02)}, kMarginOfRider_m}});
  sliding.place_riders(0, std::array{pose({0.035, 0.0, 0.0})});
  sliding.attach(0, 0);
  const Isometry3d still = parts[1].X_WV_start;
  for (int i = 1; i <= 200; ++i)
    sliding.advance(std::array{pose({std::min(i, 100) * 0.1e-3, 0.0, 0.0}), still});
  // The ghosts overlap by 8.5 mm, which the springs share 1 to 3.
  EXPECT_NEAR(sliding.result(1).X_WV.translation().x() - still.translation().x(), 0.75 * 8.5e-3, 0.1e-3);
  EXPECT_NEAR(sliding.result(0).X_WV.translation().x(), 0.01 - 0.25 * 8.5e-3, 0.1e-3);
  bool mirrored = false;
  for (const Contact& contact : sliding.result(1).contacts)
    mirrored = mirrored || (contact.obstacle == 2 && contact.rider == -1 && contact.force > 0.0);
  EXPECT_TRUE(mirrored) << "the second part sees the rider";
}

}  // namespace
}  // namespace glissade::contact
