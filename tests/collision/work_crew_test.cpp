#include "work_crew.h"

#include <numeric>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace glissade::collision {
namespace {

constexpr double kMuch_ns = 1e9;
constexpr double kLittle_ns = 1e3;

TEST(WorkCrew, DoesEachPieceOnceHoweverItIsDivided) {
  for (const int threads : {1, 2, 4}) {
    WorkCrew crew(threads);
    for (const std::size_t count : {0U, 1U, 2U, 7U, 1000U}) {
      for (const std::size_t chunk : {1U, 3U, 5000U}) {
        std::vector<int> done(count, 0);
        std::vector<std::vector<int>> by_worker(static_cast<std::size_t>(threads));
        crew.for_each(count, chunk, kMuch_ns, [&](std::size_t i, int worker) {
          ++done[i];
          by_worker[static_cast<std::size_t>(worker)].push_back(static_cast<int>(i));  // nobody else has this number
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

TEST(WorkCrew, KeepsLittleWorkInTheCallingThread) {
  WorkCrew crew(4);
  const auto caller = std::this_thread::get_id();
  std::vector<int> order;
  crew.for_each(100, 1, kLittle_ns, [&](std::size_t i, int worker) {
    EXPECT_EQ(worker, 0);
    EXPECT_EQ(std::this_thread::get_id(), caller);
    order.push_back(static_cast<int>(i));
  });
  std::vector<int> expected(100);
  std::iota(expected.begin(), expected.end(), 0);
  EXPECT_EQ(order, expected);
}

TEST(WorkCrew, TakesAsManyThreadsAsTheMachineHasUnlessToldOtherwise) {
  EXPECT_GE(WorkCrew(0).threads(), 1);
  EXPECT_EQ(WorkCrew(3).threads(), 3);
}

}  // namespace
}  // namespace glissade::collision
