// The check of paths that the torture of sliding relies on: it must see what goes through, and prove what does not.

#include "swept_check.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/geometry/displacement.h>
#include <glissade/geometry/mesh_generators.h>

#include "poses.h"

namespace glissade::test_support {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using geometry::Displacement;
using geometry::TriangleMesh;

std::vector<contact::Obstacle> obstacles_of(const geometry::TriangleMesh& mesh) {
  return {{std::make_shared<contact::ContactBody>(std::make_shared<geometry::TriangleMesh>(mesh))}};
}

const geometry::TriangleMesh kSheet = geometry::make_plate({0.2, 0.2}, 50);

TEST(SweptCheck, SeesASheetGoThroughAnotherThoughNeitherEndCollides) {
  SweptCheck check(obstacles_of(kSheet), geometry::make_plate({0.05, 0.05}, 8), Vector3d::Zero());
  const Isometry3d above = pose({0.0, 0.0, 1e-3});
  EXPECT_TRUE(check.fault_of(above, {{0.0, 0.0, -2e-3}, Vector3d::Zero()}));
  EXPECT_TRUE(check.fault_of(above, {{0.05, 0.0, -2e-3}, {0.01, 0.0, 0.0}}));
  EXPECT_FALSE(check.fault_of(above, {{0.05, 0.0, -0.999e-3}, Vector3d::Zero()}));
  EXPECT_FALSE(check.fault_of(above, {{0.0, 0.0, 1.0}, Vector3d::Zero()}));
}

TEST(SweptCheck, DetectsACollisionInMidRotation) {
  // A rod of 0.2 m beside a needle; turned by 90° its end passes 1 µm before or behind the needle's tip.
  const geometry::TriangleMesh rod{{{-0.1, 0.0, 0.0}, {0.1, 0.0, 0.0}, {0.1, 0.0, 1e-3}}, {{0, 1, 2}}};
  for (const double sign : {1.0, -1.0}) {
    const double reach = (0.1 + sign * 1e-6) / std::sqrt(2.0);
    const geometry::TriangleMesh needle{{{reach, reach, 0.5e-3}, {0.2, 0.2, 0.0}, {0.2, 0.2, 1e-3}}, {{0, 1, 2}}};
    SweptCheck check(obstacles_of(needle), rod, Vector3d::Zero());
    const geometry::Displacement quarter{Vector3d::Zero(), {0.0, 0.0, std::numbers::pi / 2}};
    EXPECT_EQ(check.fault_of(Isometry3d::Identity(), quarter).has_value(), sign < 0.0);
    EXPECT_FALSE(check.fault_of(Isometry3d::Identity(), quarter.scaled(0.4)));
  }
}

TEST(SweptCheck, ProvesLongWaysOverAFaceANanometreAway) {
  SweptCheck check(obstacles_of(kSheet), geometry::make_box({0.05, 0.05, 0.02}, 108), Vector3d::Zero());
  EXPECT_FALSE(check.fault_of(pose({-0.05, 0.0, 0.01 + 1e-9}), {{0.1, 0.02, 0.0}, {0.0, 0.0, 0.3}}));
  EXPECT_TRUE(check.fault_of(pose({-0.05, 0.0, 0.01 + 1e-9}), {{0.1, 0.02, 0.0}, {1e-6, 0.0, 0.3}}));
}

TEST(SweptCheck, TellsDistancesAndTheirPoints) {
  SweptCheck check(obstacles_of(kSheet), geometry::make_box({0.05, 0.05, 0.02}, 12), Vector3d::Zero());
  EXPECT_NEAR(check.distance(pose({0.0, 0.0, 0.01 + 3e-6}), 1e-3), 3e-6, 1e-15);
  EXPECT_EQ(check.distance(pose({0.0, 0.0, 0.1}), 1e-3), 1e-3);
  EXPECT_EQ(check.distance(pose({0.0, 0.0, 0.0}), 1e-3), 0.0);
  const auto& near = check.near_pairs(pose({0.0, 0.0, 0.01 + 3e-6}), 4e-6, 1000);
  ASSERT_FALSE(near.empty());
  for (const SweptCheck::NearPair& pair : near) {
    EXPECT_NEAR((pair.p_part - pair.p_obstacle).norm(), pair.distance, 1e-15);
    EXPECT_NEAR(pair.p_obstacle.z(), 0.0, 1e-15);
  }
  EXPECT_EQ(check.near_pairs(pose({0.0, 0.0, 0.01 + 3e-6}), 4e-6, 2).size(), 2);
}

}  // namespace
}  // namespace glissade::test_support
