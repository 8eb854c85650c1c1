#pragma once

/// What emulators of devices have in common. An emulated device has the wire of a real device, behind a port of this
/// machine, and the dynamics of a glove's model with a wearer.

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

#include <glissade/hands/hand.h>

namespace glissade::bridges {

/// Faults of the bytes that a device sends at one time, such as a line or a packet. Shares are from 0 to 1.
struct LineFaults {
  double garbage = 0.0;                  ///< share before which up to 20 random bytes arrive
  double cut = 0.0;                      ///< share of which only a first part arrives
  double flipped_bit = 0.0;              ///< share with one wrong bit
  bool has_echo = false;                 ///< the host hears its own bytes
  std::chrono::nanoseconds slowness{0};  ///< added to the time of all bytes
};

/// The joint angles (rad) to which a wearer moves the fingers, at a time after the start.
using EmulatedWearer = std::function<hands::JointValues(std::chrono::nanoseconds)>;

/// Closes and opens all fingers in four seconds, each finger a little later than the one before.
hands::JointValues busy_wearer(std::chrono::nanoseconds time);

}  // namespace glissade::bridges
