// Bolt and nut: the nut is free along the helix with its play, no less and hardly more, at every angle.

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include <glissade/collision/dop_query.h>
#include <glissade/geometry/mesh_topology.h>
#include <glissade/shapes/screw_thread.h>

#include "expect_bad_input.h"
#include "sanitizers.h"

namespace glissade::shapes {
namespace {

using Eigen::Isometry3d;
using std::numbers::pi;
using test_support::expect_bad_input;

constexpr double kPlay = 40e-6;

struct Tessellation {
  int segments;
};

class NutOnBolt : public ::testing::TestWithParam<Tessellation> {
 protected:
  ThreadShape bolt() const { return {.turns = 8, .segments = GetParam().segments}; }
  ThreadShape nut() const { return {.turns = 3, .segments = GetParam().segments}; }
  double pitch() const { return bolt().pitch; }

  // Whether the nut collides that was screwed on by `turns`, and pulled up the axis by `pull`.
  bool collides(double turns, double pull) {
    Isometry3d X = Isometry3d::Identity();
    X.linear() = Eigen::AngleAxisd(2 * pi * turns, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    X.translation().z() = pitch() * turns + pull;
    return intersects(bolt_tree_, nut_tree_, X, workspace_);
  }

  double gap(double turns) {
    Isometry3d X = Isometry3d::Identity();
    X.linear() = Eigen::AngleAxisd(2 * pi * turns, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    X.translation().z() = pitch() * turns;
    return collision::distance(bolt_tree_, nut_tree_, X, workspace_).distance;
  }

  collision::DopTree bolt_tree_{std::make_shared<geometry::TriangleMesh>(make_bolt(bolt()))};
  collision::DopTree nut_tree_{std::make_shared<geometry::TriangleMesh>(make_nut(nut(), kPlay))};
  collision::QueryWorkspace workspace_;
};

TEST_P(NutOnBolt, AxialPlayIsConstantOverTheAngle) {
  const double lost_to_straight_edges = 1.3 * pitch() / std::pow(bolt().segments, 3);
  const double at_least = 0.5 * kPlay - lost_to_straight_edges;
  const double at_most = 0.5 * (kPlay + std::tan(pi / 6) * bolt().diameter / 2 * std::pow(pi / bolt().segments, 2));
  constexpr int kAnglesPerTurn = test_support::kSanitized ? 13 : 173;  // primes: all phases of the facets
  for (int i = 0; i <= 4 * kAnglesPerTurn; ++i) {
    const double turns = static_cast<double>(i) / kAnglesPerTurn;
    ASSERT_FALSE(collides(turns, 0.0)) << turns;
    ASSERT_FALSE(collides(turns, at_least)) << turns;
    ASSERT_FALSE(collides(turns, -at_least)) << turns;
    ASSERT_TRUE(collides(turns, at_most)) << turns;
    ASSERT_TRUE(collides(turns, -at_most)) << turns;
  }
}

TEST_P(NutOnBolt, FlankGapMatchesThePlay) {
  const double excess = std::tan(pi / 6) * bolt().diameter / 2 * std::pow(pi / bolt().segments, 2);
  for (const double turns : {0.0, 1.0, 1.3, 2.71}) {
    EXPECT_GT(gap(turns), 0.5 * kPlay * std::cos(pi / 6) - 1e-7);
    EXPECT_LT(gap(turns), 0.5 * (kPlay + excess) * std::cos(pi / 6) + 1e-7);
  }
}

TEST_P(NutOnBolt, OnlyRightHandedScrewMotionIsFree) {
  for (const double turns : {0.1, 0.3, 0.7}) {
    EXPECT_FALSE(collides(2.0 + turns, 0.0));
    EXPECT_TRUE(collides(2.0 + turns, -pitch() * turns)) << "turned without advance";
    EXPECT_TRUE(collides(2.0 - turns, 2 * pitch() * turns)) << "left-handed";
  }
}

TEST_P(NutOnBolt, ItComesOffAtTheEnd) {
  EXPECT_TRUE(collides(3.0, 0.5 * pitch()));
  EXPECT_FALSE(collides(9.1, 0.5 * pitch()));
}

INSTANTIATE_TEST_SUITE_P(Tessellations, NutOnBolt,
                         ::testing::Values(Tessellation{24}, Tessellation{60}, Tessellation{192}),
                         [](const auto& test) { return std::to_string(test.param.segments) + "_segments"; });

TEST(ScrewThread, TheBoltHasTheDiametersOfTheStandard) {
  const ThreadShape shape;
  const geometry::TriangleMesh bolt = make_bolt(shape);
  double inner = 1.0, outer = 0.0;
  for (const Eigen::Vector3d& p : bolt.vertices) {
    inner = std::min(inner, std::hypot(p.x(), p.y()));
    outer = std::max(outer, std::hypot(p.x(), p.y()));
  }
  EXPECT_NEAR(2 * outer, 16e-3, 1e-15);
  EXPECT_NEAR(2 * inner, 13.835e-3, 0.5e-6) << "minor diameter of M16 by ISO 724";
}

TEST(ScrewThread, SurfacesAreConsistentlyOriented) {
  const ThreadShape shape;
  const geometry::MeshReport bolt = geometry::report(make_bolt(shape));
  EXPECT_EQ(bolt.triangles, 8 * shape.segments * shape.turns - 2 * shape.segments);
  EXPECT_EQ(bolt.components, 1);
  EXPECT_EQ(bolt.inconsistent_edges, 0);
  EXPECT_EQ(bolt.nonmanifold_edges, 0);
  EXPECT_EQ(bolt.degenerate, 0);
  const geometry::MeshReport nut = geometry::report(make_nut(shape, kPlay));
  EXPECT_EQ(nut.components, 2);
  EXPECT_EQ(nut.inconsistent_edges, 0);
  EXPECT_EQ(nut.degenerate, 0);
}

TEST(ScrewThread, ErrorsNameTheArgumentAndItsValue) {
  expect_bad_input([] { make_bolt({.diameter = 0.0}); }, {"diameter", "0"});
  expect_bad_input([] { make_bolt({.diameter = 4e-3, .pitch = 2e-3}); }, {"pitch", "diameter", "0.004"});
  expect_bad_input([] { make_bolt({.turns = 0}); }, {"turns", "0"});
  expect_bad_input([] { make_nut({.segments = 64}, kPlay); }, {"segments", "multiple of 12", "64"});
  expect_bad_input([] { make_nut({.segments = 60}, 0.3e-3); }, {"play", "pitch", "0.0003"});
}

}  // namespace
}  // namespace glissade::shapes
