// Which gaps are small, beside plain loops.

#include "certificate/plane_kernel.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "every_instruction_set.h"
#include "random_numbers.h"

namespace glissade::contact {
namespace {

using test_support::RandomNumbers;

constexpr float kInfinite = std::numeric_limits<float>::infinity();
constexpr std::size_t kBlocks = 3;

class PlaneKernel : public test_support::EveryInstructionSet {
 protected:
  static constexpr std::uint64_t kSeed = 71;
  static constexpr int kTrials = 200;

  PlaneKernel() : random_(kSeed) { RecordProperty("seed", static_cast<int>(kSeed)); }

  /// Some numbers about zero; some are infinite.
  std::vector<float> numbers(std::size_t count) {
    std::vector<float> all;
    for (std::size_t i = 0; i < count; ++i) {
      all.push_back(static_cast<float>(random_.uniform(-1e-4, 1e-4)));
      if (random_.chance(0.1)) all.back() = random_.chance(0.5) ? kInfinite : -kInfinite;
    }
    return all;
  }
  /// Numbers that may be a limit: now and then, one of `among`.
  float limit(const std::vector<float>& among) {
    const float at_random = static_cast<float>(random_.uniform(-1e-4, 1e-4));
    return random_.chance(0.5) ? among[static_cast<std::size_t>(random_.integer(0, 15))] : at_random;
  }

  RandomNumbers random_;
};

TEST_P(PlaneKernel, RaisesGapsToTheKnownGapsMinusTheClock) {
  for (int trial = 0; trial < kTrials; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    const std::vector<float> known = numbers(kBlocks * kPlanesAtOnce);
    const std::vector<float> gaps = numbers(kBlocks * kPlanesAtOnce);
    const auto clock = static_cast<float>(random_.uniform(0.0, 1e-4));
    std::vector<float> raised = gaps;
    std::array<float, kBlocks> least{};
    raise_gaps(known, clock, raised.data(), least.data());
    for (std::size_t i = 0; i < gaps.size(); ++i) {
      const double still_known = static_cast<double>(known[i]) - static_cast<double>(clock);
      const double exact = std::max(static_cast<double>(gaps[i]), still_known);
      ASSERT_TRUE(exact <= 0.0 || static_cast<double>(raised[i]) <= exact);
      ASSERT_GE(raised[i], gaps[i]);
      ASSERT_GE(static_cast<double>(raised[i]), std::min(exact, 1.0) - 1e-9);
    }
    for (std::size_t block = 0; block < kBlocks; ++block) {
      const auto first = raised.begin() + static_cast<std::ptrdiff_t>(kPlanesAtOnce * block);
      ASSERT_EQ(least[block], *std::min_element(first, first + kPlanesAtOnce));
    }
  }
}

TEST_P(PlaneKernel, FindsThePairsWithinALimit) {
  for (int trial = 0; trial < kTrials; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    const std::vector<float> gaps = numbers(kPlanesAtOnce);
    const float most = limit(gaps);
    const PairsOfBlock pairs = find_pairs_within(most, gaps.data());
    for (std::size_t i = 0; i < kPlanesAtOnce; ++i)
      ASSERT_EQ((pairs >> i & 1) != 0, gaps[i] <= most) << "pair " << i;
  }
}

TEST_P(PlaneKernel, FindsUnprovedPairs) {
  for (int trial = 0; trial < kTrials; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    const std::vector<float> at_begin = numbers(kPlanesAtOnce);
    const std::vector<float> at_end = numbers(kPlanesAtOnce);
    const NeededGaps needed{limit(at_begin), limit(at_end), limit(at_begin)};
    PlaneBlock block{};
    for (float& turns_with_part : block.turns_with_part)
      turns_with_part = random_.chance(0.5) ? 1.0F : 0.0F;
    const PairsOfBlock pairs = find_unproved(block, needed, at_begin.data(), at_end.data());
    for (std::size_t i = 0; i < kPlanesAtOnce; ++i) {
      const float enough = block.turns_with_part[i] > 0.0F ? needed.turning : needed.fixed;
      const bool is_proved = at_begin[i] > needed.far || (at_begin[i] >= enough && at_end[i] >= enough);
      ASSERT_EQ((pairs >> i & 1) != 0, !is_proved) << "pair " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, PlaneKernel, PlaneKernel::all(), PlaneKernel::name);

}  // namespace
}  // namespace glissade::contact
