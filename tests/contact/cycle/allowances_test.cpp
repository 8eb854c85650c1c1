// Overlaps at the start, obstacles that give way or have margins of their own, and spiral searches, with their limits.

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/contact/sliding.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/triangle_mesh.h>
#include <glissade/reference/brute_force.h>

#include "held_part.h"
#include "poses.h"
#include "sanitizers.h"
#include "scene/scene_access.h"
#include "sweeps/sliding_scenes.h"

namespace glissade::contact {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::cube;
using test_support::pose;

std::shared_ptr<const geometry::TriangleMesh> box(const Vector3d& size) {
  return std::make_shared<geometry::TriangleMesh>(geometry::make_box(size, 12));
}

/// A block whose upper face is z = 0.
Obstacle block() {
  return {std::make_shared<ContactBody>(box({0.4, 0.4, 0.1})), pose({0.0, 0.0, -0.05}), "the block"};
}

bool overlaps(const Sliding& sliding) {
  for (const PlacedBody& body : scene_of(sliding).bodies().first(scene_of(sliding).obstacles().size())) {
    if (reference::brute_force_intersects(body.body->tree.mesh(), sliding.part().tree.mesh(),
                                          body.X_WB.inverse() * sliding.result().X_WV)) {
      return true;
    }
  }
  return false;
}

TEST(Overlap, IsRefusedUnlessTheRulesDepenetrateIt) {
  EXPECT_THROW(Sliding({block()}, cube(0.02), pose({0.0, 0.0, 0.009})), std::invalid_argument);
  EXPECT_NO_THROW(
      Sliding({block()}, cube(0.02), pose({0.0, 0.0, 0.009}), {.rules = {.overlap = OverlapRule::kDepenetrate}}));
}

TEST(Overlap, APartThatIsHeldStillComesOutAtLimitedSpeedAndStaysOut) {
  Sliding sliding({block()}, cube(0.02), pose({0.0, 0.0, 0.009}), {.rules = {.overlap = OverlapRule::kDepenetrate}});
  const Isometry3d X_WG = sliding.result().X_WG;
  double height = 0.009;
  for (int i = 0; i < 5; ++i) {
    const SlidingResult& result = sliding.advance(X_WG);
    EXPECT_LE(result.X_WV.translation().z() - height, kSlew_m * (1.0 + 1e-9)) << "no jump";
    EXPECT_GT(result.X_WV.translation().z(), height + 0.5 * kSlew_m) << "but out it comes";
    EXPECT_TRUE(std::any_of(result.contacts.begin(), result.contacts.end(),
                            [](const Contact& contact) { return contact.kind == ContactKind::kOverlap; }));
    height = result.X_WV.translation().z();
  }
  for (int i = 0; i < 5; ++i)
    sliding.advance(X_WG);
  EXPECT_FALSE(overlaps(sliding));
  for (int i = 0; i < 20; ++i) {
    sliding.advance(pose({0.001 * i, 0.0, 0.005}));
    EXPECT_FALSE(overlaps(sliding)) << "the block is like any other now";
  }
  EXPECT_NEAR(sliding.result().X_WV.translation().z(), 0.01, 2.0 * sliding.margin());
  EXPECT_NEAR(sliding.result().X_WV.translation().x(), 0.019, 1e-6);
}

TEST(Overlap, DoesNotDeepenAndOtherObstaclesStillBlock) {
  // A second block leaves 0.4 mm of the 1 mm that the way out takes.
  Obstacle lid = block();
  lid.X_WO.translation().z() = 0.05 + 0.0194;
  Sliding sliding({block(), lid}, cube(0.02), pose({0.0, 0.0, 0.009}),
                  {.rules = {.overlap = OverlapRule::kDepenetrate}});
  for (int i = 0; i < 50; ++i) {
    const double z = sliding.advance(pose({0.0, 0.0, -0.02})).X_WV.translation().z();
    EXPECT_GT(z, 0.009 - 1e-6);
    EXPECT_LT(z, 0.0094);
  }
}

TEST(Overlap, RotatingGhostDoesNotDeepenIt) {
  const auto rod = std::make_shared<SlidingPart>(box({0.2, 0.01, 0.01}));
  Sliding sliding({block()}, rod, pose({0.0, 0.0, 0.0049}), {.rules = {.overlap = OverlapRule::kDepenetrate}});
  Isometry3d X_WG = sliding.result().X_WG;
  for (int i = 0; i < 60; ++i) {
    X_WG.linear() = Eigen::AngleAxisd(0.02 * i, Vector3d::UnitY()).toRotationMatrix();
    sliding.advance(X_WG);
    for (const Vector3d& x_V : rod->tree.mesh().vertices)
      ASSERT_GT((sliding.result().X_WV * x_V).z(), -0.1e-3 - 1e-9) << "tick " << i;
  }
  EXPECT_FALSE(overlaps(sliding));
}

TEST(Overlap, IsNoneWherePartsOnlyTouch) {
  for (const double gap : {0.0, 1e-16, -1e-16}) {
    Sliding sliding({block()}, cube(0.02), pose({0.0, 0.0, 0.01 + gap}));
    for (int i = 0; i < 10; ++i)
      sliding.advance(pose({0.001, 0.0, 0.01}));
    EXPECT_NEAR(sliding.result().X_WV.translation().x(), 0.001, 1e-6) << "it slides, and has come off";
    EXPECT_NEAR(sliding.result().X_WV.translation().z(), 0.01 + sliding.margin(), 1e-7);
    EXPECT_FALSE(overlaps(sliding));
  }
}

TEST(GivingWay, WithoutSpringTrianglesAUnitReachesTheFloorAndComesOut) {
  // A bay: a floor, and two springs that reach 0.5 mm into the unit's sides when it is home.
  const geometry::TriangleMesh floor = geometry::make_plate({0.2, 0.2}, 2);
  std::vector<geometry::TriangleMesh> meshes{floor};
  for (const double side : {1.0, -1.0})
    meshes.push_back(
        geometry::transformed(geometry::make_box({0.004, 0.01, 0.01}, 12), pose({side * 0.0115, 0.0, 0.01})));
  const auto bay = std::make_shared<ContactBody>(std::make_shared<geometry::TriangleMesh>(geometry::merge(meshes)));
  const Eigen::AlignedBox3d springs(Vector3d(-0.02, -0.01, 0.001), Vector3d(0.02, 0.01, 0.02));
  Obstacle obstacle{bay, Isometry3d::Identity(), "the bay"};

  const auto depth_reached = [&] {
    Sliding sliding({obstacle}, cube(0.02), pose({0.0, 0.0, 0.03}));
    for (int i = 0; i <= 100; ++i)
      sliding.advance(pose({0.0, 0.0, 0.03 - 0.0003 * i}));
    const double depth = sliding.result().X_WV.translation().z();
    for (int i = 0; i <= 100; ++i)
      sliding.advance(pose({0.0, 0.0, 0.0003 * i}));
    EXPECT_EQ(sliding.result().state, SlidingState::kFree) << "out again";
    return depth;
  };
  EXPECT_NEAR(depth_reached(), 0.025, 1e-4) << "without an allowance it stops on the springs";
  const std::vector<std::int32_t> giving_way = geometry::triangles_inside(bay->tree.mesh(), springs);
  EXPECT_EQ(giving_way.size(), 24u);
  obstacle.body = std::make_shared<ContactBody>(
      std::make_shared<geometry::TriangleMesh>(geometry::without_triangles(bay->tree.mesh(), giving_way)));
  EXPECT_NEAR(depth_reached(), 0.01, 1e-5) << "with it the floor holds, as exactly as ever";
}

TEST(Margin, ObstacleMarginReplacesThePartMargin) {
  const auto height = [](std::optional<double> margin) {
    Obstacle obstacle = block();
    obstacle.margin = margin;
    Sliding sliding({obstacle}, cube(0.02), pose({0.0, 0.0, 0.011}));
    for (int i = 0; i < 30; ++i)
      sliding.advance(pose({0.0, 0.0, 0.005}));
    return sliding.result().X_WV.translation().z() - 0.01;
  };
  EXPECT_NEAR(height(std::nullopt), 2e-6, 1e-8) << "the least default";
  EXPECT_NEAR(height(0.2e-6), 0.2e-6, 1e-9);
  EXPECT_NEAR(height(50e-6), 50e-6, 1e-8);
}

TEST(Margin, TooLargeIsRefused) {
  Obstacle obstacle = block();
  obstacle.margin = 0.3e-3;
  EXPECT_THROW(Sliding({obstacle}, cube(0.02), pose({0.0, 0.0, 0.011})), std::invalid_argument);
  EXPECT_THROW(Sliding({block()}, cube(0.02), pose({0.0, 0.0, 0.011}), {.rules = {.margin = 0.3e-3}}),
               std::invalid_argument);
}

TEST(SpiralSearch, InsertsTiltedPegsThatJamWithoutIt) {
  if (test_support::kSanitized) GTEST_SKIP() << "takes minutes under a sanitizer";
  const auto depth_reached = [](bool spiral_search, const test_support::PegTrial& trial) {
    const test_support::SlidingScene scene = test_support::peg_scene(trial);
    Sliding sliding(scene.obstacles, scene.part_V, scene.X_WV_start, {.rules = {.spiral_search = spiral_search}});
    for (int tick = 1; tick <= scene.ticks + 2000; ++tick)  // a spiral search lasts two seconds
      sliding.advance(scene.ghost(tick));
    return -sliding.result().X_WV.translation().z();
  };
  int without = 0;
  int with = 0;
  constexpr std::uint64_t kPegs = 4;
  for (std::uint64_t seed = 1; seed <= kPegs; ++seed) {
    const test_support::PegTrial trial{.offset = 1e-3, .tilt = 1.5 * std::numbers::pi / 180.0, .seed = seed};
    without += depth_reached(false, trial) > 7e-3 ? 1 : 0;
    with += depth_reached(true, trial) > 7e-3 ? 1 : 0;
  }
  EXPECT_EQ(with, static_cast<int>(kPegs));
  EXPECT_GT(with, without);
}

TEST(SpiralSearch, IsForgottenWhenTheHandLetsGo) {
  Sliding sliding({block()}, cube(0.02), pose({0.0, 0.0, 0.011}),
                  {.metaphor = Metaphor::kRubberBandSpring, .rules = {.spiral_search = true}});
  for (int i = 0; i < 1900; ++i)
    sliding.advance(pose({0.0, 0.0, 0.005}));
  sliding.release();
  const Isometry3d X_WV = sliding.result().X_WV;
  sliding.grasp(X_WV);
  EXPECT_EQ(sliding.advance(X_WV).X_WV.matrix(), X_WV.matrix());
}

TEST(SpiralSearch, DoesNotDeflectAPartThatFollows) {
  const auto last = [](bool spiral_search) {
    Sliding sliding({block()}, cube(0.02), pose({0.0, 0.0, 0.011}), {.rules = {.spiral_search = spiral_search}});
    for (int i = 0; i < 500; ++i)
      sliding.advance(pose({1e-5 * i, 0.0, 0.005}));
    return sliding.result().X_WV;
  };
  EXPECT_EQ(last(true).matrix(), last(false).matrix());
}

}  // namespace
}  // namespace glissade::contact
