#pragma once

/// The assembly checks of several trajectories, each on the next free processor.

#include <functional>
#include <string>
#include <vector>

#include <glissade/apps/commands/slide_check.h>
#include <glissade/apps/files/followed_trajectory.h>
#include <glissade/apps/scene/haptic_scene.h>

namespace glissade::apps {

/// Checks `trajectories`, whose files have the names `files`, in helper threads, and shows the progress on a terminal.
/// Calls `take` in the calling thread with each outcome, in the order of the trajectories, as soon as it and all before
/// it are there. Throws as `check_slide`.
void check_side_by_side(const HapticScene& scene, std::vector<FollowedTrajectory> trajectories,
                        const std::vector<std::string>& files, const SlideCheckOptions& options,
                        const std::function<void(SlideCheck)>& take);

}  // namespace glissade::apps
