#pragma once

/// What the haptic loop consumed and produced, tick by tick and answer by answer: for recordings, from which a run can
/// be repeated to the bit (`Replay` in `offline_run.h`).

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>

#include <glissade/devices/glove_device.h>
#include <glissade/devices/haptic_state.h>
#include <glissade/haptics/contact_set.h>
#include <glissade/haptics/haptic_kernel.h>

namespace glissade::haptics {

/// A hand takes hold of a part, or lets go.
struct HoldRequest {
  std::int32_t hand = 0;
  std::int32_t part = -1;  ///< −1: it lets go
};

/// The requests of one tick, in their order.
class HoldRequests {
 public:
  static constexpr std::size_t kMost = 16;

  /// As `HapticKernel::grasp` and `HapticKernel::release`. Return false, and do nothing, when there are kMost already.
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
  std::int64_t number = 0;               ///< 1, 2, 3, …: of all ticks with a state of any hand
  std::int64_t sequence = 0;             ///< of `state`; 0: a tick of the fade at the end, which has no state
  std::chrono::nanoseconds deadline{0};  ///< scheduled start
  std::chrono::nanoseconds time{0};      ///< actual start, on the loop's clock
  bool is_stopped = false;               ///< the force of all hands was stopped before this tick
  std::int32_t hand_count = 0;           ///< entries in use in arrays of hands
  std::array<bool, kMaxHands> has_state{};
  std::array<devices::GloveState, kMaxHands> states{};  ///< the newest one of each hand that has one
  HoldRequests requests;
  std::int64_t set_sequence = 0;  ///< `ContactSet::sequence` of the newest set

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

/// Gets what a loop does. A loop calls the functions in its two threads, so they must be real-time safe.
class LoopObserver {
 public:
  virtual ~LoopObserver() = default;

  virtual void after_tick(const TickRecord& record) noexcept = 0;      ///< haptic thread
  virtual void after_answer(const AnswerRecord& record) noexcept = 0;  ///< simulation thread, before the set is used
};

}  // namespace glissade::haptics
