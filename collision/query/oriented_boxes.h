#pragma once

/// Whether the bounding boxes of two whole meshes are apart, each box as its mesh is turned. Realigned nodes know the
/// faces of one tree only; two box-like parts that are close to each other are told apart by those of the other.

#include <glissade/collision/dop_tree.h>

#include "kernels/query_frame.h"

namespace glissade::collision {

/// The boxes of both trees are certainly further apart than `distance` (radii of the base), by one of the fifteen axes
/// that decide it (S. Gottschalk et al. 1996).
bool boxes_apart(const DopTree& base, const DopTree& other, const QueryFrame& frame, double distance);

}  // namespace glissade::collision
