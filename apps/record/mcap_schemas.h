#pragma once

/// What the messages of `glissade log to-mcap` look like, as JSON Schema. The first two are those of Foxglove, as far
/// as the messages use them; docs/file_formats.md describes the others.

#include <nlohmann/json.hpp>

namespace glissade::apps {

/// foxglove.FrameTransforms, foxglove.SceneUpdate
nlohmann::json frame_transforms_schema();
nlohmann::json scene_update_schema();

/// Messages of /loop, /part_N and /hand_N. Units are in the names.
nlohmann::json loop_schema();
nlohmann::json part_schema();
nlohmann::json hand_schema();

}  // namespace glissade::apps
