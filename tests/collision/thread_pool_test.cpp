#include "pipeline/thread_pool.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace glissade::collision {
namespace {

constexpr double kMuch_ns = 1e9;
constexpr double kLittle_ns = 1e3;

TEST(ThreadPool, DoesEachPieceOnceHoweverItIsDivided) {
  for (const int threads : {1, 2, 4}) {
    ThreadPool pool(threads);
    for (const std::size_t count : {0U, 1U, 2U, 7U, 1000U}) {
      for (const std::size_t chunk : {1U, 3U, 5000U}) {
        std::vector<int> done(count, 0);
        std::vector<std::vector<int>> by_worker(static_cast<std::size_t>(threads));
        pool.for_each(count, chunk, kMuch_ns, [&](std::size_t begin, std::size_t end, int worker) {
          EXPECT_LE(end - begin, std::max(chunk, threads == 1 || count < 2 ? count : 1));
          for (std::size_t i = begin; i < end; ++i) {
            ++done[i];
            by_worker[static_cast<std::size_t>(worker)].push_back(static_cast<int>(i));  // nobody else has this number
          }
        });
        EXPECT_EQ(done, std::vector<int>(count, 1));
        std::size_t sum = 0;
        for (const auto& pieces : by_worker)
          sum += pieces.size();
        EXPECT_EQ(sum, count);
      }
    }
  }
}

// Jobs follow each other at once, or when everybody sleeps; their data live as long as the call.
TEST(ThreadPool, IsDoneWithAJobWhenTheCallReturns) {
  ThreadPool pool(3);
  for (int job = 0; job < 3000; ++job) {
    if (job % 1000 == 999) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    if (job % 100 == 50) pool.wake();
    std::vector<int> numbers(static_cast<std::size_t>(2 + job % 20), 0);
    pool.for_each(numbers.size(), 1 + static_cast<std::size_t>(job % 3), kMuch_ns,
                  [&](std::size_t begin, std::size_t end, int) {
                    for (std::size_t i = begin; i < end; ++i)
                      numbers[i] += job;
                  });
    ASSERT_EQ(numbers, std::vector<int>(numbers.size(), job));
  }
}

TEST(ThreadPool, SharesWork) {
  ThreadPool pool(2);
  // Whoever comes first waits for the other, for longer than any machine needs.
  std::atomic<int> here{0};
  pool.for_each(2, 1, kMuch_ns, [&](std::size_t, std::size_t, int) {
    ++here;
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (here < 2 && std::chrono::steady_clock::now() < deadline)
      std::this_thread::yield();
    EXPECT_EQ(here, 2) << "nobody else came";
  });
}

TEST(ThreadPool, KeepsLittleWorkInTheCallingThread) {
  ThreadPool pool(4);
  const auto caller = std::this_thread::get_id();
  int calls = 0;
  pool.for_each(100, 1, kLittle_ns, [&](std::size_t begin, std::size_t end, int worker) {
    EXPECT_EQ(worker, 0);
    EXPECT_EQ(std::this_thread::get_id(), caller);
    EXPECT_EQ(begin, 0U);
    EXPECT_EQ(end, 100U);
    ++calls;
  });
  EXPECT_EQ(calls, 1);
}

TEST(ThreadPool, TakesAsManyThreadsAsTheMachineHasUnlessToldOtherwise) {
  EXPECT_GE(ThreadPool(0).threads(), 1);
  EXPECT_EQ(ThreadPool(3).threads(), 3);
}

}  // namespace
}  // namespace glissade::collision
