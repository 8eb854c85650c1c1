#pragma once

/// The contacts of a call, as the results of the parts report them.

#include <vector>

#include <glissade/haptics/sliding_result.h>

#include "sliding/overlaps.h"
#include "sliding/simulated_parts.h"

namespace glissade::haptics {

/// Gives each part its own contacts, seen from its side, and adds the contacts of overlaps. `contacts` are those of the
/// last cycle; their memory is reused, so their contents are arbitrary afterwards. The call answers `milliseconds` of
/// motion.
void report_contacts(SimulatedParts& shared, const Overlaps& overlaps, std::vector<Contact>& contacts,
                     double milliseconds);

}  // namespace glissade::haptics
