#pragma once

/// The record of a run of the haptic loop.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glissade/devices/haptic_state.h>

namespace glissade::apps {

/// The newest ticks of a run, in preallocated memory. The haptic thread fills it.
class SessionRecorder {
 public:
  struct Tick {
    std::chrono::nanoseconds time{0};
    std::chrono::nanoseconds contact_set_age{0};
    std::chrono::nanoseconds lateness{0};
    std::chrono::nanoseconds last_duration{0};
    bool is_contact_set_late = false;
  };

  SessionRecorder(std::size_t capacity, std::size_t parts, std::size_t hands);

  /// Wait-free, no allocation. One thread.
  void record(const devices::HapticState& sample) noexcept;

  // After the run: the kept ticks are numbered from 0, the oldest first.
  /// Number of recorded ticks, including overwritten ones.
  std::int64_t total() const { return total_; }
  std::size_t size() const;
  std::size_t parts() const { return parts_; }
  std::size_t hands() const { return hands_; }
  const Tick& tick(std::size_t i) const { return ticks_[slot(i)]; }
  const devices::HapticPartState& part(std::size_t i, std::size_t part) const {
    return part_states_[slot(i) * parts_ + part];
  }
  const devices::HapticHandState& hand(std::size_t i, std::size_t hand) const {
    return hand_states_[slot(i) * hands_ + hand];
  }
  /// All of a tick; its contacts and patches are those of the last tick before it whose contacts are kept, one in 16.
  devices::HapticState state(std::size_t i) const;

 private:
  static constexpr std::int64_t kContactsEvery = 16;  // ticks: about as often as a replay has frames

  struct Contacts {
    std::int32_t count = 0;
    std::array<devices::HapticContact, devices::kHapticContacts> contacts{};
    std::int32_t patch_count = 0;
    std::int32_t patches_left_out = 0;
    std::array<devices::HapticPatch, devices::kHapticPatches> patches{};
  };

  std::size_t slot(std::size_t i) const;

  std::size_t parts_;
  std::size_t hands_;
  std::vector<Tick> ticks_;
  std::vector<devices::HapticPartState> part_states_;
  std::vector<devices::HapticHandState> hand_states_;
  std::vector<Contacts> contacts_;
  std::int64_t total_ = 0;
};

}  // namespace glissade::apps
