#pragma once

#include <cstdint>
#include <vector>

#include <glissade/collision/dop_tree.h>

namespace glissade::collision {

/// Fills `nodes` with the hierarchy over the given triangles, which it reorders so that each leaf is a run of them.
/// Returns the depth.
int build_nodes(const TriangleMesh& mesh, std::vector<std::int32_t>& triangles, std::vector<DopNode>& nodes);

}  // namespace glissade::collision
