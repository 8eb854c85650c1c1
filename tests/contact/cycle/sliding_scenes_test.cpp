// The scenes that tests and benchmarks of sliding share: they start free, the ghost comes from there without jumps and
// goes into something, and each is the same whenever it is made.

#include "sweeps/sliding_scenes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/collision/dop_query.h>
#include <glissade/contact/sliding.h>
#include <glissade/geometry/displacement.h>

#include "sanitizers.h"

namespace glissade::contact {
namespace {

using namespace test_support;
using Eigen::Isometry3d;

bool collides(const SlidingScene& scene, const Isometry3d& X_WV) {
  collision::QueryWorkspace workspace;
  return std::any_of(scene.obstacles.begin(), scene.obstacles.end(), [&](const Obstacle& obstacle) {
    return intersects(obstacle.body->tree, scene.part_V->tree, obstacle.X_WO.inverse() * X_WV, workspace);
  });
}

class SlidingScenes : public ::testing::TestWithParam<std::string> {};

TEST_P(SlidingScenes, StartFreeAndTheGhostGoesIntoSomething) {
  const SlidingScene scene = make_sliding_scene(GetParam());
  EXPECT_EQ(scene.name, GetParam());
  EXPECT_EQ(scene.ghost(0).matrix(), scene.X_WV_start.matrix());
  EXPECT_EQ(scene.ghost(scene.ticks + 1000).matrix(), scene.ghost(scene.ticks).matrix());
  EXPECT_FALSE(collides(scene, scene.X_WV_start));
  int inside = 0;
  for (int i = 0; i <= 20; ++i)
    inside += collides(scene, scene.ghost(i * scene.ticks / 20)) ? 1 : 0;
  EXPECT_GT(inside, 0);
}

TEST_P(SlidingScenes, TheGhostDoesNotJump) {
  const SlidingScene scene = make_sliding_scene(GetParam());
  const SlidingPart& part = *scene.part_V;
  for (int tick = 1; tick <= scene.ticks; ++tick) {
    const geometry::Displacement d =
        geometry::displacement_between(scene.ghost(tick - 1), scene.ghost(tick), part.p_Vref());
    ASSERT_LE(geometry::motion_bound(d, part.radius()), 6e-3) << "tick " << tick;
  }
}

TEST_P(SlidingScenes, AreTheSameWheneverTheyAreMade) {
  const SlidingScene a = make_sliding_scene(GetParam());
  const SlidingScene b = make_sliding_scene(GetParam());
  ASSERT_EQ(a.obstacles.size(), b.obstacles.size());
  for (std::size_t i = 0; i < a.obstacles.size(); ++i) {
    EXPECT_EQ(a.obstacles[i].X_WO.matrix(), b.obstacles[i].X_WO.matrix());
    EXPECT_EQ(a.obstacles[i].body->tree.mesh().vertices, b.obstacles[i].body->tree.mesh().vertices);
  }
  EXPECT_EQ(a.part_V->tree.mesh().vertices, b.part_V->tree.mesh().vertices);
  for (int tick = 0; tick < a.ticks; tick += 37)
    ASSERT_EQ(a.ghost(tick).matrix(), b.ghost(tick).matrix());
}

/// The largest take a sanitizer half a minute to make, in the same way as the next smaller ones.
std::vector<std::string> affordable_scene_names() {
  std::vector<std::string> names = sliding_scene_names();
  if (kSanitized) std::erase_if(names, [](const std::string& name) { return name.ends_with("_50k"); });
  return names;
}

INSTANTIATE_TEST_SUITE_P(ByName, SlidingScenes, ::testing::ValuesIn(affordable_scene_names()),
                         [](const auto& test) { return test.param; });

TEST(SlidingScene, ANutFollowsTheThread) {
  if (test_support::kSanitized) GTEST_SKIP() << "takes minutes under a sanitizer";
  const SlidingScene scene = nut_scene();
  Sliding sliding(scene.obstacles, scene.part_V, scene.X_WV_start);
  for (int tick = 1; tick <= 100; ++tick)
    sliding.advance(scene.ghost(tick));
  // A tenth of a turn on a pitch of 2 mm, within the play of 40 µm and what the flanks' facets add to it.
  EXPECT_NEAR(nut_advance(scene, sliding.result().X_WV), 0.2e-3, 53e-6);
}

TEST(SlidingScene, UnitReachesItsSeatOnlyIfTheTonguesGiveWay) {
  if (kSanitized) GTEST_SKIP() << "takes half a minute under a sanitizer";
  for (const bool tongues_give_way : {true, false}) {
    const SlidingScene scene = bay_scene(tongues_give_way);
    Sliding sliding(scene.obstacles, scene.part_V, scene.X_WV_start);
    double deepest = -1.0;
    for (int tick = 1; tick <= scene.ticks; ++tick)
      deepest = std::max(deepest, sliding.advance(scene.ghost(tick)).X_WV.translation().y());
    EXPECT_EQ(deepest > -2.0 * sliding.margin(), tongues_give_way);
    EXPECT_EQ(sliding.result().state, SlidingState::kFree) << "it is out again";
  }
}

TEST(SlidingScene, LedThroughGoesStraightAndTurnsEvenly) {
  Isometry3d X_end(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX()));
  X_end.translation() = Eigen::Vector3d(1.0, 2.0, 3.0);
  const auto ghost = led_through({{10, Isometry3d::Identity()}, {20, X_end}});
  EXPECT_EQ(ghost(0).matrix(), Isometry3d::Identity().matrix());
  EXPECT_TRUE(ghost(13).translation().isApprox(Eigen::Vector3d(0.3, 0.6, 0.9), 1e-15));
  EXPECT_NEAR(Eigen::AngleAxisd(ghost(13).linear()).angle(), 0.15, 1e-15);
  EXPECT_THROW(led_through({}), std::invalid_argument);
  EXPECT_THROW(led_through({{5, X_end}, {5, X_end}}), std::invalid_argument);
}

TEST(SlidingScene, UnknownNamesAreErrors) {
  EXPECT_THROW(make_sliding_scene("bowl"), std::invalid_argument);
}

}  // namespace
}  // namespace glissade::contact
