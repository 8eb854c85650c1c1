#pragma once

/// What a simulation tells of a hand.

#include <glissade/devices/haptic_state.h>

#include "life/grasping_hand.h"

namespace glissade::grasping {

devices::HandActivity activity_of(const GraspingHand& hand);

/// Writes activity and grasp into `told`.
void tell_grasp(const GraspingHand& hand, devices::VisibleHand& told);

}  // namespace glissade::grasping
