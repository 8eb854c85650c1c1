#pragma once

#include <cstdint>

namespace glissade::contact {

/// Pairs of features of two triangles, one bit each.
using FeaturePairs = std::uint32_t;

}  // namespace glissade::contact
