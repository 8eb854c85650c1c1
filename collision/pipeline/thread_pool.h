#pragma once

/// Independent pieces of work done by several threads, each piece by whoever is free (paper §2.3, coarse
/// grain).
///
/// The threads are our own because frames are short: a thread of oneTBB was seen to take part 0.3 to 1.4 ms after it
/// was asked to, if at all, one that waits for a futex after 50 µs.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <thread>
#include <vector>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <glissade/base/assert.h>

namespace glissade::collision {

/// Not thread-safe: one thread gives work, and does its share.
class ThreadPool {
 public:
  /// With that thread. 0: as many as the machine has.
  explicit ThreadPool(int threads);
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;
  ~ThreadPool();

  int threads() const { return threads_; }

  /// Work that is worth sharing will come soon: whoever sleeps gets up meanwhile, and sleeps again if it does not come.
  void wake();

  /// Calls work(begin, end, worker) for pieces that make up 0 to `count`; calls with the same `worker` (below
  /// `threads()`) do not overlap. Whoever is free takes the next `chunk` of them, which must not be 0; who comes too
  /// late is not waited for. The calling thread does it all when `expected_ns` is not worth sharing. Deterministic if
  /// pieces do not depend on each other. `work` must not throw.
  template <typename Work>
  void for_each(std::size_t count, std::size_t chunk, double expected_ns, const Work& work);

  /// How many of `count` pieces of work to hand out at a time, if all together take `expected_ns`: so many that it is
  /// large beside the cost of that, and small beside a frame.
  static std::size_t chunk_of(std::size_t count, double expected_ns) {
    const double each = std::max(expected_ns / static_cast<double>(std::max<std::size_t>(count, 1)), 1.0);
    return static_cast<std::size_t>(std::max(1.0, kChunk_ns / each));
  }

  /// Whether so much work is shared.
  bool is_worth_sharing(double expected_ns) const { return threads_ > 1 && expected_ns >= kWorthSharing_ns; }

  /// Calls work() where tasks of oneTBB that it begins have as many threads as this pool.
  template <typename Work>
  void run(const Work& work) {
    arena_.execute(work);
  }

 private:
  static constexpr double kWorthSharing_ns = 120'000.0;
  static constexpr double kChunk_ns = 20'000.0;

  /// What is being done. Lives on the stack of `for_each`.
  struct Job {
    void (*do_share)(const Job& job, ThreadPool& pool, int worker);
    const void* work;
    std::size_t count;
    std::size_t chunk;
  };

  /// A worker begins with a part of its own, the same of equal work in every frame, so that what it needs is in the
  /// cache of its processor; then it takes from the others'.
  struct alignas(64) Part {
    std::atomic<std::size_t> next{0};
    std::size_t end = 0;
  };

  template <typename Work>
  static void do_share(const Job& job, ThreadPool& pool, int worker);

  void give(const Job& job);
  void stop();
  void serve(int worker);
  bool join_job(int worker);

  int threads_;
  std::optional<oneapi::tbb::global_control> allowance_;
  oneapi::tbb::task_arena arena_;

  // The caller sets `job_`, then opens it; a worker enters while it is open, and may use it until it leaves. The caller
  // closes it when nothing is left to be taken, and waits for those inside.
  static constexpr std::uint32_t kOpen = 1U << 31;
  std::vector<Part> parts_;  ///< one for each worker
  const Job* job_ = nullptr;
  std::atomic<std::uint32_t> open_and_inside_{0};  ///< kOpen, and how many workers are inside
  std::atomic<std::uint32_t> calls_{0};            ///< for those who sleep
  std::atomic<bool> should_stop_{false};
  std::vector<std::thread> workers_;
};

template <typename Work>
void ThreadPool::do_share(const Job& job, ThreadPool& pool, int worker) {
  const Work& work = *static_cast<const Work*>(job.work);
  for (int offset = 0; offset < pool.threads_; ++offset) {
    Part& part = pool.parts_[static_cast<std::size_t>((worker + offset) % pool.threads_)];
    for (std::size_t begin = part.next.fetch_add(job.chunk, std::memory_order_relaxed); begin < part.end;
         begin = part.next.fetch_add(job.chunk, std::memory_order_relaxed)) {
      work(begin, std::min(begin + job.chunk, part.end), worker);
    }
  }
}

template <typename Work>
void ThreadPool::for_each(std::size_t count, std::size_t chunk, double expected_ns, const Work& work) {
  GLISSADE_ASSERT(chunk > 0);
  if (count < 2 || !is_worth_sharing(expected_ns)) {
    if (count > 0) work(std::size_t{0}, count, 0);
    return;
  }
  give({&do_share<Work>, &work, count, chunk});
}

}  // namespace glissade::collision
