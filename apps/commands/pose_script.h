#pragma once

/// A script of a simulated hand that shows the poses of a calibration.

#include <glissade/apps/files/hand_script.h>

namespace glissade::apps {

/// Shows each pose of `bridges::calibration_poses` for this time. The hand changes its pose two fifths of the time
/// after `glissade calibrate` has asked for it, because both programs need not start at the same moment.
HandScript pose_script(double seconds_per_pose);

}  // namespace glissade::apps
