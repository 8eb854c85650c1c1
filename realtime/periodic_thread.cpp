#include <algorithm>
#include <array>
#include <future>
#include <stdexcept>
#include <utility>

#include <pthread.h>
#include <sched.h>
#include <sys/prctl.h>

#include <glissade/realtime/periodic_thread.h>

namespace glissade::realtime {
namespace {

/// Puts the calling thread under SCHED_FIFO with `priority` (1 to 99) where the system allows it, leaves its scheduling
/// alone for `priority` 0, and sets its timer slack to the minimum. Never fails: a refusal shows in the result.
ThreadScheduling request_punctual_scheduling(int priority) noexcept {
  ThreadScheduling scheduling;
  if (priority > 0) {
    const sched_param parameters{.sched_priority = priority};
    scheduling.is_fifo = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters) == 0;
  }
  constexpr unsigned long kOneNanosecond = 1;  // 0 would restore the default
  scheduling.has_minimal_timer_slack = prctl(PR_SET_TIMERSLACK, kOneNanosecond, 0UL, 0UL, 0UL) == 0;
  return scheduling;
}

}  // namespace

void name_this_thread(std::string_view name) noexcept {
  std::array<char, 16> shortened{};  // the most that the system takes, with the final zero
  std::copy_n(name.begin(), std::min(name.size(), shortened.size() - 1), shortened.begin());
  pthread_setname_np(pthread_self(), shortened.data());
}

PeriodicThread::PeriodicThread(Clock& clock, const PeriodicThreadOptions& options, Tick tick) {
  // Bad arguments must be found here, because an exception could not leave the thread.
  const PeriodicSchedule check(clock.now(), options.period);
  if (!tick) throw std::invalid_argument("A periodic thread needs a tick.");
  std::promise<ThreadScheduling> scheduling;
  std::future<ThreadScheduling> granted = scheduling.get_future();
  thread_ = std::thread([this, &clock, options, own_tick = std::move(tick), own = std::move(scheduling)]() mutable {
    if (!options.name.empty()) name_this_thread(options.name);
    own.set_value(request_punctual_scheduling(options.fifo_priority));
    run_periodic(clock, options.period, statistics_, [this, &own_tick](const PeriodicTick& now) {
      return !should_stop_.load(std::memory_order_relaxed) && own_tick(now);
    });
  });
  scheduling_ = granted.get();
}

void PeriodicThread::join() {
  if (thread_.joinable()) thread_.join();
}

void PeriodicThread::stop() {
  should_stop_.store(true, std::memory_order_relaxed);
  join();
}

}  // namespace glissade::realtime
