#include <pthread.h>
#include <sched.h>
#include <sys/prctl.h>

#include <glissade/realtime/thread_scheduling.h>

namespace glissade::realtime {

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

}  // namespace glissade::realtime
