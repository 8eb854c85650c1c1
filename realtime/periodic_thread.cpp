#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <future>
#include <stdexcept>
#include <utility>

#include <malloc.h>
#include <pthread.h>
#include <sched.h>
#include <string.h>  // explicit_bzero
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <glissade/realtime/periodic_thread.h>

namespace glissade::realtime {
namespace {

std::atomic<bool> memory_is_locked{false};

/// Touches more of the stack than ticks need, so that none of them is the first to touch a page.
[[gnu::noinline]] void touch_stack() noexcept {
  std::array<char, std::size_t{256} << 10> stack;
  explicit_bzero(stack.data(), stack.size());  // unlike other writes, these cannot be optimized away
}

bool set_policy(int policy, int priority) noexcept {
  const sched_param parameters{.sched_priority = priority};
  return pthread_setschedparam(pthread_self(), policy, &parameters) == 0;
}

/// Asks for short slices of time. A thread that computes little at a time then waits for less of the slices of others,
/// which needs no right. Kernels before 6.12 ignore it.
void request_short_slices() noexcept {
  struct Attributes {  // as sched_setattr takes them; the C library does not know them
    std::uint32_t size = sizeof(Attributes);
    std::uint32_t policy = SCHED_OTHER;
    std::uint64_t flags = 0;
    std::int32_t nice = 0;
    std::uint32_t priority = 0;
    std::uint64_t runtime_ns = 100'000;  // the shortest slice that the kernel grants
    std::uint64_t deadline_ns = 0;
    std::uint64_t period_ns = 0;
  };
  const Attributes attributes{.nice = getpriority(PRIO_PROCESS, 0)};
  syscall(SYS_sched_setattr, 0, &attributes, 0U);
}

std::chrono::nanoseconds time_of(clockid_t clock) noexcept {
  timespec time{};
  clock_gettime(clock, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

}  // namespace

ThreadScheduling schedule_this_thread(int priority) noexcept {
  ThreadScheduling scheduling;
  scheduling.has_locked_memory = memory_is_locked.load(std::memory_order_relaxed);
  if (priority > 0) scheduling.is_fifo = set_policy(SCHED_FIFO, priority);
  if (priority >= kLinkPriority && !scheduling.is_fifo && sched_getscheduler(0) == SCHED_OTHER) request_short_slices();
  constexpr unsigned long kOneNanosecond = 1;  // 0 would restore the default
  scheduling.has_minimal_timer_slack = prctl(PR_SET_TIMERSLACK, kOneNanosecond, 0UL, 0UL, 0UL) == 0;
  return scheduling;
}

int fifo_priority_of_this_thread() noexcept {
  int policy = SCHED_OTHER;
  sched_param parameters{};
  if (pthread_getschedparam(pthread_self(), &policy, &parameters) != 0) return 0;
  return policy == SCHED_FIFO ? parameters.sched_priority : 0;
}

bool TimeBudget::is_within(std::chrono::nanoseconds now, std::chrono::nanoseconds computed) noexcept {
  if (!window_end_ || now >= *window_end_) {
    window_end_ = now + share_.window;
    computed_before_ = computed;
  }
  return computed - computed_before_ <= share_.share * share_.window;
}

void FifoShare::check() noexcept {
  if (!scheduling_.is_fifo) return;
  const bool may_be_ahead = budget_.is_within(time_of(CLOCK_MONOTONIC), time_of(CLOCK_THREAD_CPUTIME_ID));
  if (may_be_ahead == is_ahead_) return;
  is_ahead_ = may_be_ahead;
  set_policy(may_be_ahead ? SCHED_FIFO : SCHED_OTHER, may_be_ahead ? priority_ : 0);
}

// With a limit, mlockall would succeed as long as the process is small, and later allocations would fail. Rights in a
// container may not count, so the system is asked by the attempt to lock more than the limit: no page is touched.
bool may_lock_memory() noexcept {
  rlimit limit{};
  if (getrlimit(RLIMIT_MEMLOCK, &limit) != 0) return false;
  if (limit.rlim_cur == RLIM_INFINITY) return true;
  const std::size_t more = limit.rlim_cur + static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  void* const pages = mmap(nullptr, more, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (pages == MAP_FAILED) return false;
  const bool is_granted = mlock2(pages, more, MLOCK_ONFAULT) == 0;
  munmap(pages, more);
  return is_granted;
}

bool lock_memory() noexcept {
  if (!may_lock_memory() || mlockall(MCL_CURRENT | MCL_FUTURE) != 0) return false;
  // What other threads give back to the system would be fetched anew, page by page, and each change of the address
  // space interrupts all processors.
  mallopt(M_TRIM_THRESHOLD, -1);
  mallopt(M_MMAP_MAX, 0);
  memory_is_locked.store(true, std::memory_order_relaxed);
  return true;
}

void name_this_thread(std::string_view name) noexcept {
  std::array<char, 16> shortened{};  // the most that the system takes, with the final zero
  std::copy_n(name.begin(), std::min(name.size(), shortened.size() - 1), shortened.begin());
  pthread_setname_np(pthread_self(), shortened.data());
}

PeriodicThread::PeriodicThread(Clock& clock, const PeriodicThreadOptions& options, Tick tick) {
  // Bad arguments must be found here, because an exception could not leave the thread.
  const PeriodicSchedule check(clock.now(), options.period);
  validate_spin(options.spin, options.period);
  if (!tick) throw std::invalid_argument("A periodic thread needs a tick.");
  std::promise<ThreadScheduling> scheduling;
  std::future<ThreadScheduling> granted = scheduling.get_future();
  thread_ = std::thread([this, &clock, options, own_tick = std::move(tick), own = std::move(scheduling)]() mutable {
    if (!options.name.empty()) name_this_thread(options.name);
    touch_stack();
    FifoShare share(options.fifo_priority, options.fifo_share);
    own.set_value(share.scheduling());
    const bool is_for_good = options.fifo_share.share >= 1.0;
    run_periodic(
        clock, options.period, statistics_,
        [&](const PeriodicTick& now) {
          const bool goes_on = !should_stop_.load(std::memory_order_relaxed) && own_tick(now);
          if (!is_for_good) share.check();
          return goes_on;
        },
        options.spin);
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
