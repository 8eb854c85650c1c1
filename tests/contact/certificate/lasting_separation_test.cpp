// The directions in which triangles stay apart: what is told of them is true, they last where the triangles slide, and
// every instruction set finds the same.

#include "certificate/lasting_separation.h"

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/geometry/displacement.h>

#include "every_instruction_set.h"
#include "random_numbers.h"
#include "sanitizers.h"

namespace glissade::contact {
namespace {

using Eigen::Vector3d;
using geometry::TrianglePoints;
using test_support::RandomNumbers;

constexpr double kGap = 1e-6;           // metres
constexpr double kGapTurning = 1.1e-6;  // metres

double gap_of(const Separation& separation) {
  return separation.turns_with_part ? kGapTurning : kGap;
}

TrianglePoints triangle_near(const Vector3d& place, RandomNumbers& random) {
  return {place + random.point(1e-3), place + random.point(1e-3), place + random.point(1e-3)};
}

TrianglePoints mapped(const CornerMap& map, const TrianglePoints& triangle) {
  return {map.A * triangle[0] + map.t, map.A * triangle[1] + map.t, map.A * triangle[2] + map.t};
}

CornerMap random_pose(RandomNumbers& random, double translation) {
  const double angle = random.power_of_ten(-3.0, -1.0);
  return {Eigen::AngleAxisd(angle, random.direction()).toRotationMatrix(), translation * random.direction()};
}

/// A few pairs of triangles, in the frames of their bodies, and a path of the part.
struct PairsOfTrial {
  explicit PairsOfTrial(RandomNumbers& random)
      : begin(random_pose(random, 1e-4)), end(random_pose(random, random.power_of_ten(-6.0, -3.0))) {
    for (int i = random.integer(1, geometry::kPairsToMeasure); i > 0; --i) {
      obstacle.push_back(triangle_near(Vector3d::Zero(), random));
      may_turn_with_part.push_back(random.chance(0.7));
      part.push_back(triangle_near(2e-3 * random.direction(), random));
    }
  }

  std::vector<Separation> separations() const {
    LastingSeparations separations;
    separations.start(begin, end, kGap, kGapTurning);
    for (std::size_t i = 0; i < part.size(); ++i)
      separations.add(obstacle[i], part[i], may_turn_with_part[i]);
    const std::span<const Separation> found = separations.find_or_turn();
    return {found.begin(), found.end()};
  }

  Vector3d direction_at_end(const Separation& separation) const {
    return separation.turns_with_part ? end.A * (begin.A.transpose() * separation.n_O) : separation.n_O;
  }

  CornerMap begin;
  CornerMap end;
  std::vector<TrianglePoints> obstacle;
  std::vector<TrianglePoints> part;
  std::vector<bool> may_turn_with_part;
};

class LastingSeparation : public test_support::EveryInstructionSet {};

TEST_P(LastingSeparation, GapsAtBothEndsHoldAndNeverExceedTheDistance) {
  constexpr std::uint64_t kSeed = 93;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomNumbers random(kSeed);
  int apart = 0;
  int certified = 0;
  int turning = 0;
  for (int trial = 0; trial < test_support::affordable(1000); ++trial) {
    const PairsOfTrial pairs(random);
    const std::vector<Separation> separations = pairs.separations();
    ASSERT_EQ(separations.size(), pairs.part.size());
    for (std::size_t i = 0; i < separations.size(); ++i) {
      SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial) + ", pair " +
                   std::to_string(i));
      const TrianglePoints part_at_begin = mapped(pairs.begin, pairs.part[i]);
      const double at_begin = geometry::triangle_distance(pairs.obstacle[i], part_at_begin).distance;
      const TrianglePoints part_at_end = mapped(pairs.end, pairs.part[i]);
      const double at_end = geometry::triangle_distance(pairs.obstacle[i], part_at_end).distance;
      if (at_begin > kGap && at_end > kGap) ++apart;
      const Separation& separation = separations[i];
      ASSERT_TRUE(pairs.may_turn_with_part[i] || !separation.turns_with_part);
      if (!(separation.least() >= gap_of(separation))) continue;
      ++certified;
      turning += separation.turns_with_part ? 1 : 0;
      ASSERT_NEAR(separation.n_O.norm(), 1.0, 1e-12);
      const Vector3d n_end = pairs.direction_at_end(separation);
      ASSERT_LE(separation.begin, at_begin + 1e-15);
      ASSERT_LE(separation.end, at_end + 1e-15);
      for (const Vector3d& y : pairs.obstacle[i]) {
        for (const Vector3d& x : part_at_begin)
          ASSERT_GE(separation.n_O.dot(x - y), separation.begin - 1e-15) << "from the obstacle to the part";
        for (const Vector3d& x : part_at_end)
          ASSERT_GE(n_end.dot(x - y), separation.end - 1e-15) << "on the same side";
      }
    }
  }
  EXPECT_GT(certified, apart / 2);
  EXPECT_GT(turning, certified / 20);
  EXPECT_LT(turning, certified);
}

TrianglePoints between(const TrianglePoints& begin, const TrianglePoints& end, double t) {
  return {begin[0] + t * (end[0] - begin[0]), begin[1] + t * (end[1] - begin[1]), begin[2] + t * (end[2] - begin[2])};
}

TEST_P(LastingSeparation, TurningDirectionSeparatesOnTheWholeStraightPath) {
  constexpr std::uint64_t kSeed = 97;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomNumbers random(kSeed);
  int sought = 0;
  int certified = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const PairsOfTrial pairs(random);
    const std::vector<Separation> separations = pairs.separations();
    for (std::size_t i = 0; i < separations.size(); ++i) {
      SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial) + ", pair " +
                   std::to_string(i));
      const double turning = separations[i].turning;
      if (separations[i].least() >= gap_of(separations[i])) {
        ASSERT_EQ(turning, -std::numeric_limits<double>::infinity()) << "it is sought where no other serves";
        continue;
      }
      ++sought;
      if (!(turning >= kGap)) continue;
      ++certified;
      const TrianglePoints begin = mapped(pairs.begin, pairs.part[i]);
      const TrianglePoints end = mapped(pairs.end, pairs.part[i]);
      for (int moment = 0; moment <= 20; ++moment) {
        const TrianglePoints part = between(begin, end, 0.05 * moment);
        ASSERT_GE(geometry::triangle_distance(pairs.obstacle[i], part).distance, turning - 1e-15) << moment;
      }
    }
  }
  EXPECT_GT(certified, sought / 1000);
  EXPECT_GT(certified, 0);
}

// Two needles that cross, and turn past each other: along any fixed direction, an end of one goes through the other.
TEST_P(LastingSeparation, CrossingNeedlesAreSeparatedByATurningDirection) {
  LastingSeparations separations;
  const auto about_y = [](double angle) {
    return CornerMap{Eigen::AngleAxisd(angle, Vector3d::UnitY()).toRotationMatrix(), Vector3d(0.0, 0.0, 0.002)};
  };
  separations.start(about_y(-0.005), about_y(0.005), 1e-3, 1e-3);
  separations.add({Vector3d(0.0, -1.0, 0.0), Vector3d(0.0, 1.0, 0.0), Vector3d(0.0, 1.0, -1e-4)},
                  {Vector3d(-1.0, 0.0, 0.0), Vector3d(1.0, 0.0, 0.0), Vector3d(1.0, 0.0, 1e-4)}, false);
  const Separation separation = separations.find_or_turn().front();
  EXPECT_LT(separation.least(), 0.0);
  EXPECT_GT(separation.turning, 1.9e-3);
}

// A facet of a ring about a shaft: an end of it goes through any plane that stays, but its own plane keeps the shaft
// apart wherever the ring turns.
TEST_P(LastingSeparation, RingRotatingAboutAShaftGetsADirectionFixedToTheRing) {
  for (const bool may_turn_with_part : {true, false}) {
    LastingSeparations separations;
    const auto about_z = [](double angle) {
      return CornerMap{Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix(), Vector3d::Zero()};
    };
    separations.start(about_z(0.0), about_z(0.02), 1e-3, 1e-3);
    separations.add({Vector3d(-1e-3, 1.0, -1.0), Vector3d(1e-3, 1.0, -1.0), Vector3d(0.0, 1.0, 1.0)},
                    {Vector3d(-1.0, 1.01, -1.0), Vector3d(1.0, 1.01, -1.0), Vector3d(0.0, 1.01, 1.0)},
                    may_turn_with_part);
    const Separation separation = separations.find().front();
    EXPECT_EQ(separation.turns_with_part, may_turn_with_part);
    if (!may_turn_with_part) continue;
    EXPECT_NEAR(separation.n_O.y(), 1.0, 1e-12);
    EXPECT_NEAR(separation.least(), 0.01, 1e-3);
    EXPECT_NEAR(separations.direction(separation).n.y(), 1.0, 1e-12);
  }
}

// The closest points lie ahead, along the way of the triangle: a direction through them fails on the next step.
TEST_P(LastingSeparation, TriangleSlidingOverAPlaneGetsThePlaneNormal) {
  LastingSeparations separations;
  const CornerMap begin{Eigen::Matrix3d::Identity(), Vector3d::Zero()};
  separations.start(begin, {begin.A, Vector3d(0.09, 0.0, 0.0)}, 1e-3, 1e-3);
  separations.add({Vector3d(0.0, -1.0, 0.0), Vector3d(2.0, 0.0, 0.0), Vector3d(0.0, 1.0, 0.0)},
                  {Vector3d(-1.0, -0.5, 0.01), Vector3d(-0.1, 0.0, 0.01), Vector3d(-1.0, 0.5, 0.01)}, true);
  const Separation separation = separations.find().front();
  EXPECT_NEAR(separation.n_O.z(), 1.0, 1e-12);
  EXPECT_NEAR(separation.begin, 0.01, 1e-12);
  EXPECT_NEAR(separation.end, 0.01, 1e-12);
}

// Two edges that cross: neither normal separates the triangles, only the direction from edge to edge.
TEST_P(LastingSeparation, CrossingEdgesGetTheClosestPointDirection) {
  LastingSeparations separations;
  const CornerMap begin{Eigen::Matrix3d::Identity(), Vector3d::Zero()};
  separations.start(begin, {begin.A, Vector3d(0.0, 0.0, 0.001)}, 1e-3, 1e-3);
  separations.add({Vector3d(-1.0, 0.0, 0.0), Vector3d(1.0, 0.0, 0.0), Vector3d(0.0, 0.1, -1.0)},
                  {Vector3d(0.0, -1.0, 0.01), Vector3d(0.0, 1.0, 0.01), Vector3d(0.1, 0.0, 1.0)}, true);
  const Separation separation = separations.find().front();
  EXPECT_NEAR(separation.n_O.z(), 1.0, 1e-12);
  EXPECT_NEAR(separation.begin, 0.01, 1e-12);
  EXPECT_NEAR(separation.end, 0.011, 1e-12);
}

// Where a part turns and nothing else serves.
TEST_P(LastingSeparation, SometimesUsesTheClosestPointsAtTheEnd) {
  constexpr std::uint64_t kSeed = 96;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomNumbers random(kSeed);
  const auto are_alike = [](const Vector3d& n, const Vector3d& other) { return n.cross(other).norm() < 1e-9; };
  const auto normal = [](const TrianglePoints& t) -> Vector3d { return (t[1] - t[0]).cross(t[2] - t[0]).normalized(); };
  int found_at_end = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const PairsOfTrial pairs(random);
    const std::vector<Separation> separations = pairs.separations();
    for (std::size_t i = 0; i < separations.size(); ++i) {
      if (!(separations[i].least() >= gap_of(separations[i]))) continue;
      const Vector3d& n = separations[i].n_O;
      const TrianglePoints part_at_begin = mapped(pairs.begin, pairs.part[i]);
      const auto closest = [&](const TrianglePoints& part) -> Vector3d {
        const geometry::TriangleDistance points = geometry::triangle_distance(pairs.obstacle[i], part);
        return (points.p_b - points.p_a).normalized();
      };
      if (are_alike(n, closest(mapped(pairs.end, pairs.part[i]))) && !are_alike(n, closest(part_at_begin)) &&
          !are_alike(n, normal(pairs.obstacle[i])) && !are_alike(n, normal(part_at_begin)))
        ++found_at_end;
    }
  }
  EXPECT_GT(found_at_end, 0);
}

// A pair's direction does not depend on the others that are looked at with it.
TEST_P(LastingSeparation, PairsOfABatchAreIndependent) {
  constexpr std::uint64_t kSeed = 95;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomNumbers random(kSeed);
  for (int trial = 0; trial < test_support::affordable(300); ++trial) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
    const PairsOfTrial pairs(random);
    const std::vector<Separation> found = pairs.separations();
    for (std::size_t i = 0; i < found.size(); ++i) {
      PairsOfTrial alone = pairs;
      alone.obstacle = {pairs.obstacle[i]};
      alone.part = {pairs.part[i]};
      alone.may_turn_with_part = {pairs.may_turn_with_part[i]};
      ASSERT_EQ(alone.separations().front().n_O, found[i].n_O);
      ASSERT_EQ(alone.separations().front().turns_with_part, found[i].turns_with_part);
    }
  }
}

TEST_P(LastingSeparation, VectorCodeMatchesScalarCodeBitwise) {
  constexpr std::uint64_t kSeed = 94;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomNumbers random(kSeed);
  for (int trial = 0; trial < test_support::affordable(500); ++trial) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
    const PairsOfTrial pairs(random);
    const std::vector<Separation> found = pairs.separations();
    collision::use_instruction_set(collision::InstructionSet::kScalar);
    const std::vector<Separation> expected = pairs.separations();
    collision::use_instruction_set(GetParam());
    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_EQ(found[i].n_O, expected[i].n_O);
      ASSERT_EQ(found[i].turns_with_part, expected[i].turns_with_part);
      ASSERT_EQ(found[i].begin, expected[i].begin);
      ASSERT_EQ(found[i].end, expected[i].end);
      ASSERT_EQ(found[i].turning, expected[i].turning);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, LastingSeparation, LastingSeparation::all(), LastingSeparation::name);

}  // namespace
}  // namespace glissade::contact
