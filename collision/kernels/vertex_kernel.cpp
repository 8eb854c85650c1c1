// Compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/vertex_kernel.cpp"
#include <algorithm>
#include <limits>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "kernels/vertex_alignment.h"

HWY_BEFORE_NAMESPACE();
namespace glissade::collision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kGroupLanes = 4 * kWidth;

// Reduces the vertices of each child, which lie four lanes apart, to one value.
template <class D, class Combine>
HWY_INLINE auto fold(D /*d*/, hn::Vec<D> lanes, const Combine& combine) {
  if constexpr (hn::MaxLanes(D()) == kWidth) {
    return lanes;
  } else {
    const hn::Half<D> half;
    return fold(half, combine(hn::LowerHalf(half, lanes), hn::UpperHalf(half, lanes)), combine);
  }
}

template <class V>
HWY_INLINE void store_rounded_up(V reach, std::int16_t* to) {
  const hn::FixedTag<float, kWidth> d;
  const hn::RebindToSigned<decltype(d)> d32;
  const hn::FixedTag<std::int16_t, kWidth> d16;
  const auto whole = hn::Clamp(hn::Ceil(reach), hn::Set(d, -32768.0F), hn::Set(d, 32767.0F));
  hn::Store(hn::DemoteTo(d16, hn::ConvertTo(d32, whole)), d16, to);
}

// Several rows at once: vertices are loaded less often, and no row waits for its previous extreme.
template <std::size_t kRows>
HWY_INLINE void realign_rows(const VertexAlignment& alignment, std::span<const VertexGroup> node_N, std::size_t first,
                             AlignedNode& aligned) {
  const hn::CappedTag<float, kGroupLanes> d;
  using V = hn::Vec<decltype(d)>;
  V direction[kRows][3];
  V high[kRows];
  V low[kRows];
  for (std::size_t r = 0; r < kRows; ++r) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      direction[r][axis] = hn::Set(d, alignment.direction[first + r][axis]);
    high[r] = hn::Set(d, std::numeric_limits<float>::lowest());
    low[r] = hn::Set(d, std::numeric_limits<float>::max());
  }
  for (const VertexGroup& group : node_N) {
    for (std::size_t lane = 0; lane < kGroupLanes; lane += hn::Lanes(d)) {
      const V x = hn::Load(d, group.coordinate[0].data() + lane);
      const V y = hn::Load(d, group.coordinate[1].data() + lane);
      const V z = hn::Load(d, group.coordinate[2].data() + lane);
      for (std::size_t r = 0; r < kRows; ++r) {
        const V height =
            hn::Add(hn::Mul(direction[r][0], x), hn::Add(hn::Mul(direction[r][1], y), hn::Mul(direction[r][2], z)));
        high[r] = hn::Max(high[r], height);
        low[r] = hn::Min(low[r], height);
      }
    }
  }
  const hn::FixedTag<float, kWidth> d4;
  for (std::size_t r = 0; r < kRows; ++r) {
    const auto highest = fold(d, high[r], [](auto a, auto b) HWY_ATTR { return hn::Max(a, b); });
    const auto lowest = fold(d, low[r], [](auto a, auto b) HWY_ATTR { return hn::Min(a, b); });
    std::int16_t* facing = aligned.facing.data() + 2 * kWidth * (first + r);
    store_rounded_up(hn::Sub(hn::Set(d4, alignment.below[first + r]), lowest), facing);
    store_rounded_up(hn::Add(hn::Set(d4, alignment.above[first + r]), highest), facing + kWidth);
  }
}

void realign(const VertexAlignment& alignment, std::span<const VertexGroup> node_N, AlignedNode& aligned) {
  const auto slabs = static_cast<std::size_t>(alignment.slabs);
  std::size_t row = 0;
  for (; row + 2 <= slabs; row += 2)
    realign_rows<2>(alignment, node_N, row, aligned);
  for (; row < slabs; ++row)
    realign_rows<1>(alignment, node_N, row, aligned);
  // Rows without a direction never separate.
  const std::size_t end = 4 * static_cast<std::size_t>(slab_lines(alignment.slabs));
  std::fill(aligned.facing.begin() + 2 * kWidth * row, aligned.facing.begin() + 2 * kWidth * end, std::int16_t{32767});
}

RealignVertices make_realign_vertices() {
  return realign;
}

}  // namespace glissade::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace glissade::collision {

HWY_EXPORT(make_realign_vertices);

RealignVertices realign_vertices() {
  return HWY_DYNAMIC_DISPATCH(make_realign_vertices)();
}

}  // namespace glissade::collision
#endif
