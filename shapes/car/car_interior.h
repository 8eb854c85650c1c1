#pragma once

/// The parts inside the car of benchmark_shapes.h.

#include "surfaces/patch_work.h"

namespace glissade::shapes {

/// Seats, dashboard, steering wheel, levers and mirrors, in the frame of the car.
void add_car_interior(PatchWork& work, bool is_complete);

}  // namespace glissade::shapes
