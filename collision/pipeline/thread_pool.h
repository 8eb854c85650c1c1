#pragma once

/// A thread pool for independent pieces of work: an idle thread takes the next piece (paper §2.3, coarse grain).
///
/// The pool has threads of its own because frames are short: a thread of oneTBB was seen to start 0.3 to 1.4 ms after
/// the request, or not at all; one that waits for a futex starts after 50 µs.

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

/// Not thread-safe: one thread calls it, and does its share of the work.
class ThreadPool {
 public:
  /// `threads` includes the calling thread. 0: as many as the machine has processors.
  explicit ThreadPool(int threads);
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;
  ~ThreadPool();

  int threads() const { return threads_; }

  /// Announces work that is worth sharing. Sleeping threads wake up and sleep again if no work comes soon.
  void wake();

  /// Calls work(begin, end, worker) for ranges that make up 0 to `count`; calls with the same `worker` (below
  /// `threads()`) do not overlap. An idle thread takes the next range of `chunk` pieces; `chunk` must not be 0. Threads
  /// that come too late are not waited for. The calling thread does everything if `expected_ns` is not worth sharing.
  /// Deterministic if pieces do not depend on each other. `work` must not throw.
  template <typename Work>
  void for_each(std::size_t count, std::size_t chunk, double expected_ns, const Work& work);

  /// A chunk size for `count` pieces that take `expected_ns` together: the work of a chunk is large compared with the
  /// cost of handing it out, and small compared with a frame.
  static std::size_t chunk_of(std::size_t count, double expected_ns) {
    const double each = std::max(expected_ns / static_cast<double>(std::max<std::size_t>(count, 1)), 1.0);
    return static_cast<std::size_t>(std::max(1.0, kChunk_ns / each));
  }

  /// Whether work of that expected duration is shared.
  bool is_worth_sharing(double expected_ns) const { return threads_ > 1 && expected_ns >= kWorthSharing_ns; }

  /// Calls work() in an arena where tasks of oneTBB have as many threads as this pool.
  template <typename Work>
  void run(const Work& work) {
    arena_.execute(work);
  }

 private:
  static constexpr double kWorthSharing_ns = 120'000.0;
  static constexpr double kChunk_ns = 20'000.0;

  /// The current work. Lives on the stack of `for_each`.
  struct Job {
    void (*do_share)(const Job& job, ThreadPool& pool, int worker);
    const void* work;
    std::size_t count;
    std::size_t chunk;
  };

  /// Each worker begins with a part of its own. For equal work this is the same part in every frame, so that its data
  /// are in the cache of the worker's processor. Then it takes from the parts of others.
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

  // The caller sets `job_`, then opens it. A worker enters while it is open, and may use it until it leaves. The caller
  // closes it when nothing is left to take, and waits for the workers inside.
  static constexpr std::uint32_t kOpen = 1U << 31;
  std::vector<Part> parts_;  ///< one for each worker
  const Job* job_ = nullptr;
  std::atomic<std::uint32_t> open_and_inside_{0};  ///< kOpen, plus the number of workers inside
  std::atomic<std::uint32_t> calls_{0};            ///< counts calls of `wake`; sleeping workers wait for a change
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
