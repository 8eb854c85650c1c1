// Memory that is there when a real-time thread touches it.

#include <array>
#include <cstddef>

#include <gtest/gtest.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <glissade/realtime/periodic_thread.h>

#include "sanitizers.h"

namespace glissade::realtime {
namespace {

/// Runs `work` in a child, whose limits and locks end with it. Returns the exit code.
template <typename Work>
int exit_code_of_child(const Work& work) {
  const pid_t child = fork();
  if (child == 0) _exit(work());
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

long page_faults_so_far() {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_minflt + usage.ru_majflt;
}

/// Where the test may set the limit, the process fits below it, so the system would lock its memory.
TEST(LockedMemory, IsRefusedWhereLaterAllocationsWouldFail) {
  const int code = exit_code_of_child([] {
    constexpr rlim_t kLimit = rlim_t{512} << 20;
    const rlimit limit{.rlim_cur = kLimit, .rlim_max = kLimit};
    setrlimit(RLIMIT_MEMLOCK, &limit);  // fails where the limit is lower already
    constexpr uid_t kNobody = 65534;
    if (geteuid() == 0 && setresuid(kNobody, kNobody, kNobody) != 0) return 4;
    if (may_lock_memory() || lock_memory()) return 5;
    void* const pages = mmap(nullptr, 2 * kLimit, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    return pages == MAP_FAILED ? 6 : 0;
  });
  EXPECT_EQ(code, 0);
}

TEST(LockedMemory, HasNoPageFaultsAndIsReportedByThreads) {
  if (test_support::kSanitized) GTEST_SKIP() << "sanitizers ignore mlockall";
  if (!may_lock_memory()) GTEST_SKIP() << "no right to lock memory";
  const int code = exit_code_of_child([] {
    SteadyClock clock;
    const auto stop_at_once = [](const PeriodicTick&) { return false; };
    if (PeriodicThread(clock, {}, stop_at_once).scheduling().has_locked_memory) return 1;
    if (!lock_memory()) return 2;
    if (!PeriodicThread(clock, {}, stop_at_once).scheduling().has_locked_memory) return 3;
    constexpr std::size_t kPage = 4096;
    constexpr std::size_t kPages = 1000;
    const auto* const memory = static_cast<const volatile char*>(
        mmap(nullptr, kPages * kPage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
    const long before = page_faults_so_far();
    for (std::size_t i = 0; i < kPages; ++i)
      static_cast<void>(memory[i * kPage]);
    return page_faults_so_far() - before < 100 ? 0 : 4;
  });
  EXPECT_EQ(code, 0);
}

/// Without locked memory, too.
TEST(PeriodicThread, StackIsPrefaulted) {
  if (test_support::kSanitized) GTEST_SKIP() << "a sanitizer touches memory of its own";
  long faults = -1;
  SteadyClock clock;
  PeriodicThread thread(clock, {}, [&faults](const PeriodicTick&) {
    std::array<char, 128 << 10> deep;
    const long before = page_faults_so_far();
    explicit_bzero(deep.data(), deep.size());
    faults = page_faults_so_far() - before;
    return false;
  });
  thread.join();
  EXPECT_LT(faults, 8);
}

}  // namespace
}  // namespace glissade::realtime
