#include <atomic>
#include <csignal>
#include <cstdint>
#include <ctime>

#include <glissade/apps/run/stop_signal.h>

namespace glissade::apps {

namespace {

// Monotonic nanoseconds of the first signal; 0: none yet. A signal may arrive on any thread, and a handler must not
// lock.
std::atomic<std::int64_t> first_signal_ns = 0;
static_assert(std::atomic<std::int64_t>::is_always_lock_free);

/// Longer than a force needs to fade.
constexpr std::int64_t kPatience_ns = 2'000'000'000;

std::int64_t monotonic_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * std::int64_t{1'000'000'000} + now.tv_nsec;
}

void on_signal(int number) {
  const std::int64_t now = monotonic_ns();
  std::int64_t first = 0;
  if (first_signal_ns.compare_exchange_strong(first, now) || now - first < kPatience_ns) return;
  std::signal(number, SIG_DFL);
  std::raise(number);
}

/// Leaves alone what somebody has installed before.
void ignore_by_default(int number) {
  const auto before = std::signal(number, SIG_IGN);
  if (before != SIG_DFL && before != SIG_ERR) std::signal(number, before);
}

}  // namespace

StopSignal::StopSignal() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT})
    std::signal(number, on_signal);
  for (const int number : {SIGPIPE, SIGXFSZ, SIGUSR1, SIGUSR2, SIGALRM, SIGVTALRM, SIGPROF})
    ignore_by_default(number);
}

bool StopSignal::requested() {
  return first_signal_ns != 0;
}

}  // namespace glissade::apps
