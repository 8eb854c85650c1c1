#pragma once

/// A hand of emulated Dynamixel servos, to try a bridge and a scene without hardware.

#include <chrono>
#include <memory>

#include <glissade/bridges/byte_stream.h>
#include <glissade/bridges/dynamixel_hand.h>
#include <glissade/realtime/clock.h>

namespace glissade::bridges {

/// The lines of an emulated hand. Each may be used by one thread, the same for both.
struct EmulatedDynamixelHand {
  std::shared_ptr<ByteStream> bus;
  std::shared_ptr<ByteStream> board;  ///< null without measured joints
};

struct EmulatedWearer {
  double closed = 0.8;  ///< share of the joint's upper limit to which the fingers close
  /// The fingers close and open once in this time. 0: they close and stay closed.
  std::chrono::nanoseconds cycle{std::chrono::seconds(4)};
  double stiffness = 0.3;  ///< of each finger joint, Nm/rad
  double damping = 0.015;  ///< viscous friction of each finger joint, Nm s/rad
};

/// Emulates the servos and the measuring board of `hand`, and fingers that yield to the servos. They have no mass. The
/// emulation runs whenever a line is used. Without a clock, it runs on that of the machine. Throws what `validate`
/// throws.
EmulatedDynamixelHand emulate(const DynamixelHand& hand, const EmulatedWearer& wearer = {},
                              std::shared_ptr<realtime::Clock> clock = nullptr);

}  // namespace glissade::bridges
