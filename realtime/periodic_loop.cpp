#include <stdexcept>

#include <glissade/realtime/periodic_loop.h>

namespace glissade::realtime {

PeriodicSchedule::PeriodicSchedule(std::chrono::nanoseconds start, std::chrono::nanoseconds period)
    : period_(period), deadline_(start) {
  if (period <= std::chrono::nanoseconds::zero()) throw std::invalid_argument("The period of a loop must be positive.");
}

void validate_spin(std::chrono::nanoseconds spin, std::chrono::nanoseconds period) {
  if (spin < std::chrono::nanoseconds::zero() || spin > period / 2) {
    throw std::invalid_argument("A loop may spin for half of its period at most.");
  }
}

void PeriodicSchedule::finish_tick(std::chrono::nanoseconds started, std::chrono::nanoseconds ended,
                                   PeriodicStatistics& statistics) noexcept {
  ++statistics.ticks;
  statistics.lateness.record(started - deadline_);
  statistics.duration.record(ended - started);
  if (started - deadline_ >= period_) ++statistics.late_ticks;

  deadline_ += period_;
  if (ended - deadline_ >= period_) {
    const auto skipped = (ended - deadline_) / period_;
    statistics.skipped_deadlines += static_cast<std::uint64_t>(skipped);
    deadline_ += skipped * period_;
  }
}

}  // namespace glissade::realtime
