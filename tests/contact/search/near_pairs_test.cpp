// What is near: nothing is left out, for contacts and for proofs, and what is promised of each pair is true.

#include "search/near_pairs.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/geometry/mesh_generators.h>

#include "held_part.h"
#include "near_bodies.h"
#include "poses.h"
#include "sanitizers.h"

namespace glissade::contact {
namespace {

using Eigen::Vector3d;
using test_support::RandomNumbers;

constexpr double kSize = 0.02;  // metres, of most bodies here

constexpr std::array kAllKinds{SoughtPairs::kWithDistances, SoughtPairs::kWithPlanes,
                               SoughtPairs::kWithPlanesInCloseFit};

/// What the search finds for all bodies of a scene.
struct Found {
  Found(const ContactScene& scene, double radius, SoughtPairs sought = SoughtPairs::kWithPlanes)
      : Found(scene, SearchRange{.radius = radius, .sought = sought}) {}
  Found(const ContactScene& scene, const SearchRange& range) {
    collision::QueryWorkspace workspace;
    const std::span<const PlacedBody> bodies = scene.bodies();
    for (std::size_t part = scene.obstacles().size(); part < bodies.size(); ++part) {
      for (std::size_t other = 0; other < part; ++other) {
        const BodyPair pair{static_cast<std::int32_t>(other), static_cast<std::int32_t>(part)};
        find_near_pairs(pair, bodies[other], bodies[part], scene.margin(pair.obstacle, pair.part), range, workspace,
                        nullptr, pairs, boxes);
      }
    }
  }

  std::vector<PairToCertify> all_to_certify() const {
    std::vector<PairToCertify> all = boxes;
    for (const NearPair& pair : pairs) {
      if (pair.is_to_certify) all.push_back(to_certify(pair));
    }
    return all;
  }

  std::vector<NearPair> pairs;
  std::vector<PairToCertify> boxes;
};

/// How far apart n holds two triangles.
double gap_along(const Vector3d& n, const geometry::TrianglePoints& obstacle, const geometry::TrianglePoints& part) {
  double top = -std::numeric_limits<double>::infinity();
  double bottom = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    top = std::max(top, n.dot(obstacle[i]));
    bottom = std::min(bottom, n.dot(part[i]));
  }
  return bottom - top;
}

class NearPairs : public ::testing::Test {
 protected:
  static constexpr std::uint64_t kSeed = 41;

  NearPairs() : random_(kSeed) { RecordProperty("seed", static_cast<int>(kSeed)); }

  double random_margin() { return random_.power_of_ten(-5.5, -3.7); }

  RandomNumbers random_;
};

TEST_F(NearPairs, PairsToCertifyCoverEachNearTrianglePairOnce) {
  std::map<SoughtPairs, std::size_t> boxes;
  std::map<SoughtPairs, std::size_t> triangles;
  const int trials = std::max(60, test_support::affordable(300));  // few hold boxes of every kind
  for (int trial = 0; trial < trials; ++trial) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
    const double margin = random_margin();
    const auto scene = test_support::random_contact_scene(kSize, margin, margin * random_.uniform(0.3, 2.0), random_);
    const double radius = random_.power_of_ten(-4.0, -2.0);
    const std::map<TrianglesOfBodies, double> near =
        test_support::near_triangles(scene->bodies(), scene->obstacles().size(), radius);
    for (const SoughtPairs sought : kAllKinds) {
      std::map<TrianglesOfBodies, int> held;
      for (const PairToCertify& pair_to_certify : Found(*scene, radius, sought).all_to_certify()) {
        const bool is_box = pair_to_certify.item_O.kind != TreeItem::Kind::kTriangle;
        ++(is_box ? boxes : triangles)[sought];
        for (const TrianglesOfBodies& pair : test_support::triangles_of(scene->bodies(), pair_to_certify))
          ++held[pair];
      }
      for (const auto& [pair, distance] : near) {
        ASSERT_EQ(held[pair], 1) << pair.bodies.obstacle << ": " << pair.obstacle_triangle << ", " << pair.bodies.part
                                 << ": " << pair.part_triangle << " at " << distance;
      }
    }
  }
  for (const SoughtPairs sought : kAllKinds) {
    EXPECT_GT(boxes[sought], 3U);
    EXPECT_GT(triangles[sought], 50U);
  }
}

// Where parts fit closely, planes of triangles last longer than those of boxes. But the triangles of plates that lie on
// each other yield no contacts, and are too many.
TEST_F(NearPairs, CloseFitSearchOmitsBoxPairsOfBallsButNotOfPlates) {
  const auto scene = [](const geometry::TriangleMesh& obstacle, const geometry::TriangleMesh& part, double gap) {
    ContactScene made({test_support::obstacle_of(obstacle)}, {test_support::part_of(part)}, std::vector<double>{2e-6});
    made.place(0, test_support::pose({0.0, 0.0, gap}, Eigen::Quaterniond::Identity()));
    return made;
  };
  const ContactScene balls = scene(geometry::make_sphere(0.03, 2000), geometry::make_sphere(0.02, 2000), 0.0501);
  EXPECT_FALSE(Found(balls, 1e-3, SoughtPairs::kWithDistances).boxes.empty());
  EXPECT_TRUE(Found(balls, 1e-3, SoughtPairs::kWithPlanesInCloseFit).boxes.empty());
  const ContactScene plates =
      scene(geometry::make_plate({0.1, 0.1}, 5000), geometry::make_plate({0.06, 0.06}, 5000), 2e-6);
  EXPECT_FALSE(Found(plates, 1e-3, SoughtPairs::kWithPlanesInCloseFit).boxes.empty());
}

TEST_F(NearPairs, CompleteAtThePairLimitAndThrowsAboveIt) {
  ContactScene scene({test_support::obstacle_of(geometry::make_sphere(0.03, 500))},
                     {test_support::part_of(geometry::make_sphere(0.02, 500))}, std::vector<double>{2e-6});
  scene.place(0, test_support::pose({0.0, 0.0, 0.0501}));
  for (const SoughtPairs sought : kAllKinds) {
    SearchRange range{.radius = 2e-3, .sought = sought};
    const Found all(scene, range);
    range.most_pairs = all.pairs.size() + all.boxes.size();
    ASSERT_GT(range.most_pairs, 1U);
    const Found as_many_as_allowed(scene, range);
    EXPECT_EQ(as_many_as_allowed.pairs.size(), all.pairs.size());
    EXPECT_EQ(as_many_as_allowed.boxes.size(), all.boxes.size());
    --range.most_pairs;
    EXPECT_THROW(Found(scene, range), TooManyPairs);
  }
}

TEST_F(NearPairs, HoldEveryPairThatMayYieldAContactOnce) {
  std::size_t in_boxes = 0;
  std::size_t others = 0;
  for (int trial = 0; trial < test_support::affordable(300); ++trial) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
    const double margin = random_margin();
    const auto scene = test_support::random_contact_scene(kSize, margin, margin * random_.uniform(0.3, 2.0), random_);
    const double radius = random_.power_of_ten(-4.0, -2.0);
    std::map<TrianglesOfBodies, int> held;
    for (const NearPair& pair : Found(*scene, radius).pairs) {
      ASSERT_EQ(pair.may_yield_contact, test_support::can_make_contact(*scene, pair));
      ASSERT_TRUE(pair.may_yield_contact || pair.is_to_certify) << "of no use";
      ++held[pair];
      (pair.is_to_certify ? others : in_boxes) += 1;
    }
    for (const auto& [pair, distance] :
         test_support::near_triangles(scene->bodies(), scene->obstacles().size(), radius)) {
      if (!test_support::can_make_contact(*scene, pair)) continue;
      ASSERT_EQ(held[pair], 1) << pair.bodies.obstacle << ": " << pair.obstacle_triangle << ", " << pair.bodies.part
                               << ": " << pair.part_triangle << " at " << distance;
    }
  }
  EXPECT_GT(in_boxes, 50U);
  EXPECT_GT(others, 50U);
}

TEST_F(NearPairs, TellLowerBoundsOfDistances) {
  int measured = 0;
  for (int trial = 0; trial < test_support::affordable(80); ++trial) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
    const double margin = random_margin();
    const auto scene = test_support::random_contact_scene(kSize, margin, margin * random_.uniform(0.1, 1.0), random_);
    const std::span<const PlacedBody> bodies = scene->bodies();
    const Found found(*scene, random_.power_of_ten(-4.0, -3.0));
    for (const NearPair& pair : found.pairs) {
      ASSERT_LE(pair.distance, test_support::distance_of(bodies, pair) + 1e-14);
      ASSERT_EQ(pair.distance, static_cast<double>(static_cast<float>(pair.distance)));
    }
    for (const PairToCertify& pair_to_certify : found.all_to_certify()) {
      ASSERT_NEAR(pair_to_certify.n_W.norm(), 1.0, 1e-12);
      for (const TrianglesOfBodies& pair : test_support::triangles_of(bodies, pair_to_certify)) {
        constexpr double kRounding = 1e-14;
        const double distance = test_support::distance_of(bodies, pair);
        const auto& O = bodies[static_cast<std::size_t>(pair.bodies.obstacle)];
        const auto& P = bodies[static_cast<std::size_t>(pair.bodies.part)];
        ASSERT_GE(distance, pair_to_certify.distance - kRounding);
        ASSERT_GE(
            gap_along(pair_to_certify.n_W, O.triangle_W(pair.obstacle_triangle), P.triangle_W(pair.part_triangle)),
            pair_to_certify.distance - kRounding)
            << "from the obstacle to the part";
        // A direction between points a micrometre apart is good to 1e-10.
        if (pair_to_certify.item_O.kind == TreeItem::Kind::kTriangle && pair_to_certify.distance < 0.5 * margin) {
          ASSERT_NEAR(distance, pair_to_certify.distance, 1e-10) << "measured";
          ++measured;
        }
      }
    }
  }
  EXPECT_GT(measured, 0);
}

// Hands see as far as these distances tell them.
TEST_F(NearPairs, DistancesAreExactWhenSought) {
  int measured = 0;
  for (int trial = 0; trial < std::max(20, test_support::affordable(80)); ++trial) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
    const double margin = random_margin();
    const auto scene = test_support::random_contact_scene(kSize, margin, margin, random_);
    for (const NearPair& pair : Found(*scene, 1e-3, SoughtPairs::kWithDistances).pairs) {
      ASSERT_NEAR(test_support::distance_of(scene->bodies(), pair), pair.distance, 2e-10);
      ++measured;
    }
  }
  EXPECT_GT(measured, 50);
}

// The planes of triangles are fixed to the body of the triangle.
TEST_F(NearPairs, TurningDirectionsAreNormalsOfThePartTriangle) {
  int turning = 0;
  for (int trial = 0; trial < test_support::affordable(80); ++trial) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
    const double margin = random_margin();
    const auto scene = test_support::random_contact_scene(kSize, margin, margin, random_);
    for (const NearPair& pair : Found(*scene, random_.power_of_ten(-4.0, -3.0)).pairs) {
      if (!pair.turns_with_part) continue;
      const geometry::TrianglePoints x_W =
          scene->bodies()[static_cast<std::size_t>(pair.bodies.part)].triangle_W(pair.part_triangle);
      for (std::size_t c = 1; c < 3; ++c)
        ASSERT_NEAR(pair.n_W.dot(x_W[c] - x_W[0]), 0.0, 1e-5 * kSize);
      ++turning;
    }
  }
  EXPECT_GT(turning, 5);
}

/// A plate one margin above another, each cut into so many triangles.
std::size_t pairs_to_certify_of_flush_plates(std::int64_t triangles, double gap) {
  constexpr double kMargin = 2e-6;
  const ContactScene scene = [&] {
    std::vector<Obstacle> obstacles{test_support::obstacle_of(geometry::make_plate({0.5, 0.5}, triangles))};
    ContactScene made(obstacles, {test_support::part_of(geometry::make_plate({0.1, 0.06}, triangles))},
                      std::vector<double>{kMargin});
    made.place(0, test_support::pose({0.03, 0.02, gap * kMargin}, test_support::turn(0.4, Vector3d::UnitZ())));
    return made;
  }();
  return Found(scene, 0.5e-3).all_to_certify().size();
}

TEST_F(NearPairs, PairsToCertifyForFlushPlatesIndependentOfTessellation) {
  EXPECT_LE(pairs_to_certify_of_flush_plates(20, 1.0), 16U) << "the children of the roots";
  EXPECT_LE(pairs_to_certify_of_flush_plates(5000, 1.0), 16U);
  EXPECT_GT(pairs_to_certify_of_flush_plates(5000, 0.5), 300U) << "nearer than boxes are accepted";
}

}  // namespace
}  // namespace glissade::contact
