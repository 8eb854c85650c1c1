/// The second process that releases a device when the first one cannot.

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <glissade/bridges/release_guard.h>

#include "eventually.h"

namespace glissade::bridges {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kRelease = "\nA0B0C0D0E0\n";

/// A connection whose other end is the device.
class Device : public testing::Test {
 protected:
  Device() { EXPECT_EQ(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, ends.data()), 0); }
  ~Device() override {
    for (const int end : ends)
      close(end);
  }
  /// What has arrived within `patience_ms`.
  std::string heard(int patience_ms) {
    pollfd waiting{ends[1], POLLIN, 0};
    if (poll(&waiting, 1, patience_ms) <= 0) return {};
    std::array<char, 1000> bytes;
    const ssize_t size = read(ends[1], bytes.data(), bytes.size());
    return {bytes.data(), size > 0 ? static_cast<std::size_t>(size) : 0};
  }

  std::array<int, 2> ends{};
};

using ReleaseGuardTest = Device;

TEST_F(ReleaseGuardTest, ReleasesWhenTheFirstProcessIsKilled) {
  const pid_t bridge = fork();
  if (bridge == 0) {
    ReleaseGuard guard;
    guard.arm(ends[0], kRelease);
    raise(SIGKILL);
  }
  ASSERT_EQ(waitpid(bridge, nullptr, 0), bridge);
  EXPECT_THAT(heard(100), HasSubstr(kRelease));
}

TEST_F(ReleaseGuardTest, ReleasesWhenTheFirstProcessHangs) {
  ReleaseGuard guard;
  guard.arm(ends[0], kRelease);
  EXPECT_THAT(heard(20'000), testing::StartsWith(kRelease));
  // Afterwards the first process goes on, and is guarded as before.
  while (!heard(50).empty())
    continue;
  guard.renew();
  EXPECT_THAT(heard(20'000), HasSubstr(kRelease));
}

TEST_F(ReleaseGuardTest, IsSilentOnceDisarmed) {
  ReleaseGuard guard;
  guard.arm(ends[0], kRelease);
  guard.disarm();
  EXPECT_THAT(heard(200), IsEmpty());
}

TEST_F(ReleaseGuardTest, IsSilentWhileItIsRenewed) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds kPatience{100};
  constexpr int kTries = 20;  // a busy machine may hold this thread up
  for (int i = 0; i < kTries; ++i) {
    ReleaseGuard guard;
    guard.arm(ends[0], kRelease);
    Clock::duration longest{0};
    const Clock::time_point end = Clock::now() + 5 * kPatience;
    for (Clock::time_point last = Clock::now(); last < end;) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      guard.renew();
      const Clock::time_point now = Clock::now();
      longest = std::max(longest, now - last);
      last = now;
    }
    guard.disarm();
    const std::string said = heard(20);
    if (longest > kPatience / 2) continue;
    EXPECT_EQ(said, "");
    return;
  }
  FAIL() << "in each round, this thread was held up for " << (kPatience / 2).count() << " ms";
}

TEST_F(ReleaseGuardTest, KeepsNothingOpenAfterwards) {
  ReleaseGuard guard;
  guard.arm(ends[0], kRelease);
  guard.disarm();
  close(ends[0]);
  ends[0] = -1;
  std::array<char, 100> bytes;
  EXPECT_TRUE(eventually([&] { return read(ends[1], bytes.data(), bytes.size()) == 0; })) << "an unplugged port";
}

TEST_F(ReleaseGuardTest, OutlivesSignalsOfTheTerminal) {
  ReleaseGuard guard;
  guard.arm(ends[0], kRelease);
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE})
    kill(guard.id(), number);
  EXPECT_THAT(heard(20'000), HasSubstr(kRelease));
  guard.renew();
}

TEST_F(ReleaseGuardTest, IsReplacedWhenItIsKilled) {
  ReleaseGuard guard;
  guard.arm(ends[0], kRelease);
  const pid_t first = guard.id();
  kill(first, SIGKILL);
  const auto is_another = [&] {
    guard.renew();
    return guard.id() != first;
  };
  ASSERT_TRUE(eventually(is_another));
  EXPECT_THAT(heard(20'000), HasSubstr(kRelease)) << "the new one guards the same device";
}

TEST_F(ReleaseGuardTest, IsReplacedWhenItHangs) {
  ReleaseGuard guard;
  guard.arm(ends[0], kRelease);
  const pid_t first = guard.id();
  kill(first, SIGSTOP);
  // One that does not read has room for some orders only.
  const auto is_another = [&] {
    guard.arm(ends[0], kRelease);
    return guard.id() != first;
  };
  EXPECT_TRUE(eventually(is_another));
}

TEST_F(ReleaseGuardTest, EndsAlthoughItHangs) {
  const auto start = std::chrono::steady_clock::now();
  {
    ReleaseGuard guard;
    kill(guard.id(), SIGSTOP);
  }
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10)) << "a stopped process never ends";
}

}  // namespace
}  // namespace glissade::bridges
