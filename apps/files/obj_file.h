#pragma once

/// Scenes as Wavefront OBJ, for other programs.

#include <string>

#include <glissade/viewer/view_scene.h>

namespace glissade::apps {

/// The scene as text: a group for each object, and one for each segment of a hand whose links have poses
/// ("hand_0_thumb_distal"). Vertices are those of the meshes, in metres and world axes, with the digits that a double
/// needs. Characters of names that OBJ would take for the end of the name become "_".
std::string obj_text(const viewer::ViewScene& scene);

}  // namespace glissade::apps
