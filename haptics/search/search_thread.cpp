#include "search/search_thread.h"

#include <utility>

#include <glissade/realtime/periodic_thread.h>

namespace glissade::haptics {

SearchThread::SearchThread()
    : thread_([this](const std::stop_token& stop) {
        realtime::name_this_thread("search");
        work(stop);
      }) {}

void SearchThread::begin(CandidateSearch& search, const CandidateRequest& request, CandidateSet& set) {
  {
    const std::lock_guard lock(mutex_);
    job_ = {&search, &request, &set};
  }
  changed_.notify_all();
}

void SearchThread::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return job_.search == nullptr; });
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

void SearchThread::work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [this] { return job_.search != nullptr; })) {
    const Job job = job_;
    lock.unlock();
    std::exception_ptr error;
    try {
      job.search->find(*job.request, *job.set);
    } catch (...) {
      error = std::current_exception();
    }
    lock.lock();
    error_ = error;
    job_ = {};
    changed_.notify_all();
  }
}

}  // namespace glissade::haptics
