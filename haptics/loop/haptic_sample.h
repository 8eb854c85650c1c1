#pragma once

/// The record of one haptic tick: the kernel's outcome and the contact set that it used.

#include <chrono>
#include <span>

#include <glissade/devices/haptic_state.h>
#include <glissade/haptics/haptic_kernel.h>
#include <glissade/haptics/recording.h>

namespace glissade::haptics {

/// A contact set older than this is late: the simulation takes longer than a few ticks for an answer.
inline constexpr std::chrono::milliseconds kLateContactSet{5};

/// The state for viewers and recorders after a tick. `states` are those of the hands, as for the kernel. The wrench of
/// a hand is the one sent to its device, moved to the origin of the visible part that it holds. Real-time safe.
devices::HapticState make_sample(const TickRecord& record, const ContactSet& set,
                                 std::span<const devices::GloveState* const> states) noexcept;

}  // namespace glissade::haptics
