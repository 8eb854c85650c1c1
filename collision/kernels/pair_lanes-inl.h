// Vectors whose lanes are pairs of children or of triangles, 4 · of_M + of_N. Compiled once for each instruction set,
// with the file that includes it.
#if defined(GLISSADE_COLLISION_PAIR_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GLISSADE_COLLISION_PAIR_LANES_INL_H_
#undef GLISSADE_COLLISION_PAIR_LANES_INL_H_
#else
#define GLISSADE_COLLISION_PAIR_LANES_INL_H_
#endif

#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>

#include "tree/dop_node.h"

HWY_BEFORE_NAMESPACE();
namespace glissade::collision::HWY_NAMESPACE {

constexpr std::size_t kPairs = kWidth * kWidth;

// For a vector that starts at pair `first`: the value of M for each pair.
template <class D>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<D> of_M(D d, const float* values, std::size_t first) {
  namespace hn = hwy::HWY_NAMESPACE;
  if constexpr (hn::MaxLanes(D()) == kWidth) {
    return hn::Set(d, values[first / kWidth]);
  } else {
    alignas(64) static constexpr std::int32_t kOfP[kPairs] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
    return hn::TableLookupLanes(hn::LoadDup128(d, values), hn::SetTableIndices(d, kOfP + first));
  }
}

// The value of N for each pair. It is the same wherever the vector starts.
template <class D>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<D> of_N(D d, const float* values) {
  return hwy::HWY_NAMESPACE::LoadDup128(d, values);
}

// One bit for each lane.
template <class D>
HWY_INLINE std::uint32_t bits_of(D d, hwy::HWY_NAMESPACE::Mask<D> mask) {
  std::uint8_t bits[8] = {};  // StoreMaskBits may write 8 bytes
  hwy::HWY_NAMESPACE::StoreMaskBits(d, mask, bits);
  return static_cast<std::uint32_t>(bits[0] | bits[1] << 8);
}

// The reverse.
template <class D>
HWY_INLINE hwy::HWY_NAMESPACE::Mask<D> mask_of(D d, std::uint32_t bits) {
  const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8)};
  return hwy::HWY_NAMESPACE::LoadMaskBits(d, bytes);
}

}  // namespace glissade::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
