#include <atomic>
#include <csignal>

#include <glissade/apps/record/dump_signal.h>

namespace glissade::apps {

namespace {

std::atomic<bool> is_requested = false;
static_assert(std::atomic<bool>::is_always_lock_free);  // a handler must not lock

}  // namespace

DumpSignal::DumpSignal() {
  std::signal(SIGUSR1, [](int) { is_requested = true; });
}

bool DumpSignal::take() {
  return is_requested.exchange(false);
}

}  // namespace glissade::apps
