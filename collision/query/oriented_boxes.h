#pragma once

/// Separating-axis test between the oriented bounding boxes of two whole meshes. Realigned nodes have the face
/// directions of one tree only. Two box-like parts close to each other may be separated only by directions of the other
/// tree, or of both.

#include <glissade/collision/dop_tree.h>

#include "kernels/query_frame.h"

namespace glissade::collision {

/// Whether the boxes of both trees are certainly farther apart than `distance` (radii of the base) along one of the
/// fifteen axes that decide whether they are disjoint (S. Gottschalk et al. 1996).
bool boxes_apart(const DopTree& base, const DopTree& other, const QueryFrame& frame, double distance);

}  // namespace glissade::collision
