// What steps have to be proved free of: nothing that is near is left out, and what is promised of each item is true.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/collision/mesh_generators.h>
#include <glissade/haptics/proof_front.h>

#include "held_part.h"
#include "near_bodies.h"
#include "poses.h"
#include "sanitizers.h"

namespace glissade::haptics {
namespace {

using Eigen::Vector3d;
using test_support::RandomNumbers;

constexpr double kSize = 0.02;  // metres, of most bodies here

std::vector<Obligation> obligations_of(const Surroundings& surroundings, double radius,
                                       const std::vector<BodyPair>& ignored = {}) {
  collision::QueryWorkspace workspace;
  std::vector<Obligation> obligations(3);  // they are replaced
  find_obligations(surroundings, surroundings.bodies(), radius, ignored, workspace, obligations);
  return obligations;
}

/// How far apart n holds two triangles.
double gap_along(const Vector3d& n, const collision::TrianglePoints& obstacle, const collision::TrianglePoints& part) {
  double top = -std::numeric_limits<double>::infinity();
  double bottom = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    top = std::max(top, n.dot(obstacle[i]));
    bottom = std::min(bottom, n.dot(part[i]));
  }
  return bottom - top;
}

class ProofFront : public ::testing::Test {
 protected:
  static constexpr std::uint64_t kSeed = 41;

  ProofFront() : random_(kSeed) { RecordProperty("seed", static_cast<int>(kSeed)); }

  double random_margin() { return random_.power_of_ten(-5.5, -3.7); }

  RandomNumbers random_;
};

TEST_F(ProofFront, HoldsEveryPairOfTrianglesWithinTheRadiusOnce) {
  std::size_t boxes = 0;
  std::size_t triangles = 0;
  for (int trial = 0; trial < test_support::affordable(300); ++trial) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
    const double margin = random_margin();
    const auto surroundings =
        test_support::random_surroundings(kSize, margin, margin * random_.uniform(0.3, 2.0), random_);
    const double radius = random_.power_of_ten(-4.0, -2.0);
    std::map<TrianglesOfBodies, int> held;
    for (const Obligation& obligation : obligations_of(*surroundings, radius)) {
      const bool is_box = obligation.item_O.kind != TreeItem::Kind::kTriangle;
      ++(is_box ? boxes : triangles);
      for (const TrianglesOfBodies& pair : test_support::triangles_of(surroundings->bodies(), obligation))
        ++held[pair];
    }
    for (const auto& [pair, distance] :
         test_support::near_triangles(surroundings->bodies(), surroundings->obstacles().size(), radius)) {
      ASSERT_EQ(held[pair], 1) << pair.bodies.obstacle << ": " << pair.obstacle_triangle << ", " << pair.bodies.part
                               << ": " << pair.part_triangle << " at " << distance;
    }
  }
  EXPECT_GT(boxes, 50U);
  EXPECT_GT(triangles, 50U);
}

TEST_F(ProofFront, TellsLowerBoundsOfDistancesInAscendingOrder) {
  for (int trial = 0; trial < test_support::affordable(80); ++trial) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
    const double margin = random_margin();
    const auto surroundings = test_support::random_surroundings(kSize, margin, margin, random_);
    const std::span<const PlacedBody> bodies = surroundings->bodies();
    const std::vector<Obligation> obligations = obligations_of(*surroundings, random_.power_of_ten(-4.0, -3.0));
    EXPECT_TRUE(std::is_sorted(obligations.begin(), obligations.end(),
                               [](const Obligation& a, const Obligation& b) { return a.distance < b.distance; }));
    for (const Obligation& obligation : obligations) {
      ASSERT_NEAR(obligation.n_W.norm(), 1.0, 1e-12);
      for (const TrianglesOfBodies& pair : test_support::triangles_of(bodies, obligation)) {
        constexpr double kRounding = 1e-14;
        const double distance = test_support::distance_of(bodies, pair);
        const auto& O = bodies[static_cast<std::size_t>(pair.bodies.obstacle)];
        const auto& P = bodies[static_cast<std::size_t>(pair.bodies.part)];
        ASSERT_GE(distance, obligation.distance - kRounding);
        ASSERT_GE(gap_along(obligation.n_W, O.triangle_W(pair.obstacle_triangle), P.triangle_W(pair.part_triangle)),
                  obligation.distance - kRounding)
            << "from the obstacle to the part";
        // A direction between points a micrometre apart is good to 1e-10.
        if (obligation.item_O.kind == TreeItem::Kind::kTriangle) {
          ASSERT_NEAR(distance, obligation.distance, 1e-10);
        }
      }
    }
  }
}

TEST_F(ProofFront, LeavesOutBodiesThatAreIgnored) {
  int others = 0;
  for (int trial = 0; trial < test_support::affordable(40); ++trial) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
    const auto surroundings = test_support::random_surroundings(kSize, 1e-4, 1e-4, random_);
    const BodyPair ignored{0, static_cast<std::int32_t>(surroundings->body_of_part(0))};
    const std::vector<Obligation> all = obligations_of(*surroundings, 1e-3);
    const std::vector<Obligation> rest = obligations_of(*surroundings, 1e-3, {ignored});
    const auto of_ignored =
        std::count_if(all.begin(), all.end(), [&](const Obligation& o) { return o.bodies == ignored; });
    EXPECT_EQ(rest.size(), all.size() - static_cast<std::size_t>(of_ignored));
    for (const Obligation& obligation : rest)
      ASSERT_FALSE(obligation.bodies == ignored);
    others += rest.empty() ? 0 : 1;
  }
  EXPECT_GT(others, 0);
}

/// A plate one margin above another, each cut into so many triangles.
std::size_t obligations_of_flush_plates(std::int64_t triangles, double gap) {
  constexpr double kMargin = 2e-6;
  const Surroundings surroundings = [&] {
    std::vector<Obstacle> obstacles{test_support::obstacle_of(collision::make_plate({0.5, 0.5}, triangles))};
    Surroundings made(obstacles, {test_support::part_of(collision::make_plate({0.1, 0.06}, triangles))},
                      std::vector<double>{kMargin});
    made.place(0, test_support::pose({0.03, 0.02, gap * kMargin}, test_support::turn(0.4, Vector3d::UnitZ())));
    return made;
  }();
  return obligations_of(surroundings, 0.5e-3).size();
}

TEST_F(ProofFront, IsAsSmallForFinelyCutFlushPlatesAsForCoarseOnes) {
  EXPECT_LE(obligations_of_flush_plates(20, 1.0), 16U) << "the children of the roots";
  EXPECT_LE(obligations_of_flush_plates(5000, 1.0), 16U);
  EXPECT_GT(obligations_of_flush_plates(5000, 0.5), 300U) << "nearer than boxes are taken on";
}

}  // namespace
}  // namespace glissade::haptics
