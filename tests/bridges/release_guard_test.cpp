/// The second process that releases a device when the first one cannot.

#include <array>
#include <csignal>
#include <string>

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

constexpr const char* kRelease = "A0B0C0D0E0\n";

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
  EXPECT_THAT(heard(20'000), testing::StartsWith(std::string("\n") + kRelease)) << "the last line may have been cut";
  // Afterwards the first process goes on, and is guarded as before.
  while (!heard(50).empty())
    continue;
  EXPECT_TRUE(guard.renew());
  EXPECT_THAT(heard(20'000), HasSubstr(kRelease));
}

TEST_F(ReleaseGuardTest, IsSilentWhileAllIsWell) {
  ReleaseGuard guard;
  guard.arm(ends[0], kRelease);
  guard.disarm();
  EXPECT_THAT(heard(200), IsEmpty());
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
  EXPECT_TRUE(guard.renew());
}

TEST_F(ReleaseGuardTest, TellsThatItIsNoMore) {
  ReleaseGuard guard;
  guard.arm(ends[0], kRelease);
  kill(guard.id(), SIGKILL);
  EXPECT_TRUE(eventually([&] { return !guard.renew(); }));
}

}  // namespace
}  // namespace glissade::bridges
