#pragma once

/// The outcome of a projection on half-spaces.

#include <cstdint>

namespace glissade::haptics {

enum class ProjectionStatus : std::uint8_t { kSolved, kInfeasible, kIterationLimit };

}  // namespace glissade::haptics
