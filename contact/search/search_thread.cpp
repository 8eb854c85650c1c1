#include "search/search_thread.h"

#include <utility>

namespace glissade::contact {
namespace {

constexpr std::int64_t kWorkOfCheck = 500'000;  // about half a millisecond

}  // namespace

SearchThread::SearchThread(std::int64_t work_ahead)
    : work_ahead_(work_ahead), thread_([this](const std::stop_token& stop) {
        realtime::name_this_thread("search");
        run(stop);
      }) {}

void SearchThread::begin(CandidateSearch& search, const CandidateRequest& request, CandidateSet& set) {
  {
    const std::lock_guard lock(mutex_);
    job_ = {&search, &request, &set, realtime::fifo_priority_of_this_thread()};
    work_ = 0;
    allowed_ = 0;
    lock_at_ = work_ahead_;
  }
  changed_.notify_all();
}

void SearchThread::allow(std::int64_t allowed) {
  const std::lock_guard lock(mutex_);
  allowed_ = allowed;
  lock_at_ = at_most_ahead();
  if (is_held_up_) changed_.notify_all();
}

/// The work with which the thread must look again whether it may go on.
std::int64_t SearchThread::at_most_ahead() const {
  return allowed_ > kUnlimitedWork - work_ahead_ ? kUnlimitedWork : allowed_ + work_ahead_;
}

void SearchThread::wait_for_work(std::int64_t allowed) {
  std::unique_lock lock(mutex_);
  lock_at_ = allowed_ = allowed;
  if (is_held_up_) changed_.notify_all();
  changed_.wait(lock, [&] { return is_done() || work_ > allowed; });
}

bool SearchThread::wait(std::int64_t allowed) {
  wait_for_work(allowed);
  const std::lock_guard lock(mutex_);
  if (!is_done() || work_ > allowed) return false;
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
  return true;
}

bool SearchThread::cancel() {
  std::unique_lock lock(mutex_);
  const bool ends_early = !is_done() || error_;
  is_cancelled_ = true;
  lock_at_ = -1;
  changed_.notify_all();
  changed_.wait(lock, [this] { return is_done(); });
  is_cancelled_ = false;
  error_ = nullptr;
  return ends_early;
}

void SearchThread::spend(std::int64_t work) {
  const std::int64_t done = work_.load(std::memory_order_relaxed) + work;
  work_.store(done, std::memory_order_relaxed);  // only this thread writes while it searches
  if (priority_ && done > check_at_) {
    check_at_ = done + kWorkOfCheck;
    priority_->check();
  }
  if (done <= lock_at_) return;
  std::unique_lock lock(mutex_);
  changed_.notify_all();
  is_held_up_ = true;
  changed_.wait(lock, stop_, [&] { return done - work_ahead_ <= allowed_ || is_cancelled_; });
  is_held_up_ = false;
  if (is_cancelled_ || stop_.stop_requested()) throw Cancelled{};
  // Somebody may wait for more work than is allowed. Once that is done, to lock again and again would starve a thread
  // that waits for the lock.
  lock_at_ = done <= allowed_ ? allowed_ : at_most_ahead();
}

/// Takes the place behind the first asker that has a priority, and keeps it. A later asker may have used up its share.
void SearchThread::follow(int priority_of_asker) {
  if (priority_of_asker > 1 && !priority_) priority_.emplace(priority_of_asker - 1, realtime::kSearchShare);
  check_at_ = 0;
}

void SearchThread::run(const std::stop_token& stop) {
  stop_ = stop;
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [this] { return !is_done(); })) {
    const Job job = job_;
    lock.unlock();
    follow(job.priority_of_asker);
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

}  // namespace glissade::contact
