#pragma once

/// An emulated glove of Dynamixel servos, with the fingers of a wearer, behind pseudo-terminals. For tests of the
/// bridge, and for people without such a glove.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <glissade/bridges/dynamixel_hand.h>
#include <glissade/bridges/emulator.h>

namespace glissade::bridges {

struct DynamixelEmulatorOptions {
  std::string link;                     ///< path of a link to the port of the bus, which stays the same; empty: none
  std::string board_link;               ///< the same for the measuring board
  LineFaults faults;                    ///< of both lines
  std::uint64_t seed = 1;               ///< of the faults
  EmulatedWearer wearer = busy_wearer;  ///< in the thread of the emulator
};

/// What a servo does to its joint.
struct EmulatedServoState {
  bool has_torque = false;
  double torque = 0.0;  ///< on the joint, Nm
  double angle = 0.0;   ///< of the joint, rad
};

/// Runs in a thread of its own from construction to destruction. The dynamics are those of the preset "dynamixel".
class DynamixelEmulator {
 public:
  /// Throws what `validate` throws for the hand, and std::system_error if the system refuses a port.
  explicit DynamixelEmulator(const DynamixelHand& hand, const DynamixelEmulatorOptions& options = {});
  ~DynamixelEmulator();

  /// The port for `SerialStream`, or the link if there is one. Any thread may call this and the following functions.
  std::string port() const;
  /// The port of the measuring board; empty without measured joints.
  std::string board_port() const;
  /// In the order of the hand's servos.
  std::vector<EmulatedServoState> servos() const;
  /// Removes the ports, as if the plug of the adapter were pulled, and restores them. The servos have their own supply.
  void unplug();
  void plug();

 private:
  struct Parts;

  std::unique_ptr<Parts> parts_;
};

}  // namespace glissade::bridges
