#pragma once

/// What Foxglove draws of a run: messages foxglove.SceneUpdate.

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include <glissade/devices/haptic_state.h>
#include <glissade/viewer/view_scene.h>

namespace glissade::apps {

/// The frame of a segment of the hand with this number, such as "hand_0_palm".
std::string segment_frame(std::size_t hand, const std::string& link);

/// The scene in the place of everything before: an entity for each object, with its name, for the ghost of each part
/// that hands can hold, and for each segment of the hands with fingers. The meshes of the objects have at most about
/// `most_triangles` triangles together, without those of the ghosts.
nlohmann::json scene_update(const viewer::ViewScene& scene, std::size_t most_triangles, std::chrono::nanoseconds time);

/// One entity, in the place of the last one: a sphere and an arrow along the normal for each contact that pushes, or
/// for each patch if the state has patches only, then an arrow for the force on each hand. X_WH are the roots of the
/// hands, as far as they are known. Without contacts and forces, the entity is empty.
nlohmann::json contacts_update(const devices::HapticState& state,
                               std::span<const std::optional<Eigen::Isometry3d>> X_WH);

}  // namespace glissade::apps
