#pragma once

/// The limits of finger joints, for gloves that hold them in their own loop.

#include <glissade/devices/glove_device.h>
#include <glissade/haptics/contact_set.h>
#include <glissade/haptics/finger_forces.h>

namespace glissade::haptics {

/// The range in which each joint may turn alone, from the posture of the visible hand, until a contact of its segments
/// closes. At a contact, the limit is the visible joint itself. Contacts at an arm of less than 2 mm about a joint's
/// axis do not limit this joint, because their angle is not sharp. `share` is that of the largest torque, 0 to 1.
/// There are no limits without contacts. Cost: O(rows · joints). Real-time safe.
devices::JointLimits limits_of_hand(const FingerHand& hand, const devices::DeviceDescriptor& device,
                                    const HandAnswer& answer, double share) noexcept;

}  // namespace glissade::haptics
