// Sliding with the collision detection in a thread of its own: every bit is what it is without.

#include "search/search_thread.h"

#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/contact/multi_part_sliding.h>
#include <glissade/contact/sliding.h>
#include <glissade/geometry/mesh_generators.h>

#include "held_part.h"
#include "poses.h"
#include "random_numbers.h"
#include "sanitizers.h"
#include "search/candidate_search.h"
#include "sweeps/sliding_scenes.h"

namespace glissade::contact {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::pose;
using test_support::turn;

/// All that a call answers, as numbers.
std::vector<double> bits_of(const SlidingResult& result) {
  std::vector<double> numbers(result.X_WV.matrix().data(), result.X_WV.matrix().data() + 16);
  numbers.insert(numbers.end(), result.X_WT.matrix().data(), result.X_WT.matrix().data() + 16);
  numbers.insert(numbers.end(),
                 {1.0 * static_cast<int>(result.state), 1.0 * result.cycles, 1.0 * result.pushing, result.reach});
  for (const Contact& contact : result.contacts) {
    numbers.insert(numbers.end(), {1.0 * static_cast<int>(contact.kind), 1.0 * contact.obstacle, contact.gap,
                                   contact.force, contact.n_W.x(), contact.n_W.y(), contact.n_W.z(),
                                   contact.friction_W.x(), contact.friction_W.y(), contact.friction_W.z()});
  }
  return numbers;
}

/// The same simulation twice, without and with a search thread; each call goes to both and must be answered alike.
class Twins {
 public:
  Twins(const std::vector<Obstacle>& obstacles, const std::vector<HeldPart>& parts, SlidingRules rules = {})
      : without_(obstacles, parts, rules), with_(obstacles, parts, with_thread(rules)) {}

  void grasp(std::size_t part, const Isometry3d& X_WG) {
    without_.grasp(part, X_WG);
    with_.grasp(part, X_WG);
  }
  void release(std::size_t part) {
    without_.release(part);
    with_.release(part);
  }
  void advance(std::span<const Isometry3d> X_WG) {
    without_.advance(X_WG);
    with_.advance(X_WG);
    for (std::size_t p = 0; p < without_.part_count(); ++p) {
      ASSERT_EQ(bits_of(with_.result(p)), bits_of(without_.result(p))) << "part " << p;
      pushed_ += without_.result(p).pushing > 0 ? 1 : 0;
    }
    ASSERT_EQ(with_.search_statistics().searches, without_.search_statistics().searches);
  }

  const SlidingResult& result(std::size_t part) const { return without_.result(part); }
  /// Answers in which contacts pushed.
  int pushed() const { return pushed_; }
  std::int64_t searches() const { return without_.search_statistics().searches; }

 private:
  static SlidingRules with_thread(SlidingRules rules) {
    rules.has_search_thread = true;
    return rules;
  }

  MultiPartSliding without_;
  MultiPartSliding with_;
  int pushed_ = 0;
};

class SearchThreadInScene : public ::testing::TestWithParam<std::string> {};

TEST_P(SearchThreadInScene, ChangesNoBit) {
  const test_support::SlidingScene scene = test_support::make_sliding_scene(GetParam());
  Twins twins(scene.obstacles, {{.part_V = scene.part_V, .X_WV_start = scene.X_WV_start}}, {.contacts_ahead_ms = 4.0});
  // Where the ghost has come to something in most of them.
  for (int tick = 1; tick <= test_support::affordable(1500); ++tick) {
    const Isometry3d X_WG = scene.ghost(tick);
    ASSERT_NO_FATAL_FAILURE(twins.advance({&X_WG, 1})) << "tick " << tick;
  }
  if (test_support::kSanitized) return;
  EXPECT_GT(twins.pushed(), 0);
  EXPECT_GT(twins.searches(), 1);
}

INSTANTIATE_TEST_SUITE_P(ByName, SearchThreadInScene,
                         ::testing::Values("clutter", "corner", "gear", "groove", "light_10k", "peg", "plane",
                                           "sheets"),
                         [](const auto& test) { return test.param; });

/// A block whose upper face is z = 0.
Obstacle finely_cut_block() {
  return test_support::obstacle_of(geometry::make_box({0.4, 0.4, 0.1}, 300), pose({0.0, 0.0, -0.05}));
}

std::shared_ptr<const SlidingPart> finely_cut_cube() {
  return test_support::part_of(geometry::make_box({0.02, 0.02, 0.02}, 48));
}

/// Somewhere about the block's upper face, also below it.
Isometry3d random_ghost(test_support::RandomNumbers& random) {
  return pose({random.uniform(-0.03, 0.03), random.uniform(-0.03, 0.03), random.uniform(-0.01, 0.03)},
              turn(random.uniform(-1.0, 1.0), random.direction()));
}

TEST(SearchThread, ChangesNoBitWhereAPartDepenetrates) {
  const Isometry3d X_WV = pose({0.0, 0.0, 0.005});
  Twins twins({finely_cut_block()}, {{.part_V = finely_cut_cube(), .X_WV_start = X_WV}},
              {.overlap = OverlapRule::kDepenetrate});
  for (int i = 0; i < 200; ++i) {
    const Isometry3d X_WG = pose({2e-4 * i, 0.0, 0.004}, turn(0.002 * i, Vector3d::UnitZ()));
    ASSERT_NO_FATAL_FAILURE(twins.advance({&X_WG, 1})) << "tick " << i;
  }
  EXPECT_GT(twins.result(0).X_WV.translation().z(), 0.01) << "it is out";
}

TEST(SearchThread, ChangesNoBitWhereHandsLetGoAndTakeHold) {
  constexpr std::uint64_t kSeed = 71;
  RecordProperty("seed", static_cast<int>(kSeed));
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  test_support::RandomNumbers random(kSeed);
  Twins twins({finely_cut_block()}, {{.part_V = finely_cut_cube(), .X_WV_start = pose({0.0, 0.0, 0.015})}},
              {.friction = {.at_rest = 0.4, .sliding = 0.2}});
  Isometry3d X_from = pose({0.0, 0.0, 0.015});
  for (int leg = 0; leg < 20; ++leg) {
    const Isometry3d X_to = random_ghost(random);
    for (int i = 1; i <= 50; ++i) {
      const Isometry3d X_WG = test_support::between(X_from, X_to, i / 50.0);
      ASSERT_NO_FATAL_FAILURE(twins.advance({&X_WG, 1})) << "leg " << leg << ", tick " << i;
    }
    X_from = X_to;
    if (!random.chance(0.5)) continue;
    twins.release(0);
    ASSERT_NO_FATAL_FAILURE(twins.advance({&X_to, 1}));
    X_from = random_ghost(random);
    twins.grasp(0, X_from);
  }
  EXPECT_GT(twins.pushed(), 10);
}

TEST(SearchThread, ChangesNoBitOfSeveralParts) {
  constexpr std::uint64_t kSeed = 72;
  RecordProperty("seed", static_cast<int>(kSeed));
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  test_support::RandomNumbers random(kSeed);
  const std::array starts{pose({-0.03, 0.0, 0.02}), pose({0.0, 0.0, 0.02}), pose({0.03, 0.0, 0.02})};
  std::vector<HeldPart> parts;
  for (const Isometry3d& X_WV : starts)
    parts.push_back({.part_V = finely_cut_cube(), .X_WV_start = X_WV});
  Twins twins({finely_cut_block()}, parts);
  std::array X_from = starts;
  for (int leg = 0; leg < 6; ++leg) {
    const std::array X_to{random_ghost(random), random_ghost(random), random_ghost(random)};
    const std::size_t idle = static_cast<std::size_t>(leg) % 3;
    if (leg % 4 == 3) twins.release(idle);
    for (int i = 1; i <= 30; ++i) {
      std::array<Isometry3d, 3> X_WG;
      for (std::size_t p = 0; p < 3; ++p)
        X_WG[p] = test_support::between(X_from[p], X_to[p], i / 30.0);
      ASSERT_NO_FATAL_FAILURE(twins.advance(X_WG)) << "leg " << leg << ", tick " << i;
    }
    if (leg % 4 == 3) twins.grasp(idle, X_to[idle]);
    X_from = X_to;
  }
  EXPECT_GT(twins.pushed(), 10);
}

TEST(SearchThread, DestructionDuringASearchIsSafe) {
  const Isometry3d X_WV = pose({0.0, 0.0, 0.0105});
  for (int ticks = 1; ticks <= 20; ++ticks) {
    Sliding sliding({finely_cut_block()}, finely_cut_cube(), X_WV, {.rules = {.has_search_thread = true}});
    for (int i = 1; i <= ticks; ++i)
      sliding.advance(pose({3e-4 * i, 0.0, 0.0102}));
  }
}

/// A ball so near to a block that a search finds very many pairs of triangles.
ContactScene crowded_scene() {
  ContactScene scene({test_support::obstacle_of(geometry::make_box({0.1, 0.1, 0.05}, 6000), pose({0.0, 0.0, -0.025}))},
                     {test_support::part_of(geometry::make_sphere(0.02, 2000))}, std::vector<double>{1e-5});
  scene.place(0, pose({0.0, 0.0, 0.0201}));
  return scene;
}

/// Waits until the thread has done more work than this, or for twenty seconds.
void wait_for_more_work(const SearchThread& thread, std::int64_t work) {
  for (int i = 0; i < 20'000 && thread.work() <= work; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

TEST(SearchThread, WorkAheadIsLimited) {
  constexpr std::int64_t kAhead = 20'000;
  constexpr std::int64_t kPiece = 16 * 500 + 100;  // the triangle pairs of two leaves
  const ContactScene scene = crowded_scene();
  SearchThread thread(kAhead);
  CandidateSearch search(scene, 5e-3, &thread);
  const CandidateRequest request{.X_WB = {scene.bodies().back().X_WB}, .range = {.radius = 2e-3}, .ignored = {}};
  CandidateSet found;
  thread.begin(search, request, found);
  for (const std::int64_t allowed : {0, 10'000, 30'000}) {
    SCOPED_TRACE(allowed);
    if (allowed > 0) thread.allow(allowed);
    wait_for_more_work(thread, allowed + kAhead);
    const std::int64_t work = thread.work();
    EXPECT_GT(work, allowed + kAhead) << "it goes on while nobody waits";
    EXPECT_LE(work, allowed + kAhead + kPiece);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_EQ(thread.work(), work) << "it stands still";
  }
  EXPECT_TRUE(thread.wait());
  EXPECT_GT(thread.work(), 30'000 + 2 * kAhead) << "otherwise the bound says nothing";
  EXPECT_FALSE(found.pairs.empty());
}

TEST(SearchThread, CancelStopsASearchEarly) {
  constexpr std::int64_t kAhead = 20'000;
  const ContactScene scene = crowded_scene();
  SearchThread thread(kAhead);
  CandidateSearch search(scene, 5e-3, &thread);
  const CandidateRequest request{.X_WB = {scene.bodies().back().X_WB}, .range = {.radius = 5e-3}, .ignored = {}};
  CandidateSet found;
  thread.begin(search, request, found);
  EXPECT_TRUE(thread.wait());
  const std::size_t pairs = found.pairs.size();
  const std::int64_t work = thread.work();
  EXPECT_GT(work, 4 * kAhead) << "otherwise nothing is left to do below";
  EXPECT_FALSE(thread.cancel()) << "it was done";
  thread.begin(search, request, found);
  wait_for_more_work(thread, kAhead);  // it goes on only as far as this
  EXPECT_TRUE(thread.cancel());
  EXPECT_LT(thread.work(), work / 2);
  search.start_afresh();
  thread.begin(search, request, found);
  EXPECT_TRUE(thread.wait());
  EXPECT_EQ(found.pairs.size(), pairs);
}

TEST(SearchThread, FailureOfACancelledSearchIsDiscarded) {
  const ContactScene scene = crowded_scene();
  SearchThread thread;
  CandidateSearch search(scene, 5e-3, &thread);
  CandidateRequest request{.X_WB = {pose({0.0, 0.0, std::nan("")})}, .range = {.radius = 2e-3}, .ignored = {}};
  CandidateSet found;
  thread.begin(search, request, found);
  EXPECT_TRUE(thread.cancel()) << "whether it has failed already or not";
  search.start_afresh();
  request.X_WB = {scene.bodies().back().X_WB};
  thread.begin(search, request, found);
  EXPECT_TRUE(thread.wait());
  EXPECT_FALSE(found.pairs.empty());
}

/// Sees with which priority a search begins.
struct PriorityMeter final : collision::WorkMeter {
  void spend(std::int64_t) override {
    if (priority < 0) priority = realtime::fifo_priority_of_this_thread();
  }
  int priority = -1;
};

TEST(SearchThread, RunsOnePriorityBelowTheRequestingThread) {
  const ContactScene scene = crowded_scene();
  SearchThread thread;
  PriorityMeter meter;
  CandidateSearch search(scene, 5e-3, &meter);
  const CandidateRequest request{.X_WB = {scene.bodies().back().X_WB}, .range = {.radius = 2e-3}, .ignored = {}};
  CandidateSet found;
  thread.begin(search, request, found);
  EXPECT_TRUE(thread.wait());
  EXPECT_EQ(meter.priority, 0) << "this thread is an ordinary one";

  meter.priority = -1;
  bool is_fifo = false;
  std::jthread asker([&] {
    is_fifo = realtime::schedule_this_thread(realtime::kSimulationPriority).is_fifo;
    thread.begin(search, request, found);
    EXPECT_TRUE(thread.wait());
  });
  asker.join();
  if (!is_fifo) GTEST_SKIP() << "SCHED_FIFO is not granted";
  EXPECT_EQ(meter.priority, realtime::kSimulationPriority - 1);
}

}  // namespace
}  // namespace glissade::contact
