#pragma once

/// Contact sets from the results of a simulation.

#include <chrono>
#include <cstdint>
#include <vector>

#include <glissade/contact/multi_part_sliding.h>
#include <glissade/haptics/contact_set.h>

namespace glissade::haptics {

/// A contact among those of a part, and what makes it urgent.
struct UrgentContact {
  double gap;  // metres
  std::int32_t number;
  bool pushes;
};

/// The contact set made from the newest results of `sliding`. `sequence` is the number of the contact set; `time`
/// is the time of the ghost poses that it answers. `scratch` is working memory; pass the same vector to each call.
/// Cost O(contacts).
ContactSet make_contact_set(const contact::MultiPartSliding& sliding, std::int64_t sequence,
                            std::chrono::nanoseconds time, std::vector<UrgentContact>& scratch);

/// The same in the place of an older set of the same simulation, which takes less time: nothing is written beyond the
/// rows in use. The answers for hands stay.
void renew_contact_set(const contact::MultiPartSliding& sliding, std::int64_t sequence, std::chrono::nanoseconds time,
                       std::vector<UrgentContact>& scratch, ContactSet& set);

}  // namespace glissade::haptics
