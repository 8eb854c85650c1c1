#pragma once

/// A number for each finger.

#include <array>
#include <cstddef>

namespace glissade::bridges {

inline constexpr std::size_t kFingers = 5;

/// One number for each finger, from the thumb to the little finger. A curl is 0 for a finger that is open, and 1 for
/// one that is closed.
using FingerValues = std::array<double, kFingers>;

}  // namespace glissade::bridges
