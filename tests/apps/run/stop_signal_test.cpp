// Ctrl-C: the first is a wish, and one that comes much later ends the process.

#include <chrono>
#include <csignal>
#include <thread>

#include <gtest/gtest.h>

#include <glissade/apps/run/stop_signal.h>

namespace glissade::apps {
namespace {

TEST(StopSignal, FirstSignalsOnlyRequestAStop) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto stop_gently = [] {
    const StopSignal stop_signal;
    if (StopSignal::requested()) std::_Exit(1);
    for (const int number : {SIGHUP, SIGINT, SIGTERM, SIGQUIT, SIGUSR1, SIGALRM, SIGPIPE})
      std::raise(number);
    std::_Exit(StopSignal::requested() ? 0 : 2);
  };
  EXPECT_EXIT(stop_gently(), testing::ExitedWithCode(0), "");
}

TEST(StopSignal, OneThatComesAfterTheForceHasFadedEndsTheProcess) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto insist = [] {
    const StopSignal stop_signal;
    std::raise(SIGINT);
    std::this_thread::sleep_for(std::chrono::milliseconds(2100));
    std::raise(SIGTERM);
    std::_Exit(0);
  };
  EXPECT_EXIT(insist(), testing::KilledBySignal(SIGTERM), "");
}

}  // namespace
}  // namespace glissade::apps
