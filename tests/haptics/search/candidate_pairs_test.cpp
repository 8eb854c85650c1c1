// Candidates over many steps: none that is near is missing while a search serves, and it makes no difference who looks.

#include "search/candidate_pairs.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/geometry/displacement.h>
#include <glissade/geometry/mesh_generators.h>

#include "contact/contact_search.h"
#include "held_part.h"
#include "near_bodies.h"
#include "poses.h"
#include "sanitizers.h"

namespace glissade::haptics {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::RandomNumbers;

constexpr double kGreatest = 5e-3;  // metres

/// Moves each part at random by up to `most` metres, or not at all.
void move_parts(ContactScene& scene, double most, RandomNumbers& random) {
  for (std::size_t p = 0; p < scene.movers().size(); ++p) {
    if (random.chance(0.2)) continue;
    const SlidingPart& part = *scene.movers()[p];
    const geometry::Displacement d{random.uniform(0.0, 0.5) * most * random.direction(),
                                   random.uniform(0.0, 0.5) * most / part.radius() * random.direction()};
    scene.place(p, geometry::displaced(scene.bodies()[scene.body_of_mover(p)].X_WB, part.p_Vref(), d));
  }
}

std::vector<NearPair> pairs_within(const CandidatePairs& candidates, double reach) {
  std::vector<NearPair> pairs(3);  // they are replaced
  candidates.within(reach, pairs);
  return pairs;
}

std::vector<PairToCertify> pairs_to_certify_within(const CandidatePairs& candidates, double reach) {
  std::vector<PairToCertify> to_certify(3);
  candidates.within(reach, to_certify);
  return to_certify;
}

/// Moves each part on and on as it has begun.
class SteadyMotion {
 public:
  SteadyMotion(const ContactScene& scene, double most, RandomNumbers& random) {
    for (const auto& part : scene.movers()) {
      steps_.push_back({random.uniform(0.0, 0.5) * most * random.direction(),
                        random.uniform(0.0, 0.5) * most / part->radius() * random.direction()});
    }
  }

  void move_parts(ContactScene& scene) const {
    for (std::size_t p = 0; p < steps_.size(); ++p) {
      const Isometry3d& X_WV = scene.bodies()[scene.body_of_mover(p)].X_WB;
      scene.place(p, geometry::displaced(X_WV, scene.movers()[p]->p_Vref(), steps_[p]));
    }
  }

  const std::vector<geometry::Displacement>& steps() const { return steps_; }

 private:
  std::vector<geometry::Displacement> steps_;
};

/// A pair of triangles within `reach` that is missing, for proofs or for contacts; empty if none is.
std::string what_is_missing(const CandidatePairs& candidates, const ContactScene& scene, double reach) {
  std::set<TrianglesOfBodies> for_contacts;
  for (const NearPair& c : pairs_within(candidates, reach))
    for_contacts.insert({c.bodies, c.obstacle_triangle, c.part_triangle});
  std::set<TrianglesOfBodies> for_proofs;
  for (const PairToCertify& pair_to_certify : pairs_to_certify_within(candidates, reach)) {
    for (const TrianglesOfBodies& pair : test_support::triangles_of(scene.bodies(), pair_to_certify))
      for_proofs.insert(pair);
  }
  for (const auto& [pair, distance] : test_support::near_triangles(scene.bodies(), scene.obstacles().size(), reach)) {
    const std::string text = std::to_string(pair.obstacle_triangle) + " of body " +
                             std::to_string(pair.bodies.obstacle) + " and " + std::to_string(pair.part_triangle) +
                             " of body " + std::to_string(pair.bodies.part) + " at " + std::to_string(distance);
    if (!for_proofs.contains(pair)) return "for proofs: " + text;
    if (test_support::can_make_contact(scene, pair) && !for_contacts.contains(pair)) return "for contacts: " + text;
  }
  return "";
}

TEST(CandidatePairs, HoldEverythingWithinTheReachOverManySteps) {
  constexpr std::uint64_t kSeed = 61;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomNumbers random(kSeed);
  int kept = 0;  // steps that an earlier search served
  std::int64_t searches = 0;
  for (int trial = 0; trial < test_support::affordable(60); ++trial) {
    const auto scene = test_support::random_contact_scene(0.02, 1e-4, 2e-4, random);
    CandidatePairs candidates(*scene, kGreatest);
    EXPECT_FALSE(candidates.covers(0.0)) << "before the first search";
    const bool is_steady = random.chance(0.5);
    const SteadyMotion steady(*scene, 2e-4, random);
    for (int step = 0; step < 40; ++step) {
      SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial) + ", step " +
                   std::to_string(step));
      if (random.chance(0.02)) candidates.clear();
      const double reach = random.power_of_ten(-4.0, -3.0);
      kept += candidates.look(reach, random.uniform(0.0, 1e-3), {}) ? 0 : 1;
      ASSERT_TRUE(candidates.covers(reach));
      ASSERT_EQ(what_is_missing(candidates, *scene, reach), "");
      // A step later the same candidates may still do.
      is_steady ? steady.move_parts(*scene) : move_parts(*scene, random.chance(0.1) ? 2e-2 : 2e-4, random);
      candidates.moved();
      const double other = random.power_of_ten(-4.0, -3.0);
      if (candidates.covers(other)) {
        ASSERT_EQ(what_is_missing(candidates, *scene, other), "");
      }
    }
    searches += candidates.statistics().searches;
  }
  EXPECT_GT(kept, 10);
  EXPECT_GT(searches, test_support::affordable(100));
}

/// Kind, triangles, features, gap and force of contacts, bit for bit.
std::vector<double> numbers_of(const std::vector<Contact>& contacts) {
  std::vector<double> numbers;
  for (const Contact& c : contacts) {
    numbers.insert(numbers.end(), {1.0 * static_cast<int>(c.kind), 1.0 * c.obstacle, 1.0 * c.obstacle_triangle,
                                   1.0 * c.part, 1.0 * c.part_triangle, 1.0 * c.part_feature, 1.0 * c.obstacle_feature,
                                   c.gap, c.range, c.n_W.x(), c.n_W.y(), c.n_W.z(), c.p_W.x(), c.p_W.y(), c.p_W.z()});
  }
  return numbers;
}

// Pairs whose contacts are known to have greater gaps are not looked at again before the parts have come nearer.
TEST(CandidatePairs, HaveTheSameContactsWhereGapsAreNoted) {
  constexpr std::uint64_t kSeed = 63;
  constexpr double kMargin = 1e-6;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomNumbers random(kSeed);
  std::size_t all = 0;
  std::size_t looked_at = 0;
  std::size_t known_ones = 0;
  std::size_t contacts = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const auto scene = test_support::random_contact_scene(0.02, 1e-4, 2e-4, random);
    const std::size_t first_part = scene->obstacles().size();
    CandidatePairs candidates(*scene, kGreatest);
    for (int step = 0; step < 40; ++step) {
      SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial) + ", step " +
                   std::to_string(step));
      const double reach = random.power_of_ten(-3.5, -2.5);
      candidates.look(reach, 1e-3, {});
      std::vector<Contact> of_all;
      const std::vector<NearPair> pairs = pairs_within(candidates, reach);
      find_contacts(scene->bodies(), first_part, pairs, reach, kMargin, of_all);
      std::vector<PairInReach> in_reach;
      std::vector<NearPair> some;
      std::vector<std::uint32_t> numbers;
      std::vector<KnownFeatures> known;
      std::vector<GapsOfPair> gaps;
      std::vector<Contact> of_some;
      candidates.in_reach(reach, in_reach);
      for (const PairInReach& pair : in_reach) {
        some.push_back(candidates.pair(pair.number));
        numbers.push_back(pair.number);
        known.push_back(candidates.known_features(pair.number, reach));
      }
      find_contacts(scene->bodies(), first_part, some, reach, kMargin, of_some, &gaps, known);
      candidates.note_gaps(numbers, gaps);
      ASSERT_EQ(numbers_of(of_some), numbers_of(of_all));
      all += pairs.size();
      looked_at += some.size();
      for (const KnownFeatures& of_pair : known)
        known_ones += of_pair.features != 0 ? 1 : 0;
      contacts += of_all.size();
      move_parts(*scene, random.power_of_ten(-6.0, -3.5), random);
      candidates.moved();
    }
  }
  EXPECT_LT(5 * looked_at, 4 * all);
  EXPECT_GT(10 * known_ones, looked_at);
  EXPECT_GT(contacts, 1000u);
}

/// All candidates, wherever they are.
std::set<TrianglesOfBodies> all_pairs_of(const CandidatePairs& candidates, const ContactScene& scene) {
  constexpr double kAnywhere = 1.0;
  std::set<TrianglesOfBodies> all;
  for (const PairToCertify& pair_to_certify : pairs_to_certify_within(candidates, kAnywhere)) {
    for (const TrianglesOfBodies& pair : test_support::triangles_of(scene.bodies(), pair_to_certify))
      all.insert(pair);
  }
  return all;
}

// Steps lead away from the poses of a search, back to them, and past them, farther than it covers all around.
TEST(CandidatePairs, AreAllThatComesNearOnACoveredPath) {
  constexpr std::uint64_t kSeed = 64;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomNumbers random(kSeed);
  int covered = 0;
  int covered_farther_than_around = 0;
  for (int trial = 0; trial < test_support::affordable(300); ++trial) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
    const auto scene = test_support::random_contact_scene(0.02, 1e-4, 2e-4, random);
    CandidatePairs candidates(*scene, kGreatest);
    PathCertificate certificate(*scene);
    candidates.look(0.0, 1e-3, {});
    const std::set<TrianglesOfBodies> known = all_pairs_of(candidates, *scene);
    const SteadyMotion away(*scene, 1e-3, random);
    away.move_parts(*scene);
    candidates.moved();
    std::vector<geometry::Displacement> step;
    const double share = random.uniform(-2.5, 0.5);
    for (const geometry::Displacement& d : away.steps())
      step.push_back(d.scaled(share));
    certificate.begin_step(step);
    const double near = candidates.covered_on_path(certificate);
    if (!(near > 0.0)) continue;
    ++covered;
    double length = 0.0;
    for (std::size_t p = 0; p < step.size(); ++p)
      length += geometry::motion_bound(step[p], scene->movers()[p]->radius());
    if (candidates.covered() - length < near - 1e-5) ++covered_farther_than_around;
    for (const double t : {0.0, 0.3, 0.5, 0.8, 1.0}) {
      std::vector<PlacedBody> bodies(scene->bodies().begin(), scene->bodies().end());
      for (std::size_t p = 0; p < step.size(); ++p) {
        PlacedBody& body = bodies[scene->body_of_mover(p)];
        body.X_WB = geometry::displaced(body.X_WB, scene->movers()[p]->p_Vref(), step[p].scaled(t));
      }
      for (const auto& [pair, distance] : test_support::near_triangles(bodies, scene->obstacles().size(), near))
        ASSERT_TRUE(known.contains(pair)) << "at " << distance << " m of " << near << ", moment " << t;
    }
  }
  EXPECT_GT(covered, test_support::affordable(100));
  EXPECT_GT(covered_farther_than_around, test_support::affordable(50));
}

TEST(CandidatePairs, LeaveOutBodiesThatAreIgnored) {
  const std::vector<Obstacle> obstacles{test_support::obstacle_of(geometry::make_plate({0.1, 0.1}, 50)),
                                        test_support::obstacle_of(geometry::make_plate({0.1, 0.1}, 50))};
  ContactScene scene(obstacles, {test_support::part_of(geometry::make_box({0.02, 0.02, 0.02}, 48))},
                     std::vector<double>{1e-5});
  scene.place(0, test_support::pose({0.0, 0.0, 0.0101}));
  CandidatePairs candidates(scene, kGreatest);
  const std::vector<BodyPair> ignored{{1, 2}};
  candidates.look(0.5e-3, 0.0, ignored);
  const std::vector<NearPair> pairs = pairs_within(candidates, 0.5e-3);
  const std::vector<PairToCertify> to_certify = pairs_to_certify_within(candidates, 0.5e-3);
  EXPECT_FALSE(pairs.empty());
  EXPECT_FALSE(to_certify.empty());
  for (const NearPair& pair : pairs)
    EXPECT_EQ(pair.bodies.obstacle, 0);
  for (const PairToCertify& pair_to_certify : to_certify)
    EXPECT_EQ(pair_to_certify.bodies.obstacle, 0);
}

/// Everything that `candidates` has to say, bit for bit.
std::vector<double> contents(const CandidatePairs& candidates, double reach) {
  std::vector<double> numbers;
  for (const NearPair& c : pairs_within(candidates, reach)) {
    numbers.insert(numbers.end(), {1.0 * c.bodies.obstacle, 1.0 * c.obstacle_triangle, 1.0 * c.bodies.part,
                                   1.0 * c.part_triangle, c.distance, c.n_W.x(), c.n_W.y(), c.n_W.z()});
  }
  for (const PairToCertify& o : pairs_to_certify_within(candidates, reach)) {
    numbers.insert(numbers.end(), {1.0 * o.bodies.obstacle, 1.0 * o.bodies.part, 1.0 * o.item_O.number,
                                   1.0 * o.item_V.number, o.distance, o.n_W.x(), o.n_W.y(), o.n_W.z()});
  }
  numbers.push_back(static_cast<double>(candidates.size()));
  numbers.push_back(static_cast<double>(candidates.statistics().searches));
  return numbers;
}

TEST(CandidatePairs, AreTheSameWithAThreadOfTheirOwn) {
  constexpr std::uint64_t kSeed = 62;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomNumbers random(kSeed);
  int renewed = 0;
  for (int trial = 0; trial < test_support::affordable(60); ++trial) {
    const auto scene = test_support::random_contact_scene(0.02, 1e-4, 2e-4, random);
    CandidatePairs without(*scene, kGreatest);
    CandidatePairs with(*scene, kGreatest, true);
    for (int step = 0; step < 60; ++step) {
      SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial) + ", step " +
                   std::to_string(step));
      if (random.chance(0.03)) {
        without.clear();
        with.clear();
      }
      const double reach = random.power_of_ten(-4.0, -3.0);
      const double ahead = random.uniform(0.0, 1e-3);
      const bool is_other = without.look(reach, ahead, {});
      ASSERT_EQ(with.look(reach, ahead, {}), is_other);
      ASSERT_EQ(contents(with, reach), contents(without, reach));
      renewed += is_other ? 1 : 0;
      move_parts(*scene, 1e-4, random);
      const double length = random.power_of_ten(-5.0, -4.0);
      for (CandidatePairs* candidates : {&without, &with}) {
        candidates->moved();
        candidates->look_ahead(length, reach, ahead, {});
      }
      if (!random.chance(0.3)) continue;
      const bool is_taken = without.take_ahead(0.1 * reach, length);
      ASSERT_EQ(with.take_ahead(0.1 * reach, length), is_taken);
      ASSERT_EQ(contents(with, reach), contents(without, reach));
    }
  }
  EXPECT_GT(renewed, test_support::affordable(100));
}

/// A cube that goes down to a plate in steps of equal length.
class CubeOverPlate : public ::testing::TestWithParam<bool> {
 protected:
  static constexpr double kReach = 0.1e-3;
  static constexpr double kAhead = 1e-3;

  void move(double length) {
    z_ -= length;
    scene_.place(0, test_support::pose({0.0, 0.0, z_}));
    candidates_.moved();
  }

  /// Looks, and asks for the next search where it is time.
  bool look() {
    const bool is_other = candidates_.look(kReach, kAhead, {});
    candidates_.look_ahead(0.0, kReach, kAhead, {});
    return is_other;
  }

  double z_ = 0.015;
  ContactScene scene_{{test_support::obstacle_of(geometry::make_plate({0.1, 0.1}, 50))},
                      {test_support::part_of(geometry::make_box({0.02, 0.02, 0.02}, 48))},
                      std::vector<double>{1e-5}};
  CandidatePairs candidates_{scene_, kGreatest, GetParam()};
};

// The part is 0.6 of the look-ahead before the place of a search when its answer is taken, so that serves for 1.6.
TEST_P(CubeOverPlate, TakesTheSearchThatWasAskedForAheadOfNeed) {
  move(0.0);
  EXPECT_TRUE(look());
  std::vector<int> taken;
  for (int step = 1; step <= 300; ++step) {
    move(0.02 * kAhead);
    if (look()) taken.push_back(step);
    ASSERT_TRUE(candidates_.covers(kReach));
  }
  ASSERT_GE(taken.size(), 4U);
  EXPECT_NEAR(taken[0], 50, 2) << "the first one, from where the cube stood, has been used up";
  for (std::size_t i = 2; i < taken.size(); ++i)
    EXPECT_NEAR(taken[i] - taken[i - 1], 80, 3);
}

TEST_P(CubeOverPlate, AJumpBeyondWhatWasAskedForIsSearchedAfresh) {
  move(0.0);
  look();
  move(0.8 * kAhead);
  EXPECT_FALSE(look()) << "and asks for the next one";
  move(3.5 * kAhead);
  EXPECT_FALSE(candidates_.covers(kReach));
  EXPECT_TRUE(look());
  EXPECT_TRUE(candidates_.covers(kReach + 0.3 * kAhead)) << "from 0.6 of the look-ahead farther on";
  EXPECT_EQ(what_is_missing(candidates_, scene_, kReach), "");
  EXPECT_EQ(candidates_.statistics().searches, 2) << "a search that was not used does not count";
}

TEST_P(CubeOverPlate, APartThatTurnsBackIsSearchedForAgain) {
  move(0.0);
  look();
  for (const double way : {0.8, 0.3}) {
    move(way * kAhead);
    look();  // the second one takes the search ahead
  }
  ASSERT_EQ(candidates_.statistics().searches, 2);
  for (int step = 0; step < 30; ++step) {
    move(-0.1 * kAhead);
    look();
    ASSERT_TRUE(candidates_.covers(kReach));
    ASSERT_EQ(what_is_missing(candidates_, scene_, kReach), "");
  }
  EXPECT_LE(candidates_.statistics().searches, 5);
}

// When 0.8 of the look-ahead has been used up, a search is made where the cube will be after the other 0.2 and 0.6
// more: at half of it above the plate.
TEST_P(CubeOverPlate, IsToldOfThePosesAtWhichItWasAskedFor) {
  move(5e-3 - 2.1 * kAhead);
  look();
  move(0.8 * kAhead);
  look();  // asks for the next one
  move(0.3 * kAhead);
  EXPECT_TRUE(look());
  const std::vector<PairToCertify> to_certify = pairs_to_certify_within(candidates_, 1.1 * kAhead);
  ASSERT_FALSE(to_certify.empty());
  EXPECT_NEAR(to_certify.front().distance, 0.5 * kAhead, 1e-9);
  const std::vector<NearPair> pairs = pairs_within(candidates_, 1.1 * kAhead);
  ASSERT_FALSE(pairs.empty());
  EXPECT_NEAR(pairs.front().distance, 0.5 * kAhead, 1e-9);
}

// Steps much longer than the look-ahead: each search is made at the middle of the next one, with little more than half
// of it as the radius.
TEST_P(CubeOverPlate, ALongStepNeedsHalfItsLengthAroundItsMiddle) {
  constexpr double kStep = 0.5e-3;
  constexpr double kLittle = 0.05e-3;
  PathCertificate certificate(scene_);
  const std::vector<geometry::Displacement> step{{{0.0, 0.0, -kStep}, Vector3d::Zero()}};
  move(0.0);
  candidates_.look(2.0 * kStep, kLittle, {});
  for (int i = 0; i < 5; ++i) {
    move(kStep);
    candidates_.look_ahead(kStep, kLittle, kLittle, {});
    if (i == 0) continue;  // the first search, at the beginning, serves for two steps
    ASSERT_TRUE(candidates_.take_ahead(kLittle, kStep)) << i;
    EXPECT_FALSE(candidates_.covers(0.5 * kStep));
    certificate.begin_step(step);
    EXPECT_GT(candidates_.covered_on_path(certificate), kLittle);
    EXPECT_LT(candidates_.covered_on_path(certificate), 0.3 * kStep);
  }
}

TEST_P(CubeOverPlate, AWayIsSearchedAtItsMiddle) {
  constexpr double kLength = 2e-3;
  constexpr double kLeast = 0.1e-3;
  const std::vector<geometry::Displacement> way{{{0.0, 0.0, -kLength}, Vector3d::Zero()}};
  PathCertificate certificate(scene_);
  move(0.0);
  EXPECT_TRUE(candidates_.look_along(way, kLength, kLeast, {}));
  EXPECT_TRUE(candidates_.covers(kLeast));
  EXPECT_FALSE(candidates_.covers(0.5 * kLength));
  certificate.begin_step(way);
  EXPECT_GT(candidates_.covered_on_path(certificate), kLeast);
  move(kLength);
  EXPECT_TRUE(candidates_.covers(kLeast));
}

TEST_P(CubeOverPlate, LeavesOutWhatHasCertainlyComeApart) {
  move(4.9e-3);
  candidates_.look(kReach, kAhead, {});
  EXPECT_FALSE(pairs_within(candidates_, kReach).empty());
  EXPECT_FALSE(pairs_to_certify_within(candidates_, kReach).empty());
  move(-0.2 * kAhead);  // up again; by the length of the way alone all might still be near
  EXPECT_TRUE(candidates_.covers(kReach));
  EXPECT_TRUE(pairs_within(candidates_, kReach).empty());
  EXPECT_TRUE(pairs_to_certify_within(candidates_, kReach).empty());
}

// Hardly anything is known then of which way is apart.
TEST_P(CubeOverPlate, KeepsWhatWasTooNearToHaveADirection) {
  move(5e-3 - 0.9 * kSharpDistance_m);
  candidates_.look(kReach, kAhead, {});
  move(0.8 * kSharpDistance_m);
  EXPECT_FALSE(pairs_within(candidates_, 0.2 * kSharpDistance_m).empty());
  EXPECT_EQ(what_is_missing(candidates_, scene_, 0.2 * kSharpDistance_m), "");
}

TEST_P(CubeOverPlate, APoseThatIsNoneIsAnErrorOfTheCaller) {
  move(0.0);
  candidates_.look(kReach, kAhead, {});
  scene_.place(0, test_support::pose({0.0, 0.0, std::numeric_limits<double>::quiet_NaN()}));
  candidates_.moved();
  EXPECT_THROW(candidates_.look(kReach, kAhead, {}), std::invalid_argument);
  EXPECT_FALSE(candidates_.covers(0.0)) << "what has failed is no answer";
  move(4.9e-3);
  EXPECT_TRUE(candidates_.look(kReach, kAhead, {}));
  EXPECT_EQ(what_is_missing(candidates_, scene_, kReach), "");
  EXPECT_FALSE(pairs_within(candidates_, kReach).empty());
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutAThread, CubeOverPlate, ::testing::Bool(),
                         [](const auto& test) { return std::string(test.param ? "WithAThread" : "WithoutAThread"); });

}  // namespace
}  // namespace glissade::haptics
