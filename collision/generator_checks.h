#pragma once

// Argument checks shared by the mesh generators.

#include <cstdint>

namespace glissade::collision {

// All throw std::invalid_argument naming the argument and its value.
void require_positive(const char* name, double value);
void require_triangle_count(std::int64_t triangle_count);
// From `least` to `most`, and a multiple of `multiple`.
void require_count(const char* name, int value, int least, int most, int multiple = 1);
void require_between(const char* name, double value, double least, double most);
// `value` < `limit`; `limit_name` says what that is, article included.
void require_below(const char* name, double value, const char* limit_name, double limit);

}  // namespace glissade::collision
