#pragma once

/// Building the tree of pqp/tree.h, from the top down (Gottschalk and others 1996, section 4).

#include <glissade/geometry/triangle_mesh.h>

#include "tree.h"

namespace glissade::bench::pqp {

Tree build_tree(const geometry::TriangleMesh& mesh);

}  // namespace glissade::bench::pqp
