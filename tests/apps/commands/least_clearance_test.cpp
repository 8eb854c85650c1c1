/// The least clearance of a run against a full search at every pose, and the work that it saves.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/apps/commands/least_clearance.h>
#include <glissade/apps/files/scene_file.h>
#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/apps/view/clearance_curve.h>
#include <glissade/collision/dop_query.h>
#include <glissade/contact/sliding.h>

#include "random_numbers.h"

namespace glissade::apps {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

Isometry3d pose(const Vector3d& p, const Eigen::Quaterniond& q = Eigen::Quaterniond::Identity()) {
  return Eigen::Translation3d(p) * q;
}

HapticScene scene_of(const std::string& objects, const std::vector<std::string>& parts = {"part"}) {
  return make_haptic_scene(parse_scene("objects:\n" + objects, "scene", "."), parts);
}

/// Whether the part is within `distance` of any other object, by a search of its own.
bool is_within(double distance, const HapticScene& scene, const Isometry3d& X_WV,
               std::span<const Isometry3d> moving_X_WB) {
  collision::QueryWorkspace workspace;
  const auto reaches = [&](const contact::ContactBody& body, const Isometry3d& X_WB) {
    return collision::intersects(body.tree, scene.parts.front().part_V->tree, X_WB.inverse(Eigen::Isometry) * X_WV,
                                 workspace, distance);
  };
  bool any = false;
  for (const contact::Obstacle& obstacle : scene.obstacles)
    any = any || reaches(*obstacle.body, obstacle.X_WO);
  for (std::size_t i = 0; i < scene.moving.size(); ++i)
    any = any || reaches(*scene.moving[i].part_B, moving_X_WB[i]);
  return any;
}

/// Notes poses, and compares with full searches at each of them.
class Comparison {
 public:
  explicit Comparison(const HapticScene& scene) : scene_(scene), clearance_(scene) {}

  void note(const Isometry3d& X_WV, const std::vector<Isometry3d>& moving_X_WB = {},
            std::span<const contact::Contact> contacts = {}) {
    clearance_.note(X_WV, moving_X_WB, contacts);
    poses_.push_back({X_WV, moving_X_WB});
  }

  ClearanceWork finish() {
    clearance_.finish();
    if (std::isinf(least())) return clearance_.work();
    const Poses& nearest = poses_[static_cast<std::size_t>(clearance_.least_at())];
    EXPECT_TRUE(is_within(least() + kRounding_m, scene_, nearest.X_WV, nearest.moving_X_WB));
    const bool any_nearer = std::any_of(poses_.begin(), poses_.end(), [&](const Poses& poses) {
      return is_within(std::max(0.0, least() - kRounding_m), scene_, poses.X_WV, poses.moving_X_WB);
    });
    EXPECT_EQ(any_nearer, least() == 0.0);
    return clearance_.work();
  }

  double least() const { return clearance_.least(); }

 private:
  static constexpr double kRounding_m = 1e-12;
  struct Poses {
    Isometry3d X_WV;
    std::vector<Isometry3d> moving_X_WB;
  };
  const HapticScene& scene_;
  LeastClearance clearance_;
  std::vector<Poses> poses_;
};

constexpr const char* kThings =
    "  - {name: part, movable: true, shape: {type: torus, major_radius_m: 0.06, minor_radius_m: 0.02, triangles: "
    "600}}\n"
    "  - {name: ball, shape: {type: sphere, radius_m: 0.05, triangles: 500}, pose: {position_m: [0.2, 0, 0]}}\n"
    "  - {name: box, shape: {type: box, size_x_m: 0.2, size_y_m: 0.1, size_z_m: 0.1, triangles: 300}, pose: "
    "{position_m: [0, 0.25, 0.05]}}\n"
    "  - {name: far, shape: {type: box}, pose: {position_m: [3, 0, 0]}}\n";

TEST(LeastClearance, IsThatOfAFullSearchAtEveryPose) {
  const HapticScene scene = scene_of(kThings);
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test_support::RandomNumbers random(seed);
    Comparison comparison(scene);
    // Steps from a micrometre to ten millimetres, as of hands that rest, feel their way and hurry.
    const double length = random.power_of_ten(-6, -2);
    Vector3d p = random.point(0.02);
    Eigen::Quaterniond q(random.rotation());
    for (int tick = 0; tick < 150; ++tick) {
      p += length * (random.direction() + (tick < 75 ? 0.5 : -0.5) * Vector3d(1.0, 1.0, 0.2));
      q = Eigen::Quaterniond(Eigen::AngleAxisd(random.uniform(0.0, 10.0 * length), random.direction())) * q;
      comparison.note(pose(p, q.normalized()));
    }
    comparison.finish();
  }
}

TEST(LeastClearance, CountsTheMotionOfObjectsThatMoveOnTheirOwn) {
  HapticScene scene = scene_of(kThings);
  scene.moving.push_back({std::make_shared<const contact::SlidingPart>(
                              std::make_shared<const geometry::TriangleMesh>(scene.parts.front().part_V->tree.mesh())),
                          geometry::PoseTrajectory({{std::chrono::nanoseconds(0), Isometry3d::Identity()}})});
  Comparison comparison(scene);
  for (int tick = 0; tick < 200; ++tick) {
    const double t = 0.01 * tick;
    comparison.note(pose({0.0, 0.0, 0.01 * t}), {pose({-0.3 + 0.1 * t, 0.0, 0.02 * t})});
  }
  comparison.finish();
  EXPECT_LT(comparison.least(), 0.05) << "the moving one is the nearest";
}

TEST(LeastClearance, IsInfiniteOfAPartThatNeverComesNear) {
  const HapticScene scene = scene_of(kThings);
  Comparison comparison(scene);
  for (int tick = 0; tick < 20; ++tick)
    comparison.note(pose({-8.0 + 0.01 * tick, 0.01 * tick, 0.0}));
  EXPECT_EQ(comparison.finish().listed, 0);
  EXPECT_EQ(comparison.least(), std::numeric_limits<double>::infinity());
  Comparison nearer(scene);
  for (int tick = 0; tick < 20; ++tick)
    nearer.note(pose({-0.6, 0.0, 0.001 * tick}));
  nearer.finish();
  EXPECT_GT(nearer.least(), 0.4);
  EXPECT_LT(nearer.least(), LeastClearance::kFarthest * scene.parts.front().part_V->radius());
}

// Far away, and for a part that moves by much of its size in a step, almost all pairs of triangles are as near as the
// nearest.
TEST(LeastClearance, ListsFewPairsFarAwayAndAtAnySpeed) {
  const HapticScene scene = scene_of(
      "  - {name: part, movable: true, shape: {type: box, triangles: 1200}}\n"
      "  - {name: plate, shape: {type: plate, size_x_m: 0.3, size_y_m: 0.3, triangles: 1200}}\n");
  for (const double step : {0.0, 1e-5, 1e-3, 1e-2}) {
    for (const double height : {0.1, 0.5, 3.0, 500.0}) {
      SCOPED_TRACE("from " + std::to_string(height) + " m by " + std::to_string(step));
      Comparison comparison(scene);
      for (int tick = 0; tick < 10 && step * tick < height - 0.06; ++tick)
        comparison.note(pose({0.0, 0.0, height - step * tick}));
      const ClearanceWork work = comparison.finish();
      EXPECT_LT(work.listed, 30'000);
      EXPECT_LE(work.searches, 40);
    }
  }
}

TEST(LeastClearance, IsZeroOfWhatOverlaps) {
  const HapticScene scene = scene_of(kThings);
  Comparison comparison(scene);
  comparison.note(pose({0.0, 0.0, 0.0}));
  comparison.note(pose({0.2, 0.0, 0.03}));
  comparison.finish();
  EXPECT_EQ(comparison.least(), 0.0);
}

constexpr const char* kBoxOnFloor =
    "  - {name: part, movable: true, shape: {type: box, size_x_m: 0.1, size_y_m: 0.06, size_z_m: 0.04, triangles: "
    "600}}\n"
    "  - {name: floor, shape: {type: plate, size_x_m: 0.5, size_y_m: 0.5, triangles: 900}}\n";
constexpr int kTicks = 500;

/// The box goes over the floor, 0.2 mm each tick, as this height says.
template <typename Height>
ClearanceWork work_over_the_floor(const Height& height) {
  const HapticScene scene = scene_of(kBoxOnFloor);
  LeastClearance clearance(scene);
  for (int tick = 0; tick < kTicks; ++tick)
    clearance.note(pose({2e-4 * tick, 0.0, 0.02 + height(tick)}), {}, {});
  clearance.finish();
  return clearance.work();
}

TEST(LeastClearance, SearchesOnceForManyPosesOfAPartThatSlides) {
  // Ever lower by less than a rounding error of a search with volumes: the least is that of the last pose.
  const ClearanceWork work = work_over_the_floor([](int tick) { return 10e-6 - 1e-9 * tick; });
  EXPECT_LT(work.searches, kTicks / 10);
  EXPECT_LT(work.triangle_distances, 5 * kTicks);
  EXPECT_LT(work.directions, 50 * kTicks);
}

TEST(LeastClearance, SearchesOnceAStepAtMostWhileAPartComesNearer) {
  const ClearanceWork work = work_over_the_floor([](int tick) { return 1e-4 * (kTicks - tick); });
  EXPECT_LE(work.searches, kTicks);
  EXPECT_LT(work.listed, 50 * kTicks);
  EXPECT_LT(work.directions, 50 * kTicks);
}

TEST(LeastClearance, DoesNothingForAPartThatRests) {
  const HapticScene scene = scene_of(kBoxOnFloor);
  LeastClearance clearance(scene);
  for (int tick = 0; tick < kTicks; ++tick)
    clearance.note(pose({0.0, 0.0, 0.0201}), {}, {});
  clearance.finish();
  EXPECT_LE(clearance.work().searches, 2);
  EXPECT_NEAR(clearance.least(), 1e-4, 1e-12);
}

TEST(LeastClearance, LaterContactsMakeEarlierDistancesNeedless) {
  const HapticScene scene = scene_of(kBoxOnFloor);
  const auto trajectory = [](int tick) { return pose({1e-3 * tick, 0.0, std::max(0.019, 0.3 - 1e-3 * tick)}); };
  contact::Sliding sliding(scene.obstacles, scene.parts.front().part_V, trajectory(0), {});
  Comparison comparison(scene);
  for (int tick = 0; tick < 300; ++tick) {
    sliding.advance(trajectory(tick), tick == 0 ? 0.0 : 1.0);
    comparison.note(sliding.result().X_WV, {}, sliding.result().contacts);
  }
  const ClearanceWork work = comparison.finish();
  EXPECT_LT(comparison.least(), 2e-5);
  EXPECT_LT(work.searches, 150) << "of 300 poses";
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

TEST(ClearanceCurve, IsThatOfEachPartAmongTheOthers) {
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

TEST(ClearanceCurve, IsThatOfAFullSearchAtEveryMoment) {
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
      const double least = std::isnan(series.y[i]) ? ClearanceCurve::kFarthest_m : 1e-6 * series.y[i];
      const std::span<const Isometry3d> moving(&X_WM[i], 1);
      if (least < ClearanceCurve::kFarthest_m) {
        ++near;
        EXPECT_TRUE(is_within(least + 1e-12, scene, X_WV[i], moving)) << i;
      }
      if (least > 0.0) {
        EXPECT_FALSE(is_within(least - 1e-12, scene, X_WV[i], moving)) << i;
      }
    }
    EXPECT_GT(near, 10);
  }
}

TEST(ClearanceCurve, OfAPartWithContactsIsThatWithoutThem) {
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
