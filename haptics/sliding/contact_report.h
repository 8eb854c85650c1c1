#pragma once

/// The contacts of a call, as the results of the parts report them.

#include <vector>

#include <glissade/haptics/sliding_result.h>

#include "sliding/overlaps.h"
#include "sliding/simulated_parts.h"

namespace glissade::haptics {

/// Gives each part its own contacts, as it sees them, and adds those of overlaps. `contacts` is memory that calls
/// reuse; its contents are arbitrary afterwards.
void report_contacts(SimulatedParts& shared, const Overlaps& overlaps, std::vector<Contact>& contacts);

}  // namespace glissade::haptics
