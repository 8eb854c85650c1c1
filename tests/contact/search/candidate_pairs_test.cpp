// Candidates over many steps: none that is near is missing while a search serves, and it makes no difference who looks.

#include "search/candidate_pairs.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/geometry/displacement.h>
#include <glissade/geometry/mesh_generators.h>

#include "candidates.h"
#include "certificate/path_certificate.h"
#include "features/contact_search.h"
#include "held_part.h"
#include "near_bodies.h"
#include "poses.h"
#include "sanitizers.h"

namespace glissade::contact {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::pairs_to_certify_within;
using test_support::pairs_within;
using test_support::RandomNumbers;
using test_support::what_is_missing;

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

/// The pairs with gaps up to `reach` (metres), in the order of the search.
std::vector<PlaceOfPair> places_within(double reach, const std::vector<GapsBySlot>& gaps,
                                       const std::vector<PlanesOfBodies>& planes) {
  std::vector<PlaceOfPair> places;
  for (std::uint32_t i = 0; i < planes.size(); ++i) {
    for (std::uint32_t slot = 0; slot < planes[i].numbers().size(); ++slot) {
      if (static_cast<double>(gaps[i].of_blocks[slot / kPlanesAtOnce]) > reach) continue;
      if (static_cast<double>(gaps[i].gaps[slot]) > reach) continue;
      places.push_back({planes[i].numbers()[slot], i, slot});
    }
  }
  std::sort(places.begin(), places.end(),
            [](const PlaceOfPair& a, const PlaceOfPair& b) { return a.number < b.number; });
  return places;
}

// Pairs whose contacts are known to have greater gaps are not looked at again before the parts have come nearer.
TEST(CandidatePairs, NotedGapsDoNotChangeTheContacts) {
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
      const std::vector<TrianglesOfBodies> pairs = pairs_within(candidates, reach);
      find_contacts(scene->bodies(), first_part, pairs, reach, kMargin, of_all);
      std::vector<GapsBySlot> in_reach;
      std::vector<TrianglesOfBodies> some;
      std::vector<PlaceOfPair> places;
      std::vector<KnownFeatures> known;
      std::vector<GapsOfPair> gaps;
      std::vector<Contact> of_some;
      const std::size_t count = candidates.pairs().find_gaps(reach, in_reach);
      places = places_within(reach, in_reach, candidates.pairs().planes());
      ASSERT_EQ(places.size(), count);
      for (const PlaceOfPair& pair : places) {
        some.push_back(candidates.pairs().triangles(pair));
        known.push_back(candidates.pairs().known_features(pair.number, reach));
      }
      find_contacts(scene->bodies(), first_part, some, reach, kMargin, of_some, &gaps, known);
      candidates.pairs().note_gaps(places, gaps);
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
TEST(CandidatePairs, ContainEveryPairThatComesNearOnACoveredPath) {
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

/// A triangle of a hundredth of a millimetre at each of these points.
geometry::TriangleMesh specks(const std::vector<Vector3d>& points) {
  geometry::TriangleMesh mesh;
  for (const Vector3d& p : points) {
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    for (const Vector3d& corner : {Vector3d(0.0, 0.0, 0.0), Vector3d(1e-5, 0.0, 0.0), Vector3d(0.0, 1e-5, 0.0)})
      mesh.vertices.push_back(p + corner);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

// The part turns by 1 rad while its centre comes back to that of the search. Halfway, one of its specks is farther from
// its place at the search than at either end, by 0.007 of the radius, and meets a speck that the search left out.
TEST(CandidatePairs, PathCoverageCountsTheArcOfARotation) {
  constexpr double kRadius = 0.02;  // metres
  constexpr double kTurn = 1.0;     // rad
  const double chord = 2.0 * kRadius * std::sin(0.5 * kTurn);
  const Vector3d at_search(kRadius, 0.0, 0.0);
  const auto on_arc = [&](double t) {  // of the speck that starts at `at_search`
    return Vector3d(kRadius * std::cos(t * kTurn), kRadius * std::sin(t * kTurn), 0.0);
  };
  const Vector3d begin = on_arc(1.0) - at_search;  // of the part: the start is as far from the search as the end
  const Vector3d halfway = 0.5 * begin + on_arc(0.5);
  const double least = 5e-5;  // beyond the rounding of 1e-5 of the specks
  const double radius = chord + least;
  ASSERT_GT((halfway - at_search).norm(), radius + 5e-5);
  ContactScene scene({test_support::obstacle_of(specks({halfway}))},
                     {test_support::part_of(specks({at_search, -at_search}))}, std::vector<double>{1e-6});
  CandidatePairs candidates(scene, 2.0 * radius);
  PathCertificate certificate(scene);
  candidates.look(radius, 0.0, {});
  ASSERT_TRUE(all_pairs_of(candidates, scene).empty());
  scene.place(0, test_support::pose(begin));
  candidates.moved();
  certificate.begin_step(std::vector<geometry::Displacement>{{-begin, {0.0, 0.0, kTurn}}});
  EXPECT_LE(candidates.covered_on_path(certificate), 0.0);
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
  const std::vector<TrianglesOfBodies> pairs = pairs_within(candidates, 0.5e-3);
  const std::vector<PairToCertify> to_certify = pairs_to_certify_within(candidates, 0.5e-3);
  EXPECT_FALSE(pairs.empty());
  EXPECT_FALSE(to_certify.empty());
  for (const TrianglesOfBodies& pair : pairs)
    EXPECT_EQ(pair.bodies.obstacle, 0);
  for (const PairToCertify& pair_to_certify : to_certify)
    EXPECT_EQ(pair_to_certify.bodies.obstacle, 0);
}

/// Everything that `candidates` has to say, bit for bit.
std::vector<double> contents(const CandidatePairs& candidates, double reach) {
  std::vector<double> numbers;
  for (const TrianglesOfBodies& c : pairs_within(candidates, reach)) {
    numbers.insert(numbers.end(),
                   {1.0 * c.bodies.obstacle, 1.0 * c.obstacle_triangle, 1.0 * c.bodies.part, 1.0 * c.part_triangle});
  }
  for (const PairToCertify& o : pairs_to_certify_within(candidates, reach)) {
    numbers.insert(numbers.end(), {1.0 * o.bodies.obstacle, 1.0 * o.bodies.part, 1.0 * o.item_O.number,
                                   1.0 * o.item_V.number, o.distance, o.n_W.x(), o.n_W.y(), o.n_W.z()});
  }
  numbers.push_back(static_cast<double>(candidates.pairs().size()));
  numbers.push_back(static_cast<double>(candidates.statistics().searches));
  return numbers;
}

TEST(CandidatePairs, SearchThreadDoesNotChangeThem) {
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

}  // namespace
}  // namespace glissade::contact
