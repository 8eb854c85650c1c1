// Memory that is there when a real-time thread touches it.

#include <cstddef>

#include <gtest/gtest.h>
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

TEST(LockedMemory, IsRefusedWhereLaterAllocationsWouldFail) {
  const int code = exit_code_of_child([] {
    const rlimit little{.rlim_cur = 1 << 20, .rlim_max = 1 << 20};
    constexpr uid_t kNobody = 65534;
    if (setrlimit(RLIMIT_MEMLOCK, &little) != 0) return 2;
    if (geteuid() == 0 && setresuid(kNobody, kNobody, kNobody) != 0) return 3;
    if (may_lock_memory() || lock_memory()) return 4;
    const std::size_t much = std::size_t{64} << 20;
    void* const pages = mmap(nullptr, much, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    return pages == MAP_FAILED ? 5 : 0;
  });
  EXPECT_EQ(code, 0);
}

TEST(LockedMemory, IsThereBeforeItIsTouchedAndThreadsKnow) {
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
    rusage before{};
    getrusage(RUSAGE_THREAD, &before);
    for (std::size_t i = 0; i < kPages; ++i)
      static_cast<void>(memory[i * kPage]);
    rusage after{};
    getrusage(RUSAGE_THREAD, &after);
    return after.ru_minflt - before.ru_minflt < 100 ? 0 : 4;
  });
  EXPECT_EQ(code, 0);
}

}  // namespace
}  // namespace glissade::realtime
