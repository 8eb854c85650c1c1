// The order of pairs by their distances.

#include "search/nearest_first.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "random_numbers.h"

namespace glissade::contact {
namespace {

struct PairOfTest {
  double distance;
  std::uint32_t number;

  bool operator==(const PairOfTest&) const = default;
};

TEST(NearestFirst, IsAStableSort) {
  constexpr std::uint64_t kSeed = 5;
  RecordProperty("seed", static_cast<int>(kSeed));
  test_support::RandomNumbers random(kSeed);
  NearestFirst nearest_first;
  for (const std::uint32_t count : {0U, 1U, 2U, 30U, 3000U}) {
    std::vector<PairOfTest> pairs;
    for (std::uint32_t i = 0; i < count; ++i) {
      const double last = pairs.empty() ? -0.0 : pairs.back().distance;
      const double distance = random.uniform(-1.0, 1.0) * random.power_of_ten(-12.0, 0.0);
      pairs.push_back({random.chance(0.3) ? last : static_cast<double>(static_cast<float>(distance)), i});
    }
    std::vector<PairOfTest> expected = pairs;
    std::stable_sort(expected.begin(), expected.end(),
                     [](const PairOfTest& a, const PairOfTest& b) { return a.distance < b.distance; });
    std::vector<PairOfTest> scratch{{1.0, 7}};
    nearest_first.sort(pairs, scratch);
    EXPECT_EQ(pairs, expected);
  }
}

}  // namespace
}  // namespace glissade::contact
