/// The curve of a clearance against the clearance of each pose alone.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/apps/files/scene_file.h>
#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/apps/view/clearance_curve.h>
#include <glissade/contact/sliding.h>
#include <glissade/simulation/least_clearance.h>

#include "poses.h"
#include "random_numbers.h"

namespace glissade::apps {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::pose;

HapticScene scene_of(const std::string& objects, const std::vector<std::string>& parts = {"part"}) {
  return make_haptic_scene(parse_scene("objects:\n" + objects, "scene", "."), parts);
}

TEST(ClearanceCurve, IsTheGapOfABoxAboveAPlate) {
  const HapticScene scene = scene_of(
      "  - {name: part, movable: true, shape: {type: box, size_x_m: 0.02, size_y_m: 0.02, size_z_m: 0.02}}\n"
      "  - {name: plate, shape: {type: plate, size_x_m: 0.5, size_y_m: 0.5}}\n");
  ClearanceCurve curve(scene, 1500);
  for (int i = 0; i < 1500; ++i)
    curve.note(std::chrono::milliseconds(i), pose({0.0, 0.0, 0.01 + 2e-6 * i}), {}, {});
  const PlotSeries series = curve.take("way");
  ASSERT_EQ(series.x.size(), 500u) << "one of three";
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const double gap_um = 2e3 * series.x[i];
    EXPECT_NEAR(series.x[i], 3e-3 * static_cast<double>(i), 1e-9);
    if (gap_um < 2e3 - 1.0) {
      EXPECT_NEAR(series.y[i], gap_um, 1e-6) << i;
    }
    if (gap_um > 2e3 + 1.0) {
      EXPECT_TRUE(std::isnan(series.y[i])) << i;
    }
  }
}

TEST(ClearanceCurve, EachPartIsMeasuredToTheOthers) {
  const std::string box = ", movable: true, shape: {type: box, size_x_m: 0.02, size_y_m: 0.02, size_z_m: 0.02}}\n";
  const HapticScene scene = scene_of("  - {name: left" + box + "  - {name: right" + box +
                                         "  - {name: plate, shape: {type: plate, size_x_m: 0.5, size_y_m: 0.5}}\n",
                                     {"left", "right"});
  ClearanceCurve left(scene, 10, 0);
  ClearanceCurve right(scene, 10, 1);
  for (int i = 0; i < 10; ++i) {
    const Isometry3d X_WLeft = pose({0.0, 0.0, 0.01 + 0.3e-3});
    const Isometry3d X_WRight = pose({0.02 + 0.1e-3 * i, 0.0, 0.01 + 0.5e-3});
    left.note(std::chrono::milliseconds(i), X_WLeft, std::span(&X_WRight, 1));
    right.note(std::chrono::milliseconds(i), X_WRight, std::span(&X_WLeft, 1));
  }
  const PlotSeries of_left = left.take("left");
  const PlotSeries of_right = right.take("right");
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_NEAR(of_left.y[i], std::min(100.0 * static_cast<double>(i), 300.0), 1e-6) << "the right box, then the plate";
    EXPECT_NEAR(of_right.y[i], std::min(100.0 * static_cast<double>(i), 500.0), 1e-6) << "the left box, then the plate";
  }
}

constexpr const char* kBoxOnFloor =
    "  - {name: part, movable: true, shape: {type: box, size_x_m: 0.1, size_y_m: 0.06, size_z_m: 0.04, triangles: "
    "600}}\n"
    "  - {name: floor, shape: {type: plate, size_x_m: 0.5, size_y_m: 0.5, triangles: 900}}\n";
TEST(ClearanceCurve, IsSearchedAtMost500Times) {
  const HapticScene scene = scene_of(kBoxOnFloor);
  const auto searches = [&](int poses) {
    ClearanceCurve curve(scene, poses);
    for (int i = 0; i < poses; ++i)
      curve.note(std::chrono::milliseconds(i), pose({0.0, 0.0, 0.03}), {}, {});
    return curve.take("way").x.size();
  };
  EXPECT_EQ(searches(1), 1u);
  EXPECT_EQ(searches(500), 500u);
  EXPECT_EQ(searches(501), 251u);
  EXPECT_EQ(searches(999), 500u);
  EXPECT_EQ(searches(1001), 334u);
}

constexpr const char* kThings =
    "  - {name: part, movable: true, shape: {type: torus, major_radius_m: 0.06, minor_radius_m: 0.02, triangles: "
    "600}}\n"
    "  - {name: ball, shape: {type: sphere, radius_m: 0.05, triangles: 500}, pose: {position_m: [0.2, 0, 0]}}\n"
    "  - {name: box, shape: {type: box, size_x_m: 0.2, size_y_m: 0.1, size_z_m: 0.1, triangles: 300}, pose: "
    "{position_m: [0, 0.25, 0.05]}}\n"
    "  - {name: far, shape: {type: box}, pose: {position_m: [3, 0, 0]}}\n";

TEST(ClearanceCurve, EqualsTheClearanceOfEachPoseAlone) {
  HapticScene scene = scene_of(kThings);
  scene.moving.push_back({std::make_shared<const contact::SlidingPart>(
                              std::make_shared<const geometry::TriangleMesh>(scene.parts.front().part_V->tree.mesh())),
                          geometry::PoseTrajectory({{std::chrono::nanoseconds(0), Isometry3d::Identity()}})});
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test_support::RandomNumbers random(seed);
    constexpr int kPoses = 100;
    ClearanceCurve curve(scene, kPoses);
    std::vector<Isometry3d> X_WV;
    std::vector<Isometry3d> X_WM;
    // From one body to another, so that the nearest one changes, and with leaps between neighboring poses.
    Eigen::Quaterniond q(random.rotation());
    for (int i = 0; i < kPoses; ++i) {
      const double turn = 0.1 * i;
      const Vector3d p =
          Vector3d(0.06 + 0.06 * std::cos(turn), 0.08 + 0.08 * std::sin(turn), 0.0) + random.point(0.003);
      q = Eigen::Quaterniond(Eigen::AngleAxisd(random.uniform(0.0, 0.2), random.direction())) * q;
      X_WV.push_back(pose(p, q.normalized()));
      X_WM.push_back(pose({-0.1 + 0.001 * i, -0.05, 0.02}));
      curve.note(std::chrono::milliseconds(i), X_WV.back(), std::span(&X_WM.back(), 1), {});
    }
    const PlotSeries series = curve.take("way");
    ASSERT_EQ(series.y.size(), X_WV.size());
    int near = 0;
    for (std::size_t i = 0; i < X_WV.size(); ++i) {
      simulation::LeastClearance alone(scene);
      alone.note(X_WV[i], std::span(&X_WM[i], 1), {});
      alone.finish();
      if (std::isnan(series.y[i])) {
        EXPECT_GE(alone.least(), ClearanceCurve::kFarthest_m) << i;
      } else {
        ++near;
        EXPECT_NEAR(1e-6 * series.y[i], alone.least(), 1e-12) << i;
      }
    }
    EXPECT_GT(near, 10);
  }
}

TEST(ClearanceCurve, IsUnchangedByGivenContacts) {
  const HapticScene scene = scene_of(
      "  - {name: part, movable: true, shape: {type: box, size_x_m: 0.02, size_y_m: 0.02, size_z_m: 0.02}}\n"
      "  - {name: plate, shape: {type: plate, size_x_m: 0.5, size_y_m: 0.5}}\n"
      "  - {name: wall, shape: {type: box}, pose: {position_m: [0.060008, 0, 0.06]}}\n");
  contact::Contact contact{};
  contact.kind = contact::ContactKind::kFaceVertex;
  contact.obstacle = contact.obstacle_triangle = contact.part_triangle = 0;
  contact.n_W = Eigen::Vector3d::UnitZ();
  contact.p_W = Eigen::Vector3d::Zero();
  ClearanceCurve with(scene, 100);
  ClearanceCurve without(scene, 100);
  for (int i = 0; i < 100; ++i) {
    // Sinks to the plate, and moves away from the wall, which is nearer at first.
    const Eigen::Isometry3d X_WV = pose({-0.2e-6 * i, 0.0, 0.01 + 30e-6 - 0.29e-6 * i});
    contact.gap = X_WV.translation().z() - 0.01;
    with.note(std::chrono::milliseconds(i), X_WV, {}, std::vector{contact});
    without.note(std::chrono::milliseconds(i), X_WV, {}, {});
  }
  const PlotSeries faster = with.take("way");
  const PlotSeries slower = without.take("way");
  ASSERT_EQ(faster.y.size(), slower.y.size());
  for (std::size_t i = 0; i < faster.y.size(); ++i)
    EXPECT_NEAR(faster.y[i], slower.y[i], 1e-6) << i;
  EXPECT_NEAR(faster.y.front(), 8.0, 1e-3) << "the wall";
  EXPECT_NEAR(faster.y.back(), 30.0 - 0.29 * 99, 1e-3) << "the plate";
}

}  // namespace
}  // namespace glissade::apps
