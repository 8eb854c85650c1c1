#include <atomic>
#include <cstdint>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/realtime/spsc_ring.h>

namespace glissade::realtime {
namespace {

TEST(SpscRing, PopsWhatWaitsAndNotWhatIsPushedMeanwhile) {
  SpscRing<int> ring(4);
  for (const int value : {1, 2, 3})
    ring.push(value);
  std::vector<int> taken;
  const auto take = [&](int value) {
    taken.push_back(value);
    ring.push(value + 10);
  };
  ring.pop_waiting(take);
  EXPECT_EQ(taken, (std::vector<int>{1, 2, 3}));
  ring.pop_waiting(take);
  EXPECT_EQ(taken, (std::vector<int>{1, 2, 3, 11, 12, 13}));
}

TEST(SpscRing, GivesBackInOrder) {
  SpscRing<int> ring(4);
  int value = -1;
  EXPECT_FALSE(ring.pop(value));
  EXPECT_EQ(value, -1);
  for (int round = 0; round < 10; ++round) {
    EXPECT_TRUE(ring.push(2 * round));
    EXPECT_TRUE(ring.push(2 * round + 1));
    ASSERT_TRUE(ring.pop(value));
    EXPECT_EQ(value, 2 * round);
    ASSERT_TRUE(ring.pop(value));
    EXPECT_EQ(value, 2 * round + 1);
  }
  EXPECT_EQ(ring.dropped(), 0U);
}

TEST(SpscRing, DropsTheNewestWhenFullAndCounts) {
  SpscRing<int> ring(3);
  ASSERT_EQ(ring.capacity(), 4U);
  for (int i = 0; i < 7; ++i)
    EXPECT_EQ(ring.push(i), i < 4);
  EXPECT_EQ(ring.dropped(), 3U);
  int value = 0;
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(ring.pop(value));
    EXPECT_EQ(value, i);
  }
  EXPECT_FALSE(ring.pop(value));
  EXPECT_TRUE(ring.push(7));
}

TEST(SpscRing, RefusesCapacityZero) {
  EXPECT_THROW(SpscRing<int>(0), std::invalid_argument);
}

// Everything that was pushed arrives once, in order and whole, or is counted as dropped.
TEST(SpscRing, EveryValueArrivesOrIsCountedAsDropped) {
  constexpr std::uint64_t kValues = 100000;
  struct Pair {
    std::uint64_t first;
    std::uint64_t second;
  };
  SpscRing<Pair> ring(64);
  std::uint64_t popped = 0;
  std::uint64_t last = 0;
  bool is_whole = true;
  bool is_rising = true;
  std::atomic<bool> done{false};

  std::thread consumer([&] {
    Pair value{};
    for (;;) {
      const bool was_done = done.load(std::memory_order_acquire);
      if (ring.pop(value)) {
        is_whole = is_whole && value.second == ~value.first;
        is_rising = is_rising && value.first > last;
        last = value.first;
        ++popped;
      } else if (was_done) {
        return;
      } else {
        std::this_thread::yield();
      }
    }
  });
  std::uint64_t pushed = 0;
  for (std::uint64_t i = 1; i <= kValues; ++i) {
    if (ring.push({i, ~i})) ++pushed;
    if (i % 256 == 0) std::this_thread::yield();
  }
  done.store(true, std::memory_order_release);
  consumer.join();

  EXPECT_TRUE(is_whole);
  EXPECT_TRUE(is_rising);
  EXPECT_EQ(popped, pushed);
  EXPECT_EQ(pushed + ring.dropped(), kValues);
}

}  // namespace
}  // namespace glissade::realtime
