// One or two parts in random hands among obstacles, close to each other and to these, or the last one on a random
// script: they push each other about, slide, are let go and taken again. Never is anything inside anything, where they
// are seen, nor, in calls of one cycle, on the way there; and the lag of a part under force feedback never jumps.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/collision/dop_query.h>
#include <glissade/contact/multi_part_sliding.h>
#include <glissade/reference/brute_force.h>

#include "near_bodies.h"
#include "sanitizers.h"
#include "scene/scene_access.h"

namespace glissade::contact {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::RandomNumbers;

constexpr int kTrials = test_support::kSanitized ? 40 : 200;
constexpr int kTicks = 150;
constexpr int kLongestTick_ms = 3;
constexpr double kMargin_m = 5e-6;

/// A hand that goes for some body, turns, rests, or lets go, for some ticks each.
class Hand {
 public:
  Hand(const Isometry3d& X_WG, double size) : X_WG_(X_WG), size_(size) {}

  void begin(const Vector3d& target_W, RandomNumbers& random) {
    ticks_left_ = random.integer(5, 40);
    target_W_ = target_W;
    speed_ = random.chance(0.2) ? 0.0 : size_ * random.power_of_ten(-4.0, -1.0);
    axis_ = random.direction();
    turn_ = random.chance(0.5) ? 0.0 : random.power_of_ten(-4.0, -1.5);
    holds_ = !random.chance(0.1);
  }
  const Isometry3d& next() {
    --ticks_left_;
    const Vector3d way = target_W_ - X_WG_.translation();
    X_WG_.translation() += std::min(1.0, speed_ / std::max(way.norm(), 1e-9)) * way;
    X_WG_.linear() =
        (Eigen::AngleAxisd(turn_, axis_) * Eigen::Quaterniond(X_WG_.linear())).normalized().toRotationMatrix();
    return X_WG_;
  }

  bool is_done() const { return ticks_left_ <= 0; }
  bool holds() const { return holds_; }

 private:
  Isometry3d X_WG_;
  double size_;
  int ticks_left_ = 0;
  Vector3d target_W_ = Vector3d::Zero();
  Vector3d axis_ = Vector3d::UnitX();
  double speed_ = 0.0;  // metres in a tick
  double turn_ = 0.0;   // radians in a tick
  bool holds_ = true;
};

/// Where all bodies are, in the order of their numbers.
std::vector<PlacedBody> placed_bodies(const MultiPartSliding& sliding) {
  return {scene_of(sliding).bodies().begin(), scene_of(sliding).bodies().end()};
}

/// Calls `check` with every pair of bodies that must not meet.
template <typename Check>
void for_each_pair(const MultiPartSliding& sliding, const Check& check) {
  const auto bodies = static_cast<std::int32_t>(scene_of(sliding).bodies().size());
  for (auto part = static_cast<std::int32_t>(scene_of(sliding).obstacles().size()); part < bodies; ++part) {
    for (std::int32_t other = 0; other < part; ++other)
      check(BodyPair{other, part});
  }
}

Isometry3d relative_pose(const std::vector<PlacedBody>& bodies, const BodyPair& pair) {
  return bodies[static_cast<std::size_t>(pair.obstacle)].X_WB.inverse(Eigen::Isometry) *
         bodies[static_cast<std::size_t>(pair.part)].X_WB;
}

/// Two bodies that meet, in words; empty if none do.
std::string what_meets(const MultiPartSliding& sliding) {
  const std::vector<PlacedBody> bodies = placed_bodies(sliding);
  std::string met;
  for_each_pair(sliding, [&](const BodyPair& pair) {
    if (reference::brute_force_intersects(bodies[static_cast<std::size_t>(pair.obstacle)].body->tree.mesh(),
                                          bodies[static_cast<std::size_t>(pair.part)].body->tree.mesh(),
                                          relative_pose(bodies, pair))) {
      met = "bodies " + std::to_string(pair.obstacle) + " and " + std::to_string(pair.part);
    }
  });
  return met;
}

/// Proves that bodies keep their floor on the whole way of one cycle, on which all parts go along their displacements
/// at the same time: a gap in the middle of a stretch holds for all of it that nothing can have covered since. The
/// trees' gaps have tests of their own; the certificate has no part in it.
class PathProof {
 public:
  PathProof(const MultiPartSliding& sliding, std::vector<PlacedBody> before)
      : sliding_(sliding), before_(std::move(before)), bodies_(before_) {
    for (std::size_t p = 0; p < sliding.part_count(); ++p) {
      const std::size_t body = scene_of(sliding).body_of_mover(p);
      displacements_.push_back(geometry::displacement_between(before_[body].X_WB, scene_of(sliding).bodies()[body].X_WB,
                                                              sliding.part(p).p_Vref()));
    }
  }

  /// Two bodies that come nearer than their floor, in words; empty if none do.
  std::string what_comes_too_near() {
    std::string near;
    for_each_pair(sliding_, [&](const BodyPair& pair) {
      if (!keeps_floor(pair, 0.0, 1.0))
        near = "bodies " + std::to_string(pair.obstacle) + " and " + std::to_string(pair.part);
    });
    return near;
  }

 private:
  bool keeps_floor(const BodyPair& pair, double begin, double end) {
    const double middle = 0.5 * (begin + end);
    for (std::size_t p = 0; p < displacements_.size(); ++p) {
      const std::size_t body = scene_of(sliding_).body_of_mover(p);
      bodies_[body].X_WB =
          geometry::displaced(before_[body].X_WB, sliding_.part(p).p_Vref(), displacements_[p].scaled(middle));
    }
    const double least = 0.999 * scene_of(sliding_).min_clearance(pair.obstacle, pair.part);
    const double covered = motion_of(pair.obstacle, 0.5 * (end - begin)) + motion_of(pair.part, 0.5 * (end - begin));
    const double gap = collision::distance(bodies_[static_cast<std::size_t>(pair.obstacle)].body->tree,
                                           bodies_[static_cast<std::size_t>(pair.part)].body->tree,
                                           relative_pose(bodies_, pair), workspace_, 2.0 * (least + covered))
                           .distance;
    if (gap >= least + covered) return true;
    if (gap < least || end - begin < 1e-6) return false;
    return keeps_floor(pair, begin, middle) && keeps_floor(pair, middle, end);
  }

  /// Metres that no point of a body moves more than in such a part of the way.
  double motion_of(std::int32_t body, double fraction) const {
    const auto first = static_cast<std::int32_t>(scene_of(sliding_).obstacles().size());
    if (body < first) return 0.0;
    const auto part = static_cast<std::size_t>(body - first);
    return geometry::motion_bound(displacements_[part].scaled(fraction), sliding_.part(part).radius());
  }

  const MultiPartSliding& sliding_;
  std::vector<PlacedBody> before_;
  std::vector<PlacedBody> bodies_;
  std::vector<geometry::Displacement> displacements_;
  collision::QueryWorkspace workspace_;
};

/// By which the coupling's force is: k_t times this, metres.
Vector3d lag_of(const MultiPartSliding& sliding, std::size_t part) {
  const SlidingResult& result = sliding.result(part);
  return geometry::displacement_between(result.X_WV, result.X_WT, sliding.part(part).p_Vref()).v;
}

SlidingRules random_rules(RandomNumbers& random) {
  SlidingRules rules{.max_cycles = random.chance(0.7) ? 1 : 10, .margin = kMargin_m};
  if (random.chance(0.2)) rules.friction = {.at_rest = 0.4, .sliding = 0.3};
  return rules;
}

/// From one random place near X_WB to the next, as long as a trial lasts.
PartScript random_script(const Isometry3d& X_WB, double size, RandomNumbers& random) {
  std::vector<geometry::TimedPose> rows{{std::chrono::milliseconds(0), X_WB}};
  while (rows.back().time < std::chrono::milliseconds(kLongestTick_ms * kTicks)) {
    Isometry3d X_WS = X_WB;
    X_WS.translation() += random.uniform(0.0, 1.0) * size * random.direction();
    X_WS.rotate(Eigen::AngleAxisd(random.uniform(0.0, 0.5), random.direction()));
    rows.push_back({rows.back().time + std::chrono::milliseconds(random.integer(10, 100)), X_WS});
  }
  return {.X_WB = geometry::PoseTrajectory(rows)};
}

std::vector<HeldPart> random_held_parts(const ContactScene& scene, RandomNumbers& random) {
  std::vector<HeldPart> parts;
  for (std::size_t p = 0; p < scene.movers().size(); ++p) {
    parts.push_back({.part_V = scene.movers()[p],
                     .X_WV_start = scene.bodies()[scene.body_of_mover(p)].X_WB,
                     .metaphor = static_cast<Metaphor>(random.integer(0, std::ssize(kMetaphorNames) - 1))});
  }
  return parts;
}

/// Counted over all trials, because a torture in which nothing happens would prove nothing.
struct TortureEvents {
  int pushed_by_each_other = 0;
  int grasps_at_an_offset = 0;  // under force feedback
  int moved = 0;
  int paths = 0;
};

/// The parts of a scene, each in a random hand, or on a script.
class TortureTrial {
 public:
  TortureTrial(const ContactScene& scene, std::vector<HeldPart> parts, double size, RandomNumbers& random,
               TortureEvents& events)
      : random_(random),
        events_(events),
        parts_(std::move(parts)),
        rules_(random_rules(random)),
        obstacles_(static_cast<std::int32_t>(scene.obstacles().size())),
        sliding_({scene.obstacles().begin(), scene.obstacles().end()}, parts_, rules_) {
    for (const HeldPart& part : parts_)
      hands_.emplace_back(part.X_WV_start, size);
  }

  /// Ends at the first fatal failure.
  void run() {
    for (int tick = 0; tick < kTicks && !testing::Test::HasFatalFailure(); ++tick) {
      SCOPED_TRACE("tick " + std::to_string(tick));
      advance();
    }
  }

 private:
  void advance() {
    const std::vector<PlacedBody> before = placed_bodies(sliding_);
    const double milliseconds = random_.chance(0.1) ? kLongestTick_ms : 1.0;
    time_ += std::chrono::duration<double, std::milli>(milliseconds);
    allowed_ = kSlew_m * milliseconds;
    lags_.clear();
    X_WG_.clear();
    for (std::size_t p = 0; p < hands_.size(); ++p)
      lead(p, before);
    sliding_.advance(X_WG_, milliseconds);
    ASSERT_EQ(what_meets(sliding_), "");
    if (rules_.max_cycles == 1) {
      ASSERT_EQ(PathProof(sliding_, before).what_comes_too_near(), "");
      ++events_.paths;
    }
    for (std::size_t p = 0; p < parts_.size() && !testing::Test::HasFatalFailure(); ++p)
      check(p, before);
  }

  /// Moves the hand of a part, which may let go of it or take it again, or its script.
  void lead(std::size_t p, const std::vector<PlacedBody>& before) {
    if (parts_[p].script) {
      X_WG_.push_back(parts_[p].script->pose_at(time_));
    } else {
      lead_by_hand(p, before);
    }
    lags_.push_back(lag_of(sliding_, p));
    if (sliding_.result(p).state == SlidingState::kReleased) return;
    const geometry::Displacement of_ghost =
        geometry::displacement_between(sliding_.result(p).X_WG, X_WG_[p], sliding_.part(p).p_Vref());
    allowed_ += geometry::motion_bound(of_ghost, sliding_.part(p).radius());
  }

  void lead_by_hand(std::size_t p, const std::vector<PlacedBody>& before) {
    Hand& hand = hands_[p];
    if (hand.is_done()) {
      const auto body = static_cast<std::size_t>(random_.integer(0, static_cast<int>(before.size()) - 1));
      hand.begin(before[body].X_WB * before[body].body->tree.center(), random_);
    }
    X_WG_.push_back(hand.next());
    const bool is_released = sliding_.result(p).state == SlidingState::kReleased;
    if (!hand.holds() && !is_released) sliding_.release(p);
    if (hand.holds() && is_released) {
      const double offset = (X_WG_[p].translation() - sliding_.result(p).X_WV.translation()).norm();
      events_.grasps_at_an_offset += parts_[p].metaphor == Metaphor::kForceFeedback && offset > kSlew_m ? 1 : 0;
      sliding_.grasp(p, X_WG_[p]);
    }
  }

  void check(std::size_t p, const std::vector<PlacedBody>& before) {
    const SlidingResult& result = sliding_.result(p);
    ASSERT_TRUE(result.X_WV.matrix().allFinite());
    if (parts_[p].metaphor == Metaphor::kForceFeedback) {
      ASSERT_LE((lag_of(sliding_, p) - lags_[p]).norm(), allowed_ * (1.0 + 1e-9));
    }
    events_.moved += result.X_WV.matrix() != before[scene_of(sliding_).body_of_mover(p)].X_WB.matrix() ? 1 : 0;
    events_.pushed_by_each_other +=
        static_cast<int>(std::count_if(result.contacts.begin(), result.contacts.end(), [&](const Contact& contact) {
          return contact.force > 0.0 && contact.obstacle >= obstacles_;
        }));
  }

  RandomNumbers& random_;
  TortureEvents& events_;
  std::vector<HeldPart> parts_;
  SlidingRules rules_;
  std::int32_t obstacles_;
  MultiPartSliding sliding_;
  std::vector<Hand> hands_;
  std::vector<Isometry3d> X_WG_;  // in this tick
  std::vector<Vector3d> lags_;    // before it
  double allowed_ = 0.0;          // metres that a lag may change by in this tick
  std::chrono::duration<double, std::milli> time_{0.0};
};

TEST(MultiPartTorture, NothingIsEverInsideAnything) {
  constexpr std::uint64_t kSeed = 71;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomNumbers random(kSeed);
  TortureEvents events;
  for (int trial = 0; trial < kTrials; ++trial) {
    const double size = random.power_of_ten(-2.5, 0.0);
    const auto scene = test_support::random_contact_scene(size, kMargin_m, 2.0 * kMargin_m, random);
    std::vector<HeldPart> parts = random_held_parts(*scene, random);
    TortureTrial torture(*scene, std::move(parts), size, random, events);
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial) + ", parts of " +
                 std::to_string(size) + " m");
    torture.run();
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(events.moved, 100);
  EXPECT_GT(events.paths, 100);
  RecordProperty("pushed_by_each_other", events.pushed_by_each_other);
  RecordProperty("grasps_at_an_offset", events.grasps_at_an_offset);
  // So few, for the forty trials that sanitizers afford.
  EXPECT_GT(events.pushed_by_each_other, 20);
  EXPECT_GT(events.grasps_at_an_offset, 0);
}

TEST(MultiPartTorture, NothingIsEverInsideAPartOnAScript) {
  constexpr std::uint64_t kSeed = 73;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomNumbers random(kSeed);
  TortureEvents events;
  int scripted = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const double size = random.power_of_ten(-2.5, 0.0);
    const auto scene = test_support::random_contact_scene(size, kMargin_m, 2.0 * kMargin_m, random);
    std::vector<HeldPart> parts = random_held_parts(*scene, random);
    if (parts.size() < 2) continue;
    ++scripted;
    parts.back().script = random_script(parts.back().X_WV_start, size, random);
    if (random.chance(0.5)) parts.back().stiffness = CouplingStiffness{1e6, 1e6 * size * size};  // pushes harder
    TortureTrial torture(*scene, std::move(parts), size, random, events);
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial) + ", parts of " +
                 std::to_string(size) + " m");
    torture.run();
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(scripted, kTrials / 5);
  EXPECT_GT(events.paths, 100);
  RecordProperty("pushed_by_each_other", events.pushed_by_each_other);
  EXPECT_GT(events.pushed_by_each_other, kTrials / 10);
}

}  // namespace
}  // namespace glissade::contact
