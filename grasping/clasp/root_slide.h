#pragma once

#include <vector>

#include <glissade/geometry/displacement.h>

#include "clasp/closing_rows.h"

namespace glissade::grasping {

/// The displacement of the root, nearest to `wanted`, by which the chain as one rigid body closes no contact beyond its
/// room: so a hand that presses on something slides along it. Nearest in the metric |v|² + (ρ |w|)², with ρ = `radius`
/// (metres). By Hildreth's method, to a tenth of a per cent.
geometry::Displacement slide_root(const geometry::Displacement& wanted, const ClosingRows& rows, double radius,
                                  std::vector<double>& forces);

}  // namespace glissade::grasping
