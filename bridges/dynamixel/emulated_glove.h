#pragma once

/// A glove of emulated servos and its wearer.

#include <memory>

#include <glissade/bridges/dynamixel_hand.h>
#include <glissade/bridges/emulator.h>
#include <glissade/devices/glove_model.h>

#include "dynamixel/emulated_board.h"
#include "dynamixel/emulated_bus.h"

namespace glissade::bridges::dynamixel {

/// The servos and the measuring board of `hand`, at the fingers of one wearer.
struct ServoGlove {
  std::shared_ptr<EmulatedBus> bus;
  std::shared_ptr<EmulatedBoard> board;  ///< null without measured joints
};

/// The model of such a glove: the preset "dynamixel", with motors at the joints and of the servos of `hand`.
devices::GloveModel model_of(const DynamixelHand& hand);

/// `bus` and `board` must be used in one thread. A torque acts a millisecond after the servo has found it. Throws what
/// `validate` throws.
ServoGlove emulate(const DynamixelHand& hand, const devices::GloveModel& model, EmulatedWearer wearer);

}  // namespace glissade::bridges::dynamixel
