#pragma once

/// The energy of the couplings' springs, which a step must not raise.

#include <span>

#include "cycle/simulated_parts.h"

namespace glissade::contact {

/// Energy (joules) of parts that are displaced by `errors` from the poses at which they aim.
double energy(std::span<const HeldPartState> parts, const Displacements& errors);

/// Energy (joules) by which contacts that demand their margin back may raise it.
double energy_allowance(std::span<const HeldPartState> parts, const Displacements& errors, double largest_margin);

}  // namespace glissade::contact
