// Where a search would find too many pairs of triangles, the next one looks less far, whichever search it was.

#include "cycle/search_radius.h"

#include <cstdint>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/geometry/mesh_generators.h>

#include "held_part.h"
#include "sanitizers.h"

namespace glissade::contact {
namespace {

constexpr double kFast_m = 2e-3;  // in a tick

/// A ball in a socket: within 1 mm are more pairs than the memory of a search may hold.
class SearchRadiusInSocket : public ::testing::TestWithParam<std::optional<std::int64_t>> {
 protected:
  SearchRadiusInSocket()
      : shared_({test_support::obstacle_of(geometry::make_sphere(0.0101, 14'000))},
                {{.part_V = test_support::part_of(geometry::make_sphere(0.01, 14'000))}}, {},
                {.work_budget = GetParam()}) {
    shared_.states.front().slew = kFast_m;
  }
  void SetUp() override {
    if (test_support::kSanitized) GTEST_SKIP() << "millions of pairs take minutes; near_pairs_test has the limit";
  }

  /// Looks until the candidates cover what a cycle needs. Returns the reach of each look.
  std::vector<double> look_until_covered(SearchRadius& radius, double ghost_motion, bool is_first_cycle) {
    shared_.states.front().ghost_motion = ghost_motion;
    std::vector<double> reaches;
    do {
      shared_.candidates.begin_call();
      radius.choose(shared_, 0.0, 1.0, is_first_cycle);
      radius.look(shared_, {});
      reaches.push_back(radius.reach());
    } while (!shared_.candidates.covers(radius.needed()) && reaches.size() < 20);
    return reaches;
  }

  SimulatedParts shared_;
};

TEST_P(SearchRadiusInSocket, ShrinksWhereASearchFindsTooMany) {
  SearchRadius radius;
  const std::vector<double> reaches = look_until_covered(radius, kFast_m, true);
  ASSERT_EQ(reaches.size(), 2U);
  EXPECT_LE(reaches.back(), 0.25 * reaches.front());
}

// The search along a way that was missed begins where nothing is known yet of what is there.
TEST_P(SearchRadiusInSocket, ShrinksWhereASearchAlongAMissedWayFindsTooMany) {
  SearchRadius radius;
  ASSERT_EQ(look_until_covered(radius, 0.0, true).size(), 1U);
  Step step;
  step.length = 0.1e-3;
  step.is_reach_short = true;
  step.missed[0].v.x() = kFast_m;
  radius.note(shared_, step);
  const std::vector<double> reaches = look_until_covered(radius, kFast_m, false);
  ASSERT_EQ(reaches.size(), 2U);
  EXPECT_LE(reaches.back(), 0.25 * reaches.front());
}

// With and without a limit of work that suffices for every search here.
INSTANTIATE_TEST_SUITE_P(WorkBudgets, SearchRadiusInSocket,
                         ::testing::Values(std::nullopt, std::optional<std::int64_t>(10'000'000'000)));

}  // namespace
}  // namespace glissade::contact
