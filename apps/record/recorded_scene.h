#pragma once

/// The scene of a recording, and its hands.

#include <memory>
#include <string>
#include <vector>

#include <glissade/apps/record/recorded_session.h>
#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/grasping/hand_model.h>
#include <glissade/viewer/view_scene.h>

namespace glissade::apps {

/// The scene of a recorded run: that of `scene_file`, or the recorded one if the name is empty. Throws
/// std::invalid_argument, naming the file, for a scene that cannot be read or is not the recorded one.
HapticScene recorded_scene(const std::string& log_path, const RecordedSession& session, const std::string& scene_file);

/// The same for viewers, with the hands of the run.
viewer::ViewScene recorded_view(const std::string& log_path, const RecordedSession& session,
                                const std::string& scene_file);

}  // namespace glissade::apps
