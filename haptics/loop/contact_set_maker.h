#pragma once

/// Contact sets from the results of a simulation.

#include <chrono>
#include <cstdint>
#include <vector>

#include <glissade/haptics/contact_set.h>
#include <glissade/haptics/multi_part_sliding.h>

namespace glissade::haptics {

/// The contact set made from the newest results of `sliding`. `sequence` is the number of the contact set; `time`
/// is the time of the ghost poses that it answers. `scratch` is working memory; pass the same vector to each call.
/// Cost O(contacts).
ContactSet make_contact_set(const MultiPartSliding& sliding, std::int64_t sequence, std::chrono::nanoseconds time,
                            std::vector<std::int32_t>& scratch);

}  // namespace glissade::haptics
