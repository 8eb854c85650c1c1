#include "for_each.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include <pybind11/pybind11.h>
#include <unistd.h>

#include "unlocked.h"

namespace glissade::python {

namespace py = pybind11;

namespace {

using Worker = std::function<void(std::int64_t)>;

/// Most items that a thread takes at once. Neighbours stay together, which coherent workspaces profit from.
constexpr std::int64_t kGreatestBlock = 32;
/// Blocks of each thread, at least, so that the threads end together.
constexpr std::int64_t kBlocksOfThread = 8;

/// How often the calling thread looks for signals.
constexpr std::chrono::milliseconds kSignalPeriod{50};

/// The work that threads share, and the first of its failures.
class SharedWork {
 public:
  SharedWork(std::int64_t count, int threads)
      : count_(count),
        block_(std::clamp<std::int64_t>(count / (kBlocksOfThread * threads), 1, kGreatestBlock)),
        failed_at_(count) {}

  /// Works until nothing is left. `goes_on` is called after each item.
  template <typename GoesOn>
  void take_part(const std::function<Worker()>& make_worker, GoesOn goes_on) noexcept {
    std::int64_t item = 0;
    try {
      const Worker worker = make_worker();
      while (!ends_.load(std::memory_order_relaxed)) {
        item = next_.fetch_add(block_);
        if (item >= count_) return;
        for (const std::int64_t end = std::min(count_, item + block_); item < end; ++item) {
          worker(item);
          goes_on();
        }
      }
    } catch (...) {
      fail(item);
    }
  }

  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  /// Blocks are handed out in ascending order and worked off to their ends, so the lowest item is always found.
  void fail(std::int64_t item) noexcept {
    const std::lock_guard lock(mutex_);
    ends_ = true;
    if (failure_ && item >= failed_at_) return;
    failed_at_ = item;
    failure_ = std::current_exception();
  }

  std::int64_t count_;
  std::int64_t block_;
  std::atomic<std::int64_t> next_{0};
  std::atomic<bool> ends_{false};
  std::mutex mutex_;
  std::int64_t failed_at_;
  std::exception_ptr failure_;
};

}  // namespace

SignalCheck::SignalCheck()
    : is_main_thread_(gettid() == getpid()),
      looked_(std::chrono::steady_clock::now()),
      next_(looked_ + kSignalPeriod) {}

void SignalCheck::look() {
  const auto now = std::chrono::steady_clock::now();
  calls_ = now - looked_ < kSignalPeriod / 50 ? 2 * calls_ : std::max<std::int64_t>(1, calls_ / 2);
  calls_left_ = calls_;
  looked_ = now;
  if (!is_main_thread_ || now < next_) return;
  next_ = now + kSignalPeriod;
  const py::gil_scoped_acquire locked;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

void for_each(std::int64_t count, int threads, const std::function<Worker()>& make_worker) {
  constexpr int kMostThreads = 1024;
  if (threads < 1 || threads > kMostThreads)
    throw std::invalid_argument("threads must be between 1 and 1024, not " + std::to_string(threads));
  const Unlocked unlocked;
  SharedWork shared(count, threads);
  std::vector<std::jthread> others;
  try {
    for (std::int64_t i = 1; i < std::min<std::int64_t>(threads, count); ++i)
      others.emplace_back([&] { shared.take_part(make_worker, [] {}); });
  } catch (const std::system_error&) {  // the system has no more threads: those that run do the work
  }
  shared.take_part(make_worker, SignalCheck());
  others.clear();  // joins
  shared.rethrow();
}

}  // namespace glissade::python
