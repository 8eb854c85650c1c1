#include "pipeline/thread_pool.h"

#include <chrono>

#include <oneapi/tbb/info.h>

namespace glissade::collision {
namespace {

// How long threads stay awake after work and after a call of `wake`. Mostly, the next stage or the announced work comes
// within this time.
constexpr std::chrono::microseconds kAwake{500};

int number_of(int threads) {
  return threads > 0 ? threads : oneapi::tbb::info::default_concurrency();
}

}  // namespace

ThreadPool::ThreadPool(int threads)
    : threads_(number_of(threads)), arena_(threads_), parts_(static_cast<std::size_t>(threads_)) {
  // oneTBB keeps no more threads than the machine has processors, unless allowed to.
  if (threads_ > oneapi::tbb::info::default_concurrency()) {
    allowance_.emplace(oneapi::tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads_));
  }
  try {
    for (int worker = 1; worker < threads_; ++worker)
      workers_.emplace_back([this, worker] { serve(worker); });
  } catch (...) {
    stop();
    throw;
  }
}

ThreadPool::~ThreadPool() {
  stop();
}

void ThreadPool::stop() {
  should_stop_.store(true, std::memory_order_relaxed);
  wake();
  for (std::thread& worker : workers_)
    worker.join();
}

void ThreadPool::wake() {
  if (threads_ == 1) return;
  calls_.fetch_add(1, std::memory_order_release);
  calls_.notify_all();
}

void ThreadPool::give(const Job& job) {
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    parts_[p].next.store(p * job.count / parts_.size(), std::memory_order_relaxed);
    parts_[p].end = (p + 1) * job.count / parts_.size();
  }
  job_ = &job;
  open_and_inside_.store(kOpen, std::memory_order_release);
  wake();
  job.do_share(job, *this, 0);
  open_and_inside_.fetch_and(~kOpen, std::memory_order_relaxed);
  while (open_and_inside_.load(std::memory_order_acquire) != 0)
    std::this_thread::yield();
}

void ThreadPool::serve(int worker) {
  std::uint32_t calls_seen = 0;
  auto awake_since = std::chrono::steady_clock::now();
  while (!should_stop_.load(std::memory_order_relaxed)) {
    if (join_job(worker)) {
      awake_since = std::chrono::steady_clock::now();
    } else if (std::chrono::steady_clock::now() - awake_since < kAwake) {
      std::this_thread::yield();
    } else {
      calls_.wait(calls_seen, std::memory_order_acquire);
      awake_since = std::chrono::steady_clock::now();
    }
    calls_seen = calls_.load(std::memory_order_acquire);
  }
}

// Works on the current job, if there is one. Returns whether there was.
bool ThreadPool::join_job(int worker) {
  std::uint32_t state = open_and_inside_.load(std::memory_order_relaxed);
  while ((state & kOpen) != 0) {
    if (open_and_inside_.compare_exchange_weak(state, state + 1, std::memory_order_acquire,
                                               std::memory_order_relaxed)) {
      job_->do_share(*job_, *this, worker);
      open_and_inside_.fetch_sub(1, std::memory_order_release);
      return true;
    }
  }
  return false;
}

}  // namespace glissade::collision
