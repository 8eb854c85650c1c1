// Compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/node_kernels.cpp"
#include "kernels/node_kernels.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "kernels/pair_lanes-inl.h"
#include "kernels/thin_slab-inl.h"

HWY_BEFORE_NAMESPACE();
namespace glissade::collision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE const std::int16_t* lanes(const SlabLine* node) {
  return node->rows[0].above.data();
}

#if HWY_TARGET == HWY_AVX3

// A node of 12 slabs fills three registers of 32 lanes. Realignment permutes quarter lines of them.
template <int kRegisters>
HWY_INLINE __m512i permute_quarters(const __m512i (&node)[kRegisters], const QuarterLine* source) {
  const __m512i index = _mm512_load_si512(source);
  if constexpr (kRegisters == 1) return _mm512_permutexvar_epi64(index, node[0]);
  if constexpr (kRegisters >= 2) {
    const __m512i low = _mm512_permutex2var_epi64(node[0], index, node[1]);
    if constexpr (kRegisters == 2) return low;
    const __mmask8 from_high = _mm512_movepi64_mask(index);
    if constexpr (kRegisters == 3) return _mm512_mask_permutexvar_epi64(low, from_high, index, node[2]);
    if constexpr (kRegisters == 4) {
      return _mm512_mask_blend_epi64(from_high, low, _mm512_permutex2var_epi64(node[2], index, node[3]));
    }
  }
}

template <int kRegisters>
HWY_INLINE void realign_lines(const DopAlignment& alignment, const SlabLine* node_N, __m512i (&facing)[kRegisters]) {
  __m512i node[kRegisters];
  for (int r = 0; r < kRegisters; ++r)
    node[r] = _mm512_load_si512(node_N + r);
  for (int r = 0; r < kRegisters; ++r) {
    const auto product = [&](std::size_t l) HWY_ATTR {
      return _mm512_mulhrs_epi16(permute_quarters<kRegisters>(node, alignment.source[l].data() + 8 * r),
                                 _mm512_load_si512(alignment.weight[l].data() + 32 * r));
    };
    const __m512i sum = _mm512_add_epi16(_mm512_add_epi16(product(0), product(1)), product(2));
    facing[r] = _mm512_adds_epi16(sum, _mm512_load_si512(alignment.offset.data() + 32 * r));
  }
}

template <int kRegisters>
void realign_to(const DopAlignment& alignment, const SlabLine* node_N, AlignedNode& aligned) {
  __m512i facing[kRegisters];
  realign_lines<kRegisters>(alignment, node_N, facing);
  for (int r = 0; r < kRegisters; ++r)
    _mm512_store_si512(aligned.facing.data() + 32 * r, facing[r]);
}

void realign(const DopAlignment& alignment, const SlabLine* node_N, AlignedNode& aligned) {
  switch (slab_lines(alignment.slabs)) {
    case 1:
      return realign_to<1>(alignment, node_N, aligned);
    case 2:
      return realign_to<2>(alignment, node_N, aligned);
    case 3:
      return realign_to<3>(alignment, node_N, aligned);
    default:
      return realign_to<4>(alignment, node_N, aligned);
  }
}

// Rotating the four children of each quarter by 0 to 3 places brings every pair together.
template <int kRegisters, int kTurn>
HWY_INLINE __m512i least_overlaps(const __m512i* node_M, const __m512i* facing) {
  __m512i least = _mm512_adds_epi16(node_M[0], _mm512_ror_epi64(facing[0], 16 * kTurn));
  for (int r = 1; r < kRegisters; ++r)
    least = _mm512_min_epi16(least, _mm512_adds_epi16(node_M[r], _mm512_ror_epi64(facing[r], 16 * kTurn)));
  return least;
}

template <int kRegisters>
HWY_INLINE PairMask compare(const SlabLine* node_M, const __m512i (&q)[kRegisters], int least_overlap,
                            PairOverlaps& overlaps) {
  __m512i p[kRegisters];
  for (int r = 0; r < kRegisters; ++r)
    p[r] = _mm512_load_si512(node_M + r);
  const __m512i turn0 = least_overlaps<kRegisters, 0>(p, q);
  const __m512i turn1 = least_overlaps<kRegisters, 1>(p, q);
  const __m512i turn2 = least_overlaps<kRegisters, 2>(p, q);
  const __m512i turn3 = least_overlaps<kRegisters, 3>(p, q);
  // The eight quarters of each rotation are reduced to four, two, one.
  const __m512i turns01 =
      _mm512_min_epi16(_mm512_shuffle_i64x2(turn0, turn1, 0x44), _mm512_shuffle_i64x2(turn0, turn1, 0xee));
  const __m512i turns23 =
      _mm512_min_epi16(_mm512_shuffle_i64x2(turn2, turn3, 0x44), _mm512_shuffle_i64x2(turn2, turn3, 0xee));
  const __m512i two =
      _mm512_min_epi16(_mm512_shuffle_i64x2(turns01, turns23, 0x88), _mm512_shuffle_i64x2(turns01, turns23, 0xdd));
  const __m512i one = _mm512_min_epi16(two, _mm512_shuffle_epi32(two, _MM_PERM_BADC));
  // Pair (p, q) is lane p of the rotation by q − p.
  alignas(32) static constexpr std::int16_t kLaneOfPair[kPairs] = {0,  8,  16, 24, 25, 1,  9,  17,
                                                                   18, 26, 2,  10, 11, 19, 27, 3};
  const __m256i index = _mm256_load_si256(reinterpret_cast<const __m256i*>(kLaneOfPair));
  const __m256i overlap = _mm512_castsi512_si256(_mm512_permutexvar_epi16(_mm512_castsi256_si512(index), one));
  _mm256_store_si256(reinterpret_cast<__m256i*>(overlaps.overlap.data()), overlap);
  return _mm256_cmpge_epi16_mask(overlap, _mm256_set1_epi16(static_cast<std::int16_t>(least_overlap)));
}

template <int kRegisters>
PairMask test_lines(const SlabLine* node_M, const AlignedNode& aligned, int least_overlap, PairOverlaps& overlaps) {
  __m512i facing[kRegisters];
  for (int r = 0; r < kRegisters; ++r)
    facing[r] = _mm512_load_si512(aligned.facing.data() + 32 * r);
  return compare<kRegisters>(node_M, facing, least_overlap, overlaps);
}

PairMask test(const SlabLine* node_M, const AlignedNode& aligned, int slabs, int least_overlap,
              PairOverlaps& overlaps) {
  switch (slab_lines(slabs)) {
    case 1:
      return test_lines<1>(node_M, aligned, least_overlap, overlaps);
    case 2:
      return test_lines<2>(node_M, aligned, least_overlap, overlaps);
    case 3:
      return test_lines<3>(node_M, aligned, least_overlap, overlaps);
    default:
      return test_lines<4>(node_M, aligned, least_overlap, overlaps);
  }
}

template <int kRegisters>
PairMask both(const DopAlignment& alignment, const SlabLine* node_M, const SlabLine* node_N, int least_overlap,
              PairOverlaps& overlaps) {
  __m512i facing[kRegisters];
  realign_lines<kRegisters>(alignment, node_N, facing);
  return compare<kRegisters>(node_M, facing, least_overlap, overlaps);
}

PairMask realign_and_test(const DopAlignment& alignment, const SlabLine* node_M, const SlabLine* node_N,
                          int least_overlap, PairOverlaps& overlaps) {
  switch (slab_lines(alignment.slabs)) {
    case 1:
      return both<1>(alignment, node_M, node_N, least_overlap, overlaps);
    case 2:
      return both<2>(alignment, node_M, node_N, least_overlap, overlaps);
    case 3:
      return both<3>(alignment, node_M, node_N, least_overlap, overlaps);
    default:
      return both<4>(alignment, node_M, node_N, least_overlap, overlaps);
  }
}

#else

void realign(const DopAlignment& alignment, const SlabLine* node_N, AlignedNode& aligned) {
  const hn::FixedTag<std::int16_t, 8> d;
  const hn::FixedTag<std::uint8_t, 16> d8;
  // A term whose source is `above` exchanges the places of `above` and `below`.
  alignas(16) static constexpr std::uint8_t kPlaces[2][16] = {{8, 9, 10, 11, 12, 13, 14, 15, 0, 1, 2, 3, 4, 5, 6, 7},
                                                              {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15}};
  for (std::size_t i = 0; i < static_cast<std::size_t>(alignment.slabs); ++i) {
    const auto product = [&](std::size_t l) HWY_ATTR {
      const std::size_t quarter = number_of(alignment.source[l][2 * i + 1]);
      const auto row = hn::Load(d, lanes(node_N) + 8 * (quarter / 2));
      const auto placed =
          hn::BitCast(d, hn::TableLookupBytes(hn::BitCast(d8, row), hn::Load(d8, kPlaces[quarter % 2])));
      return hn::MulFixedPoint15(placed, hn::Load(d, alignment.weight[l].data() + 8 * i));
    };
    const auto sum = hn::Add(hn::Add(product(0), product(1)), product(2));
    hn::Store(hn::SaturatedAdd(sum, hn::Load(d, alignment.offset.data() + 8 * i)), d, aligned.facing.data() + 8 * i);
  }
}

PairMask test(const SlabLine* node_M, const AlignedNode& aligned, int slabs, int least_overlap,
              PairOverlaps& overlaps) {
  const hn::CappedTag<std::int16_t, kPairs> d;
  const hn::Repartition<std::uint8_t, decltype(d)> d8;
  const hn::Repartition<std::uint64_t, decltype(d)> d64;
  // Bytes of `above` of each child of M, four times. Bytes of `below` are eight places farther on.
  alignas(32) static constexpr std::uint8_t kChildOfP[2 * kPairs] = {0, 1, 0, 1, 0, 1, 0, 1, 2, 3, 2, 3, 2, 3, 2, 3,
                                                                     4, 5, 4, 5, 4, 5, 4, 5, 6, 7, 6, 7, 6, 7, 6, 7};
  PairMask mask = 0;
  for (std::size_t first = 0; first < kPairs; first += hn::Lanes(d)) {
    const auto above = hn::Load(d8, kChildOfP + 2 * first);
    const auto below = hn::Add(above, hn::Set(d8, 8));
    auto least = hn::Set(d, std::int16_t{32767});
    for (std::size_t i = 0; i < static_cast<std::size_t>(slabs); ++i) {
      const auto row_M = hn::BitCast(d8, hn::LoadDup128(d, lanes(node_M) + 8 * i));
      std::uint64_t facing[2];
      std::memcpy(facing, aligned.facing.data() + 8 * i, sizeof facing);
      const auto over =
          hn::SaturatedAdd(hn::BitCast(d, hn::TableLookupBytes(row_M, above)), hn::BitCast(d, hn::Set(d64, facing[0])));
      const auto under =
          hn::SaturatedAdd(hn::BitCast(d, hn::TableLookupBytes(row_M, below)), hn::BitCast(d, hn::Set(d64, facing[1])));
      least = hn::Min(least, hn::Min(over, under));
    }
    hn::Store(least, d, overlaps.overlap.data() + first);
    const auto kept = hn::Gt(least, hn::Set(d, static_cast<std::int16_t>(least_overlap - 1)));
    mask |= bits_of(d, kept) << first;
  }
  return mask;
}

PairMask realign_and_test(const DopAlignment& alignment, const SlabLine* node_M, const SlabLine* node_N,
                          int least_overlap, PairOverlaps& overlaps) {
  AlignedNode aligned;
  realign(alignment, node_N, aligned);
  return test(node_M, aligned, alignment.slabs, least_overlap, overlaps);
}

#endif

// The greatest value_of(tag, overlaps, first pair) of the pairs in the mask, which must not be 0.
template <class Value>
HWY_INLINE int greatest(const PairOverlaps& overlaps, PairMask pairs, const Value& value_of) {
  alignas(32) static constexpr std::int16_t kBit[kPairs] = {1,   2,   4,    8,    16,   32,   64,    128,
                                                            256, 512, 1024, 2048, 4096, 8192, 16384, -32768};
  const hn::CappedTag<std::int16_t, kPairs> d;
  const auto in_mask = hn::Set(d, static_cast<std::int16_t>(pairs));
  auto most = hn::Set(d, std::int16_t{-32768});
  for (std::size_t first = 0; first < kPairs; first += hn::Lanes(d)) {
    const auto asked = hn::TestBit(in_mask, hn::Load(d, kBit + first));
    const auto value = value_of(d, hn::Load(d, overlaps.overlap.data() + first), first);
    most = hn::Max(most, hn::IfThenElse(asked, value, most));
  }
  return hn::GetLane(hn::MaxOfLanes(d, most));
}

int most_overlap(const PairOverlaps& overlaps, PairMask pairs) {
  return greatest(overlaps, pairs, [](auto, auto overlap, std::size_t) HWY_ATTR { return overlap; });
}

// The number of a pair replaces the lowest bits of its overlap, so that one maximum finds both.
int deepest(const PairOverlaps& overlaps, PairMask pairs) {
  alignas(32) static constexpr std::int16_t kNumber[kPairs] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  const auto tagged = [](auto d, auto overlap, std::size_t first) HWY_ATTR {
    return hn::Or(hn::And(overlap, hn::Set(d, std::int16_t{~15})), hn::Load(d, kNumber + first));
  };
  return greatest(overlaps, pairs, tagged) & 15;
}

const NodeKernels& node_kernels_of_target() {
  static constexpr NodeKernels kKernels = {realign, test, realign_and_test, test_thin, most_overlap, deepest};
  return kKernels;
}

}  // namespace glissade::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace glissade::collision {

namespace {

HWY_EXPORT(node_kernels_of_target);

}  // namespace

const NodeKernels& node_kernels() {
  return HWY_DYNAMIC_DISPATCH(node_kernels_of_target)();
}

}  // namespace glissade::collision
#endif
