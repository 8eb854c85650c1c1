#pragma once

/// A thread that runs one candidate search at a time, and knows how much work the search has done.

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>

#include <glissade/collision/query_types.h>
#include <glissade/realtime/periodic_thread.h>

#include "search/candidate_search.h"
#include "work/work_budget.h"

namespace glissade::contact {

/// Thread-safety: one thread owns the object, never the haptic thread, because calls may lock and wait.
class SearchThread final : public collision::WorkMeter {
 public:
  /// The thread does at most `work_ahead` more than the work that `wait_for_work` has allowed; with 0 it works only
  /// while somebody waits.
  explicit SearchThread(std::int64_t work_ahead = kUnlimitedWork);
  SearchThread(const SearchThread&) = delete;
  SearchThread& operator=(const SearchThread&) = delete;
  /// Waits for a search that is under way.
  ~SearchThread() = default;

  /// Starts a search, with the priority behind that of the calling thread, if this one runs under SCHED_FIFO. The
  /// search before must be done or cancelled: `wait` has returned true, or `cancel` has been
  /// called. The three objects must not be used until this is so again. The search must have this object as its meter.
  void begin(CandidateSearch& search, const CandidateRequest& request, CandidateSet& set);

  /// Allows the search to have done so much work since its beginning. Does not wait.
  void allow(std::int64_t allowed);
  /// Waits until the search is done or has done more work than `allowed` since its beginning.
  void wait_for_work(std::int64_t allowed);
  /// The same; returns whether the search is done and has done no more. So the answer does not depend on how fast the
  /// thread is. Rethrows the exception of the search.
  bool wait(std::int64_t allowed = kUnlimitedWork);

  std::int64_t work_ahead() const { return work_ahead_; }
  /// Ends a search that is under way at its next call of `spend`, without an answer. Forgets its exception. Returns
  /// whether it was under way or had failed: it must start afresh then.
  bool cancel();

  /// Work of the search that `wait` has last waited for, so far.
  std::int64_t work() const { return work_.load(std::memory_order_relaxed); }

  /// Called by the search.
  void spend(std::int64_t work) override;

 private:
  struct Job {
    CandidateSearch* search = nullptr;
    const CandidateRequest* request = nullptr;
    CandidateSet* set = nullptr;
    int priority_of_asker = 0;  // under SCHED_FIFO
  };

  void run(const std::stop_token& stop);
  void follow(int priority_of_asker);
  bool is_done() const { return job_.search == nullptr; }  // under the lock
  std::int64_t at_most_ahead() const;

  struct Cancelled : std::exception {};

  std::int64_t work_ahead_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  Job job_;  // null when it is done
  std::exception_ptr error_;
  bool is_cancelled_ = false;
  bool is_held_up_ = false;  // the thread waits until more work is allowed
  std::atomic<std::int64_t> work_{0};
  std::int64_t allowed_ = 0;
  std::atomic<std::int64_t> lock_at_{0};  // with more work the thread takes the lock
  std::stop_token stop_;                  // this and the next two: of the thread, which alone uses them
  std::optional<realtime::FifoShare> priority_;
  std::int64_t check_at_ = 0;  // with more work, its share is checked
  std::jthread thread_;        // last: it ends before the members that it uses
};

}  // namespace glissade::contact
