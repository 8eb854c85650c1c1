#include <array>
#include <csignal>
#include <stdexcept>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <glissade/apps/latency/helper_process.h>
#include <glissade/apps/latency/shared_stamps.h>

namespace glissade::apps {
namespace {

using std::chrono::nanoseconds;

TEST(HelperProcess, RunsAllTasksInOneSeparateProcess) {
  SharedStamps stamps(10);
  HelperProcess helper([&](char work, const std::atomic<bool>& should_end) {
    stamps.note(work, nanoseconds(getpid()));
    while (!should_end.load())
      std::this_thread::yield();
  });
  for (const char work : {'\1', '\2'}) {
    helper.begin(work);
    helper.end();
  }
  EXPECT_NE(stamps.at(1), std::nullopt);
  EXPECT_EQ(stamps.at(1), stamps.at(2));
  EXPECT_NE(stamps.at(1), nanoseconds(getpid()));
}

TEST(HelperProcess, TellsWhatTheWorkHasThrownAndGoesOn) {
  HelperProcess helper([](char work, const std::atomic<bool>&) {
    if (work == 'x') throw std::invalid_argument("no such port");
  });
  helper.begin('x');
  try {
    helper.end();
    ADD_FAILURE() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "the second process: no such port");
  }
  helper.begin('y');
  EXPECT_NO_THROW(helper.end());
}

TEST(HelperProcess, EndedHelperIsAnError) {
  HelperProcess helper([](char, const std::atomic<bool>&) { _exit(3); });
  helper.begin('w');
  EXPECT_THROW(helper.end(), std::runtime_error);
}

/// Starts a process that has a helper at work for ever, and is killed.
TEST(HelperProcess, EndsWithTheFirstProcess) {
  std::array<int, 2> pipe_ends{};
  ASSERT_EQ(pipe(pipe_ends.data()), 0);
  const pid_t first = fork();
  ASSERT_GE(first, 0);
  if (first == 0) {
    HelperProcess helper([&](char work, const std::atomic<bool>&) {
      if (write(pipe_ends[1], &work, 1) != 1) _exit(1);
      for (;;)
        pause();
    });
    helper.begin('w');
    for (;;)
      pause();
  }
  close(pipe_ends[1]);
  char work = 0;
  ASSERT_EQ(read(pipe_ends[0], &work, 1), 1) << "the helper is at work";
  kill(first, SIGKILL);
  waitpid(first, nullptr, 0);
  // The pipe ends when nobody can write to it any more, so the helper has ended too.
  EXPECT_EQ(read(pipe_ends[0], &work, 1), 0);
  close(pipe_ends[0]);
}

}  // namespace
}  // namespace glissade::apps
