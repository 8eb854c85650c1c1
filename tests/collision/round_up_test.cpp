#include "kernels/round_up.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "random_numbers.h"

namespace glissade::collision {
namespace {

// The nearest float, or the next one where that is less.
float expected(double value) {
  const auto nearest = static_cast<float>(value);
  return static_cast<double>(nearest) < value ? std::nextafter(nearest, std::numeric_limits<float>::infinity())
                                              : nearest;
}

TEST(RoundUp, GivesTheSmallestFloatThatIsNotLess) {
  constexpr unsigned kSeed = 26;
  RecordProperty("seed", static_cast<int>(kSeed));
  test_support::RandomNumbers random(kSeed);
  for (int trial = 0; trial < 100000; ++trial) {
    const double value = random.power_of_ten(-44.0, 38.0) * (random.chance(0.5) ? 1.0 : -1.0);
    ASSERT_EQ(round_up_to_float(value), expected(value)) << value;
  }
  for (const double value : {0.0, -0.0, 1.0, -1.0, 1.0 + 1e-12, -1.0 + 1e-12, 1e-50, -1e-50})
    EXPECT_EQ(round_up_to_float(value), expected(value)) << value;
}

}  // namespace
}  // namespace glissade::collision
