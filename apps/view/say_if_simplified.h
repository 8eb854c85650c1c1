#pragma once

/// What a file of a large scene leaves out.

#include <cstddef>
#include <string>

#include <glissade/viewer/view_scene.h>

namespace glissade::apps {

/// Says in a line on standard error that a file shows the scene with at most about so many triangles, if it has more.
void say_if_simplified(const viewer::ViewScene& scene, std::size_t most_triangles, const std::string& file);

}  // namespace glissade::apps
