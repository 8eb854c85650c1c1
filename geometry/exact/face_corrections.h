#pragma once

namespace glissade::geometry {

/// Steps on the remainder after the first projection of a point on a face: they remove the error that the rounded
/// normal of a thin triangle causes. One suffices for most, the second for needles a billion times as long as wide. The
/// code for one pair and the vector code make the same number, for the same bits.
inline constexpr int kFaceCorrections = 2;

}  // namespace glissade::geometry
