#pragma once

/// What a recording shows at a moment.

#include <chrono>
#include <string>

#include <glissade/viewer/view_scene.h>

namespace glissade::apps {

/// The recorded scene `after` the first tick: the visible poses of parts, and of hands with fingers, in the last
/// HAPTIC_STATE up to then. The scene is that of `scene_file`, or the recorded one if the name is empty. Throws
/// std::invalid_argument, naming the file, for a log without a run, a scene that cannot be read or
/// is not the recorded one, and a moment before the first tick or after the last one; and std::runtime_error if the log
/// is damaged before the moment.
viewer::ViewScene recorded_moment(const std::string& log_path, const std::string& scene_file,
                                  std::chrono::nanoseconds after);

}  // namespace glissade::apps
