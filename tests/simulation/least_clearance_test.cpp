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

#include <glissade/collision/dop_query.h>
#include <glissade/contact/sliding.h>
#include <glissade/simulation/least_clearance.h>
#include <glissade/simulation/scene.h>
#include <glissade/simulation/simulation.h>

#include "poses.h"
#include "random_numbers.h"

namespace glissade::simulation {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::pose;

SceneBodies scene_of(const std::string& objects, const std::vector<std::string>& parts = {"part"}) {
  return bodies_of(parse_scene("objects:\n" + objects, "scene", "."), parts);
}

/// Whether the part is within `distance` of any other object, by a search of its own.
bool is_within(double distance, const SceneBodies& scene, const Isometry3d& X_WV,
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
  explicit Comparison(const SceneBodies& scene) : scene_(scene), clearance_(scene) {}

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
  const SceneBodies& scene_;
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

TEST(LeastClearance, EqualsAFullSearchAtEveryPose) {
  const SceneBodies scene = scene_of(kThings);
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
  SceneBodies scene = scene_of(kThings);
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
  const SceneBodies scene = scene_of(kThings);
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
  const SceneBodies scene = scene_of(
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
  const SceneBodies scene = scene_of(kThings);
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
  const SceneBodies scene = scene_of(kBoxOnFloor);
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
  const SceneBodies scene = scene_of(kBoxOnFloor);
  LeastClearance clearance(scene);
  for (int tick = 0; tick < kTicks; ++tick)
    clearance.note(pose({0.0, 0.0, 0.0201}), {}, {});
  clearance.finish();
  EXPECT_LE(clearance.work().searches, 2);
  EXPECT_NEAR(clearance.least(), 1e-4, 1e-12);
}

TEST(LeastClearance, LaterContactsMakeEarlierDistancesNeedless) {
  const SceneBodies scene = scene_of(kBoxOnFloor);
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

TEST(LeastClearance, EachPartOfASimulationIsMeasuredToTheOthers) {
  const Scene scene = parse_scene(
      "objects:\n"
      "  - {name: left, movable: true, shape: {type: box, size_x_m: 0.02, size_y_m: 0.02, size_z_m: 0.02}}\n"
      "  - {name: right, movable: true, shape: {type: box, size_x_m: 0.02, size_y_m: 0.02, size_z_m: 0.02}, pose: "
      "{position_m: [0.022, 0, 0]}}\n"
      "  - {name: plate, shape: {type: plate, size_x_m: 0.5, size_y_m: 0.5}, pose: {position_m: [0, 0, -0.011]}}\n",
      "scene", ".");
  Simulation simulation(scene);
  LeastClearance of_left(simulation.bodies(), 0);
  LeastClearance of_right(simulation.bodies(), 1);
  for (int ms = 0; ms < 50; ++ms) {
    const std::vector<Isometry3d> ghosts{Isometry3d::Identity(), pose({0.022 - 2e-5 * ms, 0.0, 0.0})};
    simulation.advance(ghosts);
    of_left.note(simulation);
    of_right.note(simulation);
  }
  of_left.finish();
  of_right.finish();
  const double gap = simulation.X_WV(1).translation().x() - 0.02;
  EXPECT_NEAR(gap, 1.02e-3, 1e-6);
  EXPECT_NEAR(of_left.least(), 1e-3, 1e-12) << "the plate";
  EXPECT_NEAR(of_right.least(), 1e-3, 1e-12) << "the plate";
  for (int ms = 0; ms < 20; ++ms) {
    simulation.advance(std::vector<Isometry3d>{Isometry3d::Identity(), pose({0.0205, 0.0, 0.0})});
    of_left.note(simulation);
  }
  of_left.finish();
  EXPECT_NEAR(of_left.least(), simulation.X_WV(1).translation().x() - 0.02, 1e-12) << "the other box";
}

}  // namespace
}  // namespace glissade::simulation
