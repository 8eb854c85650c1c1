#pragma once

/// The Adroit hand that opened the doors of the recordings (adroit_recording.h), as a chain with its own bones. A human
/// hand with the recorded angles has segments that are millimetres away from the recorded ones.

#include <memory>

#include <glissade/grasping/hand_model.h>

#include "adroit_recording.h"

namespace glissade::test_support {

/// Has all joints of `kAdroitJointNames` in their order, except those of the wrist, and no limits. The root is the
/// palm, whose pose `adroit_palm` gives; it consists of two boxes. The segments of thumb and fingers are capsules.
/// Bones and radii are those of the task; everything is `margin_m` thicker on all sides.
std::shared_ptr<const grasping::HandModel> make_adroit_hand(double margin_m);

/// Its palm and joints in a row.
grasping::Posture adroit_posture(const AdroitRow& row);

}  // namespace glissade::test_support
