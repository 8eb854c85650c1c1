#pragma once

/// How much of a projected displacement each part may go.

#include <array>
#include <span>

#include "sliding/simulated_parts.h"
#include "solver/projection.h"

namespace glissade::haptics {

/// The fractions that the reach (metres), the slew and the linearisation of rotations allow. Parts that touch, or may
/// soon, are shortened alike: a row between two parts holds for both displacements together.
std::array<double, kMaxParts> allowed_fractions(const SimulatedParts& shared, const Displacements& d,
                                                std::span<const CoupledRow> rows, double reach);

}  // namespace glissade::haptics
