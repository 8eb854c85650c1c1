#include <atomic>
#include <csignal>
#include <ctime>

#include <glissade/apps/stop_signal.h>

namespace glissade::apps {

namespace {

// A signal may arrive on any thread, and a handler must not lock.
std::atomic<bool> stop_requested = false;
std::atomic<std::time_t> requested_at_s = 0;
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<std::time_t>::is_always_lock_free);

/// Longer than a force needs to fade.
constexpr std::time_t kPatience_s = 2;

std::time_t monotonic_seconds() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec;
}

void on_signal(int number) {
  if (!stop_requested.exchange(true)) {
    requested_at_s = monotonic_seconds();
    return;
  }
  if (monotonic_seconds() - requested_at_s < kPatience_s) return;
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
  return stop_requested;
}

}  // namespace glissade::apps
