#pragma once

/// A thread that answers ghosts one after the other, ahead of the reader of the answers: for the replay of a recording,
/// in which all ghosts are known from the beginning on.

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <stop_token>
#include <thread>
#include <vector>

#include <glissade/haptics/contact_set.h>
#include <glissade/haptics/recording.h>

namespace glissade::haptics {

/// Thread-safety: one thread owns the object. It is not real-time safe.
class AnswersAhead {
 public:
  using Answer = std::function<void(const Ghosts& ghosts, ContactSet& set)>;

  /// Only the thread calls `answer`.
  explicit AnswersAhead(Answer answer);
  AnswersAhead(const AnswersAhead&) = delete;
  AnswersAhead& operator=(const AnswersAhead&) = delete;
  /// Waits for the answer under way, and gives up the others.
  ~AnswersAhead() = default;

  /// Asks for the answer to these ghosts, after all that were asked for before. Does not wait.
  void ask(const Ghosts& ghosts);
  /// Number of answers that were asked for and not yet taken.
  std::size_t outstanding() const { return asked_ - taken_; }
  /// Whether `take` does not have to wait.
  bool has_next() const { return answered_.load(std::memory_order_acquire) > taken_; }
  /// Waits until at least `count` of the outstanding answers can be taken, or the last of all.
  void wait_for(std::size_t count);
  /// Takes the oldest answer, waits for it if need be. At least one must be outstanding. Rethrows the exception of the
  /// simulation; then no answer follows any more.
  std::unique_ptr<AnswerRecord> take();
  /// Gives back an answer that is of no use any more, so that another one can take its place.
  void give_back(std::unique_ptr<AnswerRecord> answer);

 private:
  void run(const std::stop_token& stop);

  Answer answer_;
  std::size_t asked_ = 0;
  std::size_t taken_ = 0;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<Ghosts> questions_;
  std::deque<std::unique_ptr<AnswerRecord>> answers_;
  std::vector<std::unique_ptr<AnswerRecord>> unused_;
  std::exception_ptr error_;
  std::size_t wanted_ = 0;                // the owner waits until so many are answered
  std::atomic<std::size_t> answered_{0};  // or failed
  std::jthread thread_;                   // last: it ends before the members that it uses
};

}  // namespace glissade::haptics
