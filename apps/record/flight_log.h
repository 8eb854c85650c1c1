#pragma once

/// The flight recorder of a run: the last seconds in memory, and files of them after faults and on request.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>

#include <glissade/haptics/recording.h>

namespace glissade::apps {

/// Notes faults of the gloves: the force of a hand fades for a reason that nobody asked for. `write` is due half a
/// second after the beginning of a fault, so that the file has both sides of it.
class FlightLog final : public haptics::LoopObserver {
 public:
  /// A run writes no more files than this: a glove that is lost again and again must not fill the disk.
  static constexpr int kMostFiles = 10;

  FlightLog(std::string path, haptics::RecordingHead head) : path_(std::move(path)), recorder_(std::move(head)) {}

  void after_tick(const haptics::TickRecord& record) noexcept override;
  void after_answer(const haptics::AnswerRecord& record) noexcept override { recorder_.after_answer(record); }

  /// Whether a fault is to be written. Any thread.
  bool is_due() const noexcept { return is_due_.load(std::memory_order_relaxed); }

  /// Writes what is kept to the path or, if there is such a file, to the path with the next free number before its
  /// extension: "-2", "-3", ... Returns a sentence for the user: the file's name, or what went wrong. `is_last`: the
  /// run ends by a failure, which is written however many files there are. One thread; blocks.
  std::string write(bool is_last = false);

 private:
  std::string path_;
  haptics::FlightRecorder recorder_;
  bool was_at_fault_ = false;
  std::chrono::nanoseconds fault_at_{0};
  bool is_pending_ = false;
  std::atomic<bool> is_due_{false};
  int files_ = 0;
};

}  // namespace glissade::apps
