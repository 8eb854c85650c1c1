#pragma once

/// How a projection on half-spaces ended.

#include <cstdint>

namespace glissade::haptics {

enum class ProjectionStatus : std::uint8_t { kSolved, kInfeasible, kIterationLimit };

}  // namespace glissade::haptics
