#include <future>
#include <stdexcept>
#include <utility>

#include <glissade/realtime/periodic_thread.h>

namespace glissade::realtime {

PeriodicThread::PeriodicThread(Clock& clock, const PeriodicThreadOptions& options, Tick tick) {
  // A bad period has to be found here: an exception could not leave the thread.
  const PeriodicSchedule check(clock.now(), options.period);
  std::promise<ThreadScheduling> scheduling;
  std::future<ThreadScheduling> granted = scheduling.get_future();
  thread_ = std::thread([this, &clock, options, own_tick = std::move(tick), own = std::move(scheduling)]() mutable {
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
