#include "kernels/front_kernels.h"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "kernel_fixture.h"

namespace glissade::collision {
namespace {

class FrontKernels : public Kernels {};

TEST_P(FrontKernels, FindsExpiredEntriesInOrder) {
  for (int trial = 0; trial < 200; ++trial) {
    const float clock = random_.chance(0.5) ? 0.5F : 1e30F;
    std::vector<float> expiry(kFrontPadding * static_cast<std::size_t>(random_.integer(0, 9)));
    std::vector<std::uint32_t> expected;
    for (std::size_t i = 0; i < expiry.size(); ++i) {
      expiry[i] = static_cast<float>(random_.uniform(0.0, 1.0));
      if (random_.chance(0.2)) expiry[i] = clock;
      if (random_.chance(0.2)) expiry[i] = std::numeric_limits<float>::infinity();
      if (expiry[i] <= clock) expected.push_back(static_cast<std::uint32_t>(i));
    }
    std::vector<std::uint32_t> expired(expiry.size(), 7);
    expired.resize(find_expired(expiry, clock, expired));
    EXPECT_EQ(expired, expected);
  }
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, FrontKernels, ::testing::ValuesIn(available_instruction_sets()),
                         [](const auto& test) { return std::string(name_of(test.param)); });

}  // namespace
}  // namespace glissade::collision
