#include <cerrno>

#include <time.h>

#include <glissade/realtime/clock.h>

namespace glissade::realtime {

std::chrono::nanoseconds SteadyClock::now() const noexcept {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

void SteadyClock::sleep_until(std::chrono::nanoseconds deadline) noexcept {
  const auto seconds = std::chrono::floor<std::chrono::seconds>(deadline);
  const timespec time{.tv_sec = seconds.count(), .tv_nsec = (deadline - seconds).count()};
  // An absolute deadline makes it safe to sleep again after a signal. For a deadline before the epoch, the call fails
  // and returns at once.
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr) == EINTR) {
  }
}

void SteadyClock::spin_until(std::chrono::nanoseconds deadline) noexcept {
  while (now() < deadline) {
  }
}

}  // namespace glissade::realtime
