#pragma once

/// From the curl of a finger to the angles of its joints, and from limits of joints to one of the curl.

#include <glissade/bridges/opengloves.h>
#include <glissade/devices/glove_device.h>
#include <glissade/hands/hand.h>

#include "opengloves/line_codec.h"

namespace glissade::bridges {

/// The share of its way that a finger is closed, from the number of its sensor. From 0 to 1.
double curl_of(double number, const SensorRange& sensor) noexcept;

/// The angles (rad) of all joints. The joints of a finger turn together, from the open hand to the fist. The others
/// stay: the thumb opposite to the palm, fingers side by side, a straight wrist.
hands::JointValues angles_of(const FingerValues& curls) noexcept;

/// The ranges of the joints that turn. 0 for the joints that the glove lacks.
hands::JointValues lower_angles() noexcept;
hands::JointValues upper_angles() noexcept;

/// The largest curl of each finger, from limits of its joints: that at which the first of them is at its limit. 1 is no
/// limit. With less than `max_torque`, a limit counts as much farther out: it goes all the way as the torque fades.
/// Limits against opening do not count: the glove stops fingers that close.
FingerValues curl_limits(const devices::JointLimits& limits, double max_torque) noexcept;

/// The numbers of a limit line. A servo pulls a finger open that is closed farther than its limit allows. So no limit
/// is tighter than the finger is now: the glove stops fingers and never moves them. Rounds to the freer side.
FingerNumbers limit_numbers(const FingerValues& curl_limits, const FingerValues& curls) noexcept;

}  // namespace glissade::bridges
