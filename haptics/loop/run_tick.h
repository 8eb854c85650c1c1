#pragma once

#include <glissade/haptics/contact_set.h>
#include <glissade/haptics/haptic_kernel.h>
#include <glissade/haptics/recording.h>

namespace glissade::haptics {

/// The tick of every loop, in real time, offline and in a replay: from what `record` says is consumed, and `set`, to
/// what it produces. Real-time safe.
void run_tick(HapticKernel& kernel, TickRecord& record, const ContactSet& set) noexcept;

}  // namespace glissade::haptics
