// The energies of several hands.

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include <gtest/gtest.h>

#include "ledger_world.h"

namespace glissade::haptics {
namespace {

/// Ten million ticks: GLISSADE_LEDGER_TICKS=10000000.
TEST(Ledger, HandsTogetherGetNoMoreThanTheyPutInAndARestingHandFeelsOneForce) {
  const char* const wish = std::getenv("GLISSADE_LEDGER_TICKS");
  const int worlds = (wish != nullptr ? std::atoi(wish) : 120'000) / LedgerWorld::kTicks;
  double closest = -1e9;
  for (int seed = 1; seed <= worlds; ++seed) {
    SCOPED_TRACE(seed);
    LedgerWorld world(static_cast<std::uint64_t>(seed));
    while (world.ms() < LedgerWorld::kTicks) {
      world.step();
      ASSERT_LE(world.got(), world.allowance()) << world.ms();
      closest = std::max(closest, world.got() / world.allowance());
      for (std::size_t h = 0; h < world.hands(); ++h) {
        const LedgerWorld::Felt& felt = world.felt(h);
        const int rests_ms = world.ms() - std::max(felt.rests_since, LedgerWorld::kPressing + 300);
        if (rests_ms < 2000) continue;
        // A slow device asks for more energy in advance, and recovery gives it later.
        if (world.period_ms(h) < 10 || rests_ms >= 3000)
          EXPECT_GE(felt.share, 0.9) << "hand " << h << ", " << world.ms() << " ms";
        if (!felt.is_new) continue;
        EXPECT_LE(felt.change, 0.01 * std::max(felt.force, 1.0)) << "hand " << h << ", " << world.ms() << " ms";
        ASSERT_FALSE(felt.turns) << "hand " << h << ", " << world.ms() << " ms";
      }
    }
  }
  std::printf("the hands got at most %.2f of what is allowed beyond what they put in\n", closest);
}

}  // namespace
}  // namespace glissade::haptics
