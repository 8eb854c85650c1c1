#pragma once

/// Random machine elements that fit each other with little play, the part in its place: a nut on its bolt, a gear that
/// meshes with another one on its post, a peg in its hole, a sleeve on a rod, a ball in its socket. Contact is all
/// round there, and free motions are few.

#include "random_numbers.h"
#include "sweeps/torture_scene.h"

namespace glissade::test_support {

TortureScene random_fit_scene(RandomNumbers& random);

}  // namespace glissade::test_support
