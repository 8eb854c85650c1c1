#pragma once

/// A thread that runs one candidate search at a time.

#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "search/candidate_search.h"

namespace glissade::haptics {

/// Thread-safety: one thread owns the object, never the haptic thread, because calls may lock and wait.
class SearchThread {
 public:
  /// Starts a search. The search before must have ended in `wait`. The three objects must not be used until `wait` has
  /// returned.
  void begin(CandidateSearch& search, const CandidateRequest& request, CandidateSet& set);

  /// Waits until the search is done; returns at once if there is none. Rethrows the exception of the search.
  void wait();

  SearchThread();
  SearchThread(const SearchThread&) = delete;
  SearchThread& operator=(const SearchThread&) = delete;
  /// Waits for a search that is under way.
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
  Job job_;  // null when it is done
  std::exception_ptr error_;
  std::jthread thread_;  // last: it ends before the members that it uses
};

}  // namespace glissade::haptics
