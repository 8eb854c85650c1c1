#include "record/answers_ahead.h"

#include <algorithm>
#include <utility>

#include <glissade/base/assert.h>
#include <glissade/realtime/periodic_thread.h>

namespace glissade::haptics {

AnswersAhead::AnswersAhead(Answer answer)
    : answer_(std::move(answer)), thread_([this](const std::stop_token& stop) {
        realtime::name_this_thread("simulation");
        run(stop);
      }) {}

void AnswersAhead::ask(const Ghosts& ghosts) {
  ++asked_;
  const std::lock_guard lock(mutex_);
  questions_.push_back(ghosts);
  if (questions_.size() == 1) changed_.notify_all();
}

void AnswersAhead::wait_for(std::size_t count) {
  const std::size_t wanted = taken_ + std::min(count, outstanding());
  if (answered_.load(std::memory_order_acquire) >= wanted) return;
  std::unique_lock lock(mutex_);
  wanted_ = wanted;
  changed_.wait(lock, [this] { return answered_.load(std::memory_order_relaxed) >= wanted_ || error_; });
}

std::unique_ptr<AnswerRecord> AnswersAhead::take() {
  GLISSADE_ASSERT(outstanding() > 0);
  wait_for(1);
  const std::lock_guard lock(mutex_);
  if (answers_.empty()) std::rethrow_exception(error_);
  ++taken_;
  std::unique_ptr<AnswerRecord> answer = std::move(answers_.front());
  answers_.pop_front();
  return answer;
}

void AnswersAhead::give_back(std::unique_ptr<AnswerRecord> answer) {
  const std::lock_guard lock(mutex_);
  unused_.push_back(std::move(answer));
}

void AnswersAhead::run(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [this] { return !questions_.empty(); }) && !stop.stop_requested()) {
    std::unique_ptr<AnswerRecord> answer;
    if (!unused_.empty()) {
      answer = std::move(unused_.back());
      unused_.pop_back();
    } else {
      answer = std::make_unique<AnswerRecord>();
    }
    answer->ghosts = questions_.front();
    questions_.pop_front();
    lock.unlock();
    try {
      answer_(answer->ghosts, answer->set);
      lock.lock();
      answers_.push_back(std::move(answer));
    } catch (...) {
      if (!lock.owns_lock()) lock.lock();
      error_ = std::current_exception();
    }
    const std::size_t answered = answered_.load(std::memory_order_relaxed) + 1;
    answered_.store(answered, std::memory_order_release);
    if (answered == wanted_ || error_) changed_.notify_all();
    if (error_) return;
  }
}

}  // namespace glissade::haptics
