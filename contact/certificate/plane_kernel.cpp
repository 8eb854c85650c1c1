// Compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "certificate/plane_kernel.cpp"
#include "certificate/plane_kernel.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// Without fused multiply-add and with the same order of operations, so that every rounding is the same.
HWY_BEFORE_NAMESPACE();
namespace glissade::contact::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using PlaneTag = hn::CappedTag<float, kPlanesAtOnce>;
using PlaneFloats = hn::Vec<PlaneTag>;

HWY_INLINE PlaneFloats sum_of_products(PlaneFloats a0, PlaneFloats b0, PlaneFloats a1, PlaneFloats b1, PlaneFloats a2,
                                       PlaneFloats b2) {
  return hn::Add(hn::Add(hn::Mul(a0, b0), hn::Mul(a1, b1)), hn::Mul(a2, b2));
}

// A difference of two numbers, times this, is not above the exact one where that is positive.
constexpr float kLessRounding = 1.0F - 1e-6F;

// The bits of a mask for the pairs from `first` on.
HWY_INLINE PairsOfBlock bits_of(hn::Mask<PlaneTag> mask, std::size_t first) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(PlaneTag(), mask, bytes);
  const auto bits = static_cast<std::uint32_t>(bytes[0]) | static_cast<std::uint32_t>(bytes[1]) << 8U;
  return static_cast<PairsOfBlock>(bits << first);
}

}  // namespace

void find_plane_gaps(std::span<const PlaneBlock> blocks, const PlaneMaps& maps, float* gaps) {
  const PlaneTag d;
  for (const PlaneBlock& block : blocks) {
    for (std::size_t first = 0; first < kPlanesAtOnce; first += hn::Lanes(d)) {
      const auto load = [&](const NumbersOfPlanes& from) HWY_ATTR { return hn::Load(d, from.data() + first); };
      const auto turns_with_part = hn::Gt(load(block.turns_with_part), hn::Zero(d));
      const auto entry = [&](std::size_t row, std::size_t column) HWY_ATTR {
        return hn::IfThenElse(turns_with_part, hn::Set(d, maps.of_obstacle.A[row][column]),
                              hn::Set(d, maps.of_part.A[row][column]));
      };
      const auto along = [&](std::size_t axis) HWY_ATTR {
        return hn::IfThenElse(turns_with_part, hn::Set(d, maps.of_obstacle.t[axis]), hn::Set(d, maps.of_part.t[axis]));
      };
      const PlaneFloats n0 = load(block.n[0]);
      const PlaneFloats n1 = load(block.n[1]);
      const PlaneFloats n2 = load(block.n[2]);
      // The direction is turned instead of the corners: there is only one.
      const PlaneFloats m0 = sum_of_products(n0, entry(0, 0), n1, entry(1, 0), n2, entry(2, 0));
      const PlaneFloats m1 = sum_of_products(n0, entry(0, 1), n1, entry(1, 1), n2, entry(2, 1));
      const PlaneFloats m2 = sum_of_products(n0, entry(0, 2), n1, entry(1, 2), n2, entry(2, 2));
      const auto height = [&](std::size_t corner) HWY_ATTR {
        return sum_of_products(m0, load(block.x[corner][0]), m1, load(block.x[corner][1]), m2,
                               load(block.x[corner][2]));
      };
      const PlaneFloats least = hn::Min(height(0), hn::Min(height(1), height(2)));
      const PlaneFloats origin = hn::Sub(sum_of_products(n0, along(0), n1, along(1), n2, along(2)), load(block.top));
      hn::StoreU(hn::Sub(hn::Add(least, origin), hn::Set(d, maps.slack)), d, gaps + first);
    }
    gaps += kPlanesAtOnce;
  }
}

void raise_gaps(std::span<const float> known, float clock, float* gaps, float* least) {
  const PlaneTag d;
  for (std::size_t i = 0; i < known.size(); i += kPlanesAtOnce) {
    PlaneFloats least_of_block = hn::Inf(d);
    for (std::size_t first = i; first < i + kPlanesAtOnce; first += hn::Lanes(d)) {
      const auto still_known =
          hn::Mul(hn::Sub(hn::LoadU(d, known.data() + first), hn::Set(d, clock)), hn::Set(d, kLessRounding));
      const auto gap = hn::Max(hn::LoadU(d, gaps + first), still_known);
      least_of_block = hn::Min(least_of_block, gap);
      hn::StoreU(gap, d, gaps + first);
    }
    *least++ = hn::GetLane(hn::MinOfLanes(d, least_of_block));
  }
}

PairsOfBlock find_pairs_within(float limit, const float* gaps) {
  const PlaneTag d;
  PairsOfBlock pairs = 0;
  for (std::size_t first = 0; first < kPlanesAtOnce; first += hn::Lanes(d))
    pairs |= bits_of(hn::Le(hn::LoadU(d, gaps + first), hn::Set(d, limit)), first);
  return pairs;
}

PairsOfBlock find_unproved(const PlaneBlock& block, const NeededGaps& needed, const float* gaps_at_begin,
                           const float* gaps_at_end) {
  const PlaneTag d;
  PairsOfBlock pairs = 0;
  for (std::size_t first = 0; first < kPlanesAtOnce; first += hn::Lanes(d)) {
    const auto turns_with_part = hn::Gt(hn::Load(d, block.turns_with_part.data() + first), hn::Zero(d));
    const auto enough = hn::IfThenElse(turns_with_part, hn::Set(d, needed.turning), hn::Set(d, needed.fixed));
    const auto at_begin = hn::LoadU(d, gaps_at_begin + first);
    const auto least = hn::Min(at_begin, hn::LoadU(d, gaps_at_end + first));
    // So that what is no number proves nothing.
    const auto is_proved = hn::Or(hn::Ge(least, enough), hn::Gt(at_begin, hn::Set(d, needed.far)));
    pairs |= bits_of(hn::Not(is_proved), first);
  }
  return pairs;
}

}  // namespace glissade::contact::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace glissade::contact {
namespace {

HWY_EXPORT(find_plane_gaps);
HWY_EXPORT(raise_gaps);
HWY_EXPORT(find_pairs_within);
HWY_EXPORT(find_unproved);

}  // namespace

void find_plane_gaps(std::span<const PlaneBlock> blocks, const PlaneMaps& maps, float* gaps) {
  HWY_DYNAMIC_DISPATCH(find_plane_gaps)(blocks, maps, gaps);
}
void raise_gaps(std::span<const float> known, float clock, float* gaps, float* least) {
  HWY_DYNAMIC_DISPATCH(raise_gaps)(known, clock, gaps, least);
}
PairsOfBlock find_pairs_within(float limit, const float* gaps) {
  return HWY_DYNAMIC_DISPATCH(find_pairs_within)(limit, gaps);
}
PairsOfBlock find_unproved(const PlaneBlock& block, const NeededGaps& needed, const float* gaps_at_begin,
                           const float* gaps_at_end) {
  return HWY_DYNAMIC_DISPATCH(find_unproved)(block, needed, gaps_at_begin, gaps_at_end);
}

}  // namespace glissade::contact
#endif
