#pragma once

/// The contacts of a call, as the results of the parts report them.

#include <span>
#include <vector>

#include <glissade/contact/sliding_result.h>

#include "cycle/simulated_parts.h"
#include "cycle/starts.h"

namespace glissade::contact {

/// Gives each part its own contacts, seen from its side, and adds the contacts of overlaps out of
/// which parts are pushed. The contacts of an inset are those of its part. `contacts` are those of the
/// last cycle; their memory is reused, so their contents are arbitrary afterwards. The call answers `milliseconds` of
/// motion.
void report_contacts(SimulatedParts& shared, std::span<const WayOut> ways_out, std::vector<Contact>& contacts,
                     double milliseconds);

}  // namespace glissade::contact
