#include "stall_meter.h"

#include <sched.h>

namespace glissade::test_support {
namespace {

cpu_set_t usable_processors() {
  cpu_set_t set;
  CPU_ZERO(&set);
  sched_getaffinity(0, sizeof set, &set);
  return set;
}

}  // namespace

StallMeter::StallMeter() {
  const cpu_set_t usable = usable_processors();
  for (std::size_t processor = 0; processor < CPU_SETSIZE; ++processor) {
    if (CPU_ISSET(processor, &usable))
      threads_.emplace_back([this, processor](const std::stop_token& stop) { watch(processor, stop); });
  }
}

std::chrono::nanoseconds StallMeter::end() {
  threads_.clear();
  return std::chrono::nanoseconds(longest_ns_.load());
}

void StallMeter::watch(std::size_t processor, const std::stop_token& stop) {
  cpu_set_t only;
  CPU_ZERO(&only);
  CPU_SET(processor, &only);
  sched_setaffinity(0, sizeof only, &only);
  using Clock = std::chrono::steady_clock;
  while (!stop.stop_requested()) {
    const Clock::time_point due = Clock::now() + std::chrono::milliseconds(1);
    std::this_thread::sleep_until(due);
    const std::int64_t late = std::chrono::nanoseconds(Clock::now() - due).count();
    std::int64_t longest = longest_ns_.load();
    while (late > longest && !longest_ns_.compare_exchange_weak(longest, late)) {
    }
  }
}

}  // namespace glissade::test_support
