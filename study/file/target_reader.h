#pragma once

/// Targets from their names in a study file, such as "path.x_m" or "plate.hole_radius_m".

#include <string>

#include <glissade/study/study.h>

namespace glissade::study {

/// Throws std::invalid_argument with one sentence. The sentence names what is unknown, and lists what is known.
Target target_from(const std::string& name, const simulation::Scene& scene, const std::string& part);

}  // namespace glissade::study
