#pragma once

/// The fraction of its projected displacement that each part may take in a step.

#include <array>

#include "cycle/contact_rows.h"
#include "cycle/simulated_parts.h"

namespace glissade::contact {

struct AllowedFractions {
  std::array<double, kMaxParts> of_parts{};
  std::array<double, kMaxParts> beyond_reach{};  ///< the same if the reach did not matter
};

/// The fractions that the reach (metres), the slew and the linearisation of rotations allow. Two parts with a common
/// row get the same fraction, because the row holds for both displacements together.
AllowedFractions allowed_fractions(const SimulatedParts& shared, const Displacements& d, const ContactRows& rows,
                                   double reach);

}  // namespace glissade::contact
