#pragma once

// What is inside the car of benchmark_shapes.h. Private to car_body.cpp.

#include "patch_work.h"

namespace glissade::collision {

// Seats, dashboard, steering wheel, levers and mirrors, in the frame of the car.
void add_car_interior(PatchWork& work, bool is_complete);

}  // namespace glissade::collision
