#pragma once

// Argument checks shared by the mesh generators.

#include <cstdint>

namespace glissade::collision {

// Both throw std::invalid_argument naming the argument and its value.
void require_positive(const char* name, double value);
void require_triangle_count(std::int64_t triangle_count);

}  // namespace glissade::collision
