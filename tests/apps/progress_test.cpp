#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include <glissade/apps/progress.h>
#include <glissade/apps/wait_notice.h>

namespace glissade::apps {
namespace {

TEST(ProgressLine, FillsFromEmptyToFull) {
  EXPECT_EQ(progress_line("poses", 0, 200, 4), "poses [    ]   0 %");
  EXPECT_EQ(progress_line("poses", 100, 200, 4), "poses [##  ]  50 %");
  EXPECT_EQ(progress_line("poses", 200, 200, 4), "poses [####] 100 %");
}

TEST(ProgressLine, IsFullBeyondTheTotal) {
  EXPECT_EQ(progress_line("poses", 900, 200, 4), "poses [####] 100 %");
}

TEST(ProgressLine, TellsTheSimulatedTime) {
  EXPECT_EQ(simulated_time(1234, 6000), "1.234 of 6.000 s simulated");
  EXPECT_EQ(simulated_time(7000, 6000), "6.000 of 6.000 s simulated");
}

TEST(ProgressBar, WithoutATerminalPrintsALineInEveryPeriod) {
  using std::chrono::milliseconds;
  testing::internal::CaptureStderr();
  ProgressBar progress("sliding", 200, {}, milliseconds(100));
  progress.update(10);
  std::this_thread::sleep_for(milliseconds(60));
  progress.update(20);
  progress.update(21);
  std::this_thread::sleep_for(milliseconds(110));
  progress.update(40);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "glissade: sliding: 10 %\nglissade: sliding: 20 %\n");
}

TEST(ProgressBar, PrintsNothingWhenQuiet) {
  testing::internal::CaptureStderr();
  is_quiet() = true;
  ProgressBar progress("sliding", 200, {}, std::chrono::milliseconds(0));
  progress.update(10);
  is_quiet() = false;
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(WaitNotice, OneLineIfTheWorkTakesLong) {
  testing::internal::CaptureStderr();
  { const WaitNotice notice("reading door.stl"); }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  testing::internal::CaptureStderr();
  {
    const WaitNotice notice("reading door.stl");
    std::this_thread::sleep_for(std::chrono::milliseconds(2500));
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "glissade: reading door.stl ...\n");
}

}  // namespace
}  // namespace glissade::apps
