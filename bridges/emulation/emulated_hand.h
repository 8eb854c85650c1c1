#pragma once

/// The fingers of a wearer in an emulated device.

#include <chrono>

#include <glissade/bridges/emulator.h>
#include <glissade/devices/glove_model.h>

namespace glissade::bridges {

/// Time begins at 0 and never goes back. Several emulated devices of one hand may share it, in one thread.
class EmulatedHand {
 public:
  /// Throws what `devices::DrivenFingers` throws.
  EmulatedHand(const devices::GloveModel& model, EmulatedWearer wearer);

  /// A time that is already past changes nothing.
  void advance_to(std::chrono::nanoseconds now);

  devices::DrivenFingers& fingers() noexcept { return fingers_; }

 private:
  EmulatedWearer wearer_;
  devices::DrivenFingers fingers_;
  std::chrono::nanoseconds now_{0};
};

}  // namespace glissade::bridges
