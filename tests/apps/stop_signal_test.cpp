/// Ctrl-C: the first is a wish, the second ends the process.

#include <csignal>

#include <gtest/gtest.h>

#include <glissade/apps/stop_signal.h>

namespace glissade::apps {
namespace {

TEST(StopSignal, TheFirstIsAWishAndTheSecondEndsTheProcess) {
  const StopSignal stop_signal;
  EXPECT_FALSE(StopSignal::requested());
  std::raise(SIGINT);
  EXPECT_TRUE(StopSignal::requested());
  EXPECT_EQ(std::signal(SIGTERM, SIG_DFL), SIG_DFL);
  EXPECT_EQ(std::signal(SIGINT, SIG_DFL), SIG_DFL);
}

}  // namespace
}  // namespace glissade::apps
