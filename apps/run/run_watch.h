#pragma once

/// What a run in real time tells while it goes on: events with their times, and a line about its state.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glissade/apps/run/reason_teller.h>
#include <glissade/devices/haptic_state.h>
#include <glissade/realtime/triple_buffer.h>

namespace glissade::apps {

class RunWatch {
 public:
  /// A hand, by the number of its glove, and the part that it is given at first.
  struct Hand {
    std::int64_t glove = 0;
    std::optional<std::size_t> part;
  };

  /// `duration_s` is that of the run; 0: no limit.
  RunWatch(std::vector<std::string> part_names, const std::vector<Hand>& hands, double duration_s);

  /// After every tick, in the haptic thread. Wait-free, no allocation.
  void note(const devices::HapticState& state) noexcept;

  struct News {
    /// Since the last call, such as "12.345 s: the glove takes 'motor'". The times of lines never fall: an event that
    /// is told after a later one has the present time, and its own at the end, such as "(at 11.845 s)".
    std::vector<std::string> events;
    std::string status;  ///< as `to_text` of `RunStatus`; empty before the first tick
  };

  /// One thread, some times a second. `late_ticks` is their number so far.
  News news(std::int64_t late_ticks);

 private:
  /// A hand as it has been told of.
  struct Told {
    std::int64_t glove;
    std::int32_t part;
    bool has_held = false;
    bool is_lost = false;
    std::chrono::nanoseconds lost_at{0};
    std::chrono::nanoseconds held_at{0};  // when `part` was told
  };

  struct Newest {
    std::chrono::nanoseconds start{0};  // of the run
    std::array<std::chrono::nanoseconds, devices::kHapticHands> held_since{};
    devices::HapticState state;
  };

  std::vector<std::string> in_order(std::vector<TimedSentence> sentences);
  std::string name_of(const Told& hand) const;
  void tell_reasons(std::vector<TimedSentence>& sentences);
  void tell_hold(std::size_t hand, std::vector<TimedSentence>& sentences);
  void tell_loss(std::size_t hand, std::vector<TimedSentence>& sentences);
  std::string status(std::int64_t late_ticks);

  std::vector<std::string> part_names_;
  double duration_s_;

  // Haptic thread.
  Newest noted_;
  bool has_noted_ = false;

  // Shared.
  realtime::TripleBuffer<Newest> newest_;
  ReasonTeller simulation_;
  std::vector<std::unique_ptr<ReasonTeller>> reasons_;  // of each hand

  // The thread that tells.
  std::vector<Told> told_;
  bool has_news_ = false;
  std::int64_t last_sequence_ = 0;
  std::chrono::nanoseconds last_time_{0};
  std::chrono::nanoseconds last_told_{0};  // the greatest time of a line
};

}  // namespace glissade::apps
