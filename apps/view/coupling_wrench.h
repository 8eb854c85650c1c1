#pragma once

/// What the coupling of a part exerts on the hands that hold it, about the reference point of the visible part, in
/// world axes: zero while no contact pushes.

#include <cstddef>

#include <glissade/haptics/coupling.h>
#include <glissade/haptics/multi_part_sliding.h>
#include <glissade/haptics/sliding_simulation.h>

namespace glissade::apps {

haptics::Wrench wrench_about_reference(const haptics::SlidingSimulation& sliding);
haptics::Wrench wrench_about_reference(const haptics::MultiPartSliding& parts, std::size_t part);

}  // namespace glissade::apps
