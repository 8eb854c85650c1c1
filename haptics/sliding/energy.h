#pragma once

/// The energy of the couplings' springs, which a step must not raise.

#include <span>

#include "sliding/simulated_parts.h"

namespace glissade::haptics {

/// Joules, with the parts displaced from where they aim by `errors`.
double energy(std::span<const HeldPartState> parts, const Displacements& errors);

/// Joules by which contacts that ask for their margin back may raise it.
double energy_allowance(std::span<const HeldPartState> parts, const Displacements& errors, double largest_margin);

}  // namespace glissade::haptics
