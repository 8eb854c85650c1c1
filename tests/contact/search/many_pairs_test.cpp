// Candidates where very many pairs are near: a ball in a socket.

#include <algorithm>
#include <cstddef>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <glissade/geometry/displacement.h>
#include <glissade/geometry/mesh_generators.h>

#include "candidates.h"
#include "held_part.h"
#include "search/candidate_pairs.h"

namespace glissade::contact {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::pairs_to_certify_within;

/// A ball of this radius (metres), with a play of 0.1 mm.
ContactScene ball_with_play(double radius) {
  return {{test_support::obstacle_of(geometry::make_sphere(radius + 0.1e-3, 4000))},
          {test_support::part_of(geometry::make_sphere(radius, 4000))},
          std::vector<double>{1e-6}};
}

class ManyPairs : public testing::Test {
 protected:
  explicit ManyPairs(double radius = 0.01) : scene_(ball_with_play(radius)) {}

  std::size_t count_within(double radius) {
    CandidatePairs candidates(scene_, greatest_radius_m_);
    candidates.look(radius, 0.0, {});
    return candidates.pairs().search().set.pair_and_box_count();
  }

  double greatest_radius_m_ = 5e-3;
  ContactScene scene_;
};

class VeryManyPairs : public ManyPairs {
 protected:
  VeryManyPairs() : ManyPairs(0.02) {}
};

TEST_F(ManyPairs, SearchBeyondTheLimitKeepsTheLastCandidates) {
  constexpr double kRadius = 0.11e-3;
  constexpr double kLarger = 0.3e-3;
  constexpr double kTooLarge = 2.5e-3;
  const std::size_t few = count_within(kRadius);
  const std::size_t most_pairs = 2 * count_within(kTooLarge) / 3;
  ASSERT_GT(few, 100U);
  for (const bool has_thread : {false, true}) {
    CandidatePairs candidates(scene_, greatest_radius_m_, has_thread, kUnlimitedWork, true, most_pairs);
    ASSERT_TRUE(candidates.look(kRadius, 0.0, {}));
    EXPECT_FALSE(candidates.look(kTooLarge, 0.0, {}));
    EXPECT_TRUE(candidates.found_too_many());
    EXPECT_TRUE(candidates.is_too_large());
    EXPECT_EQ(candidates.pairs().search().set.pair_and_box_count(), few);
    EXPECT_NEAR(candidates.covered(), kRadius, 1e-9);
    candidates.cancel();
    EXPECT_TRUE(candidates.look(kLarger, 0.0, {}));
    EXPECT_FALSE(candidates.is_too_large());
    EXPECT_GT(candidates.pairs().search().set.pair_and_box_count(), few);
    EXPECT_FALSE(candidates.are_many());
    EXPECT_FALSE(candidates.look(kTooLarge, 0.0, {}));
    candidates.allow_twice_as_many();
    EXPECT_TRUE(candidates.look(kTooLarge, 0.0, {}));
    EXPECT_TRUE(candidates.are_many());
  }
}

TEST_F(ManyPairs, AreManyAboveHalfTheLimit) {
  constexpr double kRadius = 0.3e-3;
  CandidatePairs candidates(scene_, greatest_radius_m_);
  candidates.look(kRadius, 0.0, {});
  const CandidateSet& set = candidates.pairs().search().set;
  ASSERT_GT(set.pairs.size(), 2U);
  ASSERT_GT(set.boxes.size(), 2U);
  const auto are_many = [&](std::size_t most_pairs) {
    CandidatePairs limited(scene_, greatest_radius_m_, false, kUnlimitedWork, true, most_pairs);
    limited.look(kRadius, 0.0, {});
    return limited.are_many();
  };
  EXPECT_TRUE(are_many(2 * set.pair_and_box_count() - 2));
  EXPECT_FALSE(are_many(2 * set.pair_and_box_count()));
}

TEST_F(VeryManyPairs, AreCertifiedByTrianglesAloneInTheNextSearch) {
  constexpr double kNear = 0.3e-3;
  CandidatePairs candidates(scene_, greatest_radius_m_);
  const auto count_boxes = [&] {
    candidates.look(kNear, 0.0, {});
    const std::vector<PairToCertify> to_certify = pairs_to_certify_within(candidates, kNear);
    return std::count_if(to_certify.begin(), to_certify.end(),
                         [](const PairToCertify& pair) { return pair.item_O.kind != TreeItem::Kind::kTriangle; });
  };
  EXPECT_GT(count_boxes(), 100);
  candidates.clear();
  EXPECT_EQ(count_boxes(), 0);
  EXPECT_GT(candidates.pairs().pair_count(), 5000U);
}

// The planes of a search are made to last for the step in which its answer is first needed.
TEST_F(VeryManyPairs, SearchRequestPredictsTheFirstStep) {
  constexpr double kReach = 0.1e-3;
  constexpr double kAhead = 0.2e-3;
  CandidatePairs candidates(scene_, greatest_radius_m_);
  const geometry::Displacement turn{Vector3d::Zero(), Vector3d(2e-3, 1e-3, 0.0)};
  const double step = geometry::motion_bound(turn, scene_.movers()[0]->radius());
  const std::size_t ball = scene_.body_of_mover(0);
  int expected = 0;
  for (int tick = 0; tick < 40; ++tick) {
    const bool is_other = candidates.take_ahead(kReach, step) || candidates.look(kReach, kAhead, {});
    const ExpectedStep& first_step = candidates.pairs().search().request.first_step;
    const Isometry3d& X_WV = scene_.bodies()[ball].X_WB;
    const Isometry3d X_after = geometry::displaced(X_WV, scene_.movers()[0]->p_Vref(), turn);
    if (is_other && first_step.is_known()) {
      ++expected;
      const Isometry3d& X_begin = first_step.X_WB_begin.front();
      const Isometry3d& X_end = first_step.X_WB_end.front();
      EXPECT_LT((X_begin.matrix() - X_WV.matrix()).norm(), 3.0 * turn.w.norm());
      EXPECT_LT((X_end.matrix() - X_after.matrix()).norm(), 3.0 * turn.w.norm());
      EXPECT_NEAR(Eigen::AngleAxisd(X_begin.linear().transpose() * X_end.linear()).angle(), turn.w.norm(),
                  0.1 * turn.w.norm());
    }
    candidates.look_ahead(step, kReach, kAhead, {});
    scene_.place(0, X_after);
    candidates.moved();
  }
  ASSERT_GT(candidates.pairs().pair_count(), 5000U);
  EXPECT_GT(expected, 3);
  candidates.clear();
  candidates.look(kReach, kAhead, {});
  EXPECT_FALSE(candidates.pairs().search().request.first_step.is_known()) << "no step is expected";
}

}  // namespace
}  // namespace glissade::contact
