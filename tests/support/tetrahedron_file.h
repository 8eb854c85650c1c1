#pragma once

namespace glissade::test_support {

/// The smallest closed mesh, as an .obj file.
constexpr const char* kTetrahedronObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

}  // namespace glissade::test_support
