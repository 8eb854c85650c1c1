#include "search/search_thread.h"

#include <utility>

#include <glissade/realtime/periodic_thread.h>

namespace glissade::haptics {

SearchThread::SearchThread(bool runs_ahead)
    : runs_ahead_(runs_ahead), thread_([this](const std::stop_token& stop) {
        realtime::name_this_thread("search");
        run(stop);
      }) {}

void SearchThread::begin(CandidateSearch& search, const CandidateRequest& request, CandidateSet& set) {
  {
    const std::lock_guard lock(mutex_);
    job_ = {&search, &request, &set};
    work_ = 0;
    allowed_ = runs_ahead_ ? kUnlimitedWork : 0;
  }
  changed_.notify_all();
}

void SearchThread::wait_for_work(std::int64_t allowed) {
  std::unique_lock lock(mutex_);
  allowed_ = allowed;
  changed_.notify_all();
  changed_.wait(lock, [&] { return is_done() || work_ > allowed; });
}

bool SearchThread::wait(std::int64_t allowed) {
  wait_for_work(allowed);
  const std::lock_guard lock(mutex_);
  if (!is_done() || work_ > allowed) return false;
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
  return true;
}

void SearchThread::cancel() {
  std::unique_lock lock(mutex_);
  is_cancelled_ = true;
  allowed_ = -1;
  changed_.notify_all();
  changed_.wait(lock, [this] { return is_done(); });
  is_cancelled_ = false;
  error_ = nullptr;
}

void SearchThread::spend(std::int64_t work) {
  if (work_.fetch_add(work) + work <= allowed_) return;
  std::unique_lock lock(mutex_);
  changed_.notify_all();
  if (runs_ahead_) {
    allowed_ = kUnlimitedWork;  // until the next wait: to lock again and again would starve the waiting thread
  } else {
    changed_.wait(lock, stop_, [this] { return work_ <= allowed_ || is_cancelled_; });
  }
  if (is_cancelled_) throw Cancelled{};
}

void SearchThread::run(const std::stop_token& stop) {
  stop_ = stop;
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [this] { return !is_done(); })) {
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
