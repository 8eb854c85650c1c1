#include <atomic>
#include <csignal>

#include <glissade/apps/record/dump_signal.h>

namespace glissade::apps {

namespace {

std::atomic<bool> is_requested = false;
static_assert(std::atomic<bool>::is_always_lock_free);  // a handler must not lock

}  // namespace

DumpSignal::DumpSignal() {
  // Leaves alone what somebody has installed before.
  const auto before = std::signal(SIGUSR1, [](int) { is_requested = true; });
  if (before != SIG_DFL && before != SIG_IGN && before != SIG_ERR) std::signal(SIGUSR1, before);
}

bool DumpSignal::take() {
  return is_requested.exchange(false);
}

}  // namespace glissade::apps
