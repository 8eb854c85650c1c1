#pragma once

/// From the numbers of a glove's sensors to curls, and from limits of joints to the numbers of a limit line.

#include <glissade/bridges/finger_values.h>
#include <glissade/bridges/opengloves.h>
#include <glissade/devices/glove_device.h>

#include "opengloves/line_codec.h"

namespace glissade::bridges {

/// The share of its way that a finger is closed, from the number of its sensor. From 0 to 1.
double curl_of(double number, const SensorRange& sensor) noexcept;

/// The largest curl of each finger, from its curl now and the limits of its joints: that at which a contact closes
/// (`devices::way_left`). 1 is no limit. With less than `max_torque`, a limit counts as much farther out: it goes all
/// the way as the torque fades. Limits against opening do not count: the glove stops fingers that close.
FingerValues curl_limits(const devices::JointLimits& limits, const FingerValues& curls, double max_torque) noexcept;

/// The numbers of a limit line. A servo pulls a finger open that is closed farther than its limit allows. So no limit
/// is tighter than the finger is now: the glove stops fingers and never moves them. Rounds to the freer side.
FingerNumbers limit_numbers(const FingerValues& curl_limits, const FingerValues& curls) noexcept;

}  // namespace glissade::bridges
