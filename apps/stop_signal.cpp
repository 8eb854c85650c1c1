#include <atomic>
#include <csignal>

#include <glissade/apps/stop_signal.h>

namespace glissade::apps {

namespace {

// A signal may arrive on any thread, and a handler must not lock.
std::atomic<bool> stop_requested = false;
static_assert(std::atomic<bool>::is_always_lock_free);

void on_signal(int) {
  stop_requested = true;
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

}  // namespace

StopSignal::StopSignal() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

bool StopSignal::requested() {
  return stop_requested;
}

}  // namespace glissade::apps
