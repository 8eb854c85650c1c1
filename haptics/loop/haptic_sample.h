#pragma once

/// The record of one haptic tick: the kernel's outcome and the contact set that it used.

#include <chrono>

#include <glissade/devices/haptic_state.h>
#include <glissade/haptics/haptic_kernel.h>

namespace glissade::haptics {

/// A contact set older than this is late: the simulation takes longer than a few ticks for an answer.
inline constexpr std::chrono::milliseconds kLateContactSet{5};

/// The state as sent on the wire.
devices::PartState part_state_of(SlidingState state) noexcept;

/// The state for viewers and recorders, at time `now` of the haptic clock. The wrench is the one sent to the device,
/// moved to the origin of the visible part. Real-time safe.
devices::HapticState make_sample(const HapticTick& tick, const ContactSet& set, const devices::GloveState& state,
                                 std::chrono::nanoseconds now) noexcept;

}  // namespace glissade::haptics
