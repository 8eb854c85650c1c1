#pragma once

/// Private: independent pieces of work done by several threads, each piece by whoever is free (paper §2.3, coarse
/// grain).

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <optional>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

namespace glissade::collision {

/// The threads are oneTBB's and the one that calls. Not thread-safe.
class WorkCrew {
 public:
  /// 0 threads: as many as the machine has.
  explicit WorkCrew(int threads);

  int threads() const { return threads_; }

  /// Calls work(i, worker) once for each i below `count`; calls with the same `worker` (below `threads()`) do not
  /// overlap. Whoever is free takes the next `chunk` of them. The calling thread does it all when `expected_ns` is not
  /// worth waking the others. Deterministic if pieces do not depend on each other.
  template <typename Work>
  void for_each(std::size_t count, std::size_t chunk, double expected_ns, const Work& work);

  /// Calls work() where tasks that it begins go to this crew.
  template <typename Work>
  void run(const Work& work) {
    arena_.execute(work);
  }

 private:
  // Sleeping threads need 40 to 60 us until they take part.
  static constexpr double kWorthWaking_ns = 120'000.0;

  int threads_;
  std::optional<oneapi::tbb::global_control> allowance_;
  oneapi::tbb::task_arena arena_;
};

template <typename Work>
void WorkCrew::for_each(std::size_t count, std::size_t chunk, double expected_ns, const Work& work) {
  if (threads_ == 1 || count < 2 || expected_ns < kWorthWaking_ns) {
    for (std::size_t i = 0; i < count; ++i)
      work(i, 0);
    return;
  }
  std::atomic<std::size_t> next{0};
  arena_.execute([&] {
    const auto loop = [&](int worker) {
      for (std::size_t begin = next.fetch_add(chunk, std::memory_order_acq_rel); begin < count;
           begin = next.fetch_add(chunk, std::memory_order_acq_rel)) {
        for (std::size_t i = begin; i < std::min(begin + chunk, count); ++i)
          work(i, worker);
      }
    };
    oneapi::tbb::parallel_for(0, threads_, 1, loop, oneapi::tbb::simple_partitioner());
  });
}

}  // namespace glissade::collision
