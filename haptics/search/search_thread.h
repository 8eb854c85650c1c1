#pragma once

/// A thread that works on one request of the collision detection at a time.

#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "search/candidate_search.h"

namespace glissade::haptics {

/// Thread-safety: one thread owns the object. It may lock and wait, so that is never the haptic thread.
class SearchThread {
 public:
  /// Begins to search at once. None of the references may be used by others until `wait` has returned.
  void begin(CandidateSearch& search, const CandidateRequest& request, CandidateSet& set);

  /// Returns when the search is done; at once if there is none. Rethrows what it threw.
  void wait();

  SearchThread();
  SearchThread(const SearchThread&) = delete;
  SearchThread& operator=(const SearchThread&) = delete;
  /// Waits for the search that is under way.
  ~SearchThread() = default;

 private:
  struct Job {
    CandidateSearch* search = nullptr;
    const CandidateRequest* request = nullptr;
    CandidateSet* set = nullptr;
  };

  void work(const std::stop_token& stop);

  std::mutex mutex_;
  std::condition_variable_any changed_;
  Job job_;  // none when it is done
  std::exception_ptr error_;
  std::jthread thread_;  // last, so that it ends before what it uses
};

}  // namespace glissade::haptics
