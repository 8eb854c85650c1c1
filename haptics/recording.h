#pragma once

/// Records of the inputs and results of the haptic loop, for each tick and each answer. `Replay` in `offline_run.h`
/// repeats a run from a recording bit by bit.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glissade/base/export.h>
#include <glissade/devices/event_log.h>
#include <glissade/devices/glove_device.h>
#include <glissade/devices/haptic_state.h>
#include <glissade/haptics/contact_set.h>
#include <glissade/haptics/haptic_kernel.h>
#include <glissade/realtime/clock.h>
#include <glissade/realtime/periodic_thread.h>
#include <glissade/realtime/spsc_ring.h>

namespace glissade::haptics {

/// A request to a hand: take hold of a part, or let go.
struct HoldRequest {
  std::int32_t hand = 0;
  std::int32_t part = -1;  ///< −1: the hand lets go
};

/// The requests of one tick, in order.
class HoldRequests {
 public:
  static constexpr std::size_t kMost = 16;

  /// Like `HapticKernel::grasp` and `HapticKernel::release`. Both return false and do nothing if there are already
  /// kMost requests.
  bool grasp(std::size_t hand, std::size_t part) noexcept {
    return add({static_cast<std::int32_t>(hand), static_cast<std::int32_t>(part)});
  }
  bool release(std::size_t hand) noexcept { return add({static_cast<std::int32_t>(hand), -1}); }
  bool add(const HoldRequest& request) noexcept {
    if (is_full()) return false;
    requests_[count_++] = request;
    return true;
  }
  bool is_full() const noexcept { return count_ == kMost; }
  void clear() noexcept { count_ = 0; }
  std::span<const HoldRequest> all() const noexcept { return {requests_.data(), count_}; }

 private:
  std::array<HoldRequest, kMost> requests_{};
  std::size_t count_ = 0;
};

/// One tick of the haptic thread.
struct TickRecord {
  // Consumed.
  std::int64_t number = 0;                    ///< 1, 2, 3, …; counts the ticks with a state of any hand
  std::int64_t sequence = 0;                  ///< sequence of `state`; 0: a tick of the final fade, without a state
  std::chrono::nanoseconds deadline{0};       ///< scheduled start
  std::chrono::nanoseconds time{0};           ///< actual start, on the loop's clock
  std::chrono::nanoseconds last_duration{0};  ///< `duration` of the previous tick
  bool is_stopped = false;                    ///< all forces were stopped before this tick
  std::int32_t hand_count = 0;                ///< number of used entries in the arrays of hands
  std::array<bool, hands::kMaxHands> has_state{};
  std::array<devices::GloveState, hands::kMaxHands> states{};  ///< the newest state of each hand with `has_state`
  HoldRequests requests;
  std::int64_t set_sequence = 0;  ///< `ContactSet::sequence` of the newest set
  std::int32_t part_count = 0;    ///< `ContactSet::part_count`

  // Produced.
  HapticTick tick;
  devices::HapticState state;            ///< for viewers
  std::chrono::nanoseconds duration{0};  ///< from `time` until the commands were handed over
};

/// One answer of the simulation.
struct AnswerRecord {
  Ghosts ghosts;   ///< consumed
  ContactSet set;  ///< produced
};

/// Receives the records of a loop. One thread may call both functions, or two threads may call one function each.
class GLISSADE_EXPORT LoopObserver {
 public:
  virtual ~LoopObserver() = default;

  virtual void after_tick(const TickRecord& record) noexcept = 0;
  virtual void after_answer(const AnswerRecord& record) noexcept = 0;  ///< called before a tick can use the answer
};

/// Passes the records of a real-time loop to observers that may be slow. The observers run in a separate thread. The
/// haptic thread and the simulation thread only fill ring buffers, so both functions are real-time safe. An answer is
/// passed on before the ticks that use it.
class GLISSADE_EXPORT BackgroundObserver final : public LoopObserver {
 public:
  /// The observers must outlive this object.
  explicit BackgroundObserver(std::vector<LoopObserver*> observers);
  BackgroundObserver(const BackgroundObserver&) = delete;
  BackgroundObserver& operator=(const BackgroundObserver&) = delete;
  /// Passes on the remaining records.
  ~BackgroundObserver() override;

  void after_tick(const TickRecord& record) noexcept override { ticks_.push(record); }
  void after_answer(const AnswerRecord& record) noexcept override { answers_.push(record); }

  /// Number of records lost because the thread was 1,000 ticks or more behind. Any thread.
  std::uint64_t dropped() const noexcept { return ticks_.dropped() + answers_.dropped(); }

 private:
  void pass_on() noexcept;

  std::vector<LoopObserver*> observers_;
  realtime::SteadyClock clock_;
  realtime::SpscRing<TickRecord> ticks_;
  realtime::SpscRing<AnswerRecord> answers_;
  std::vector<TickRecord> batch_;
  std::unique_ptr<realtime::PeriodicThread> thread_;
};

/// The gloves of a recorded loop, and the first events of the recording.
struct RecordingHead {
  std::vector<devices::GloveInfo> gloves;  ///< one for each hand
  std::vector<devices::LogEvent> events;   ///< events that the application adds
};

/// The events of a recording. HAPTIC_TICK and CONTACT_SET have all data that a replay needs. Other LCM programs can use
/// HAPTIC_STATE, GLOVE_STATE (for each new state) and GLOVE_INFO (five times a second). There are no GLOVE_COMMAND
/// events, so `lcm-logplayer` moves no glove. The times of events are on the loop's clock. Not thread-safe.
class GLISSADE_EXPORT RecordedEvents {
 public:
  explicit RecordedEvents(RecordingHead head) : head_(std::move(head)) {}

  const std::vector<devices::LogEvent>& at_start() const { return head_.events; }
  /// The HAPTIC_TICK event, followed by the events that `others_of` returns.
  std::vector<devices::LogEvent> of(const TickRecord& record);
  std::vector<devices::LogEvent> others_of(const TickRecord& record);
  static devices::LogEvent of(const AnswerRecord& record);

 private:
  RecordingHead head_;
  std::array<std::int64_t, hands::kMaxHands> newest_{};  // sequence of the last state of each glove, plus 1
  std::optional<std::chrono::nanoseconds> announced_;
};

/// The inputs, start time and duration of the tick in a HAPTIC_TICK event. The results of the tick have default values.
/// Returns no value if the event is on another channel or its bytes have been changed.
GLISSADE_EXPORT std::optional<TickRecord> consumed_by_tick(const devices::LogEvent& event);

/// Writes all events to a file.
class GLISSADE_EXPORT LogRecorder final : public LoopObserver {
 public:
  /// Throws std::invalid_argument, naming the file, when it cannot be created.
  LogRecorder(const std::string& path, RecordingHead head);

  void after_tick(const TickRecord& record) noexcept override;
  void after_answer(const AnswerRecord& record) noexcept override;

  /// Ends the file. Call this function after the last record. Throws std::runtime_error, naming the file, when
  /// something could not be written.
  void close();

 private:
  std::string path_;
  RecordedEvents events_;
  devices::EventLogWriter file_;
  bool is_incomplete_ = false;  // there was no memory for an event
};

/// Keeps the events of the last seconds in memory of bounded size. `write` writes them to a file. Thread-safe.
class GLISSADE_EXPORT FlightRecorder final : public LoopObserver {
 public:
  static constexpr std::size_t kDefaultBytes = std::size_t{64} << 20;  ///< about five seconds or more of one hand

  explicit FlightRecorder(RecordingHead head, std::size_t most_bytes = kDefaultBytes);

  void after_tick(const TickRecord& record) noexcept override;
  void after_answer(const AnswerRecord& record) noexcept override;

  /// Writes the kept events, the oldest first. Throws what `EventLogWriter` throws.
  void write(const std::string& path) const;

 private:
  void keep(devices::LogEvent event);

  mutable std::mutex mutex_;
  RecordedEvents events_;
  std::size_t most_bytes_;
  std::deque<devices::LogEvent> kept_;
  std::size_t bytes_ = 0;
};

}  // namespace glissade::haptics
