// Compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/dop_alignment.cpp"
#include "kernels/dop_alignment.h"

#include <cstring>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "kernels/alignment_table.h"

HWY_BEFORE_NAMESPACE();
namespace glissade::collision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr float kWeightUnit = 32768.0F;
constexpr float kLargestValue = 32767.0F;

// Every lane is a slab of the base.
using Tag = hn::CappedTag<float, kAlignmentLanes>;
using V = hn::Vec<Tag>;

// The correspondence of some slabs: the source of their terms, and the weights.
struct alignas(64) Side {
  std::int32_t weight[3][kAlignmentLanes];
  std::int32_t offset[kAlignmentLanes];
};
struct alignas(64) Correspondence {
  std::int32_t vertex[kAlignmentLanes];  ///< 2 · vertex + mirrored
  Side above;
  Side below;
};

using Indices = hn::Vec<hn::RebindToSigned<Tag>>;

// For each direction, the number of the generic DOP's vertex with the greatest reach, that is, the greatest absolute
// value of its projection on the direction. The number of a vertex replaces the lowest bits of its reach, so that one
// maximum finds the greatest reach together with its number. Of two vertices with nearly equal reach, either may win:
// any choice of a vertex is safe (docs/collision.md).
HWY_INLINE Indices farthest_vertex(const AlignmentTable& table, const V (&direction)[3]) {
  const Tag d;
  const hn::RebindToSigned<Tag> d32;
  const auto number_bits = hn::Set(d32, kVertexEntries - 1);
  const auto reach_bits = hn::AndNot(number_bits, hn::Set(d32, 0x7fffffff));
  const auto reach = [&](std::size_t i) HWY_ATTR {
    const auto& x = table.position[i];
    const V exact = hn::Add(hn::Mul(direction[0], hn::Set(d, x[0])),
                            hn::Add(hn::Mul(direction[1], hn::Set(d, x[1])), hn::Mul(direction[2], hn::Set(d, x[2]))));
    return hn::BitCast(d, hn::OrAnd(hn::Set(d32, table.number[i]), hn::BitCast(d32, exact), reach_bits));
  };
  // Even and odd vertices separately, so that maxima do not wait for each other. The number of vertices is even.
  V most[2] = {hn::Zero(d), hn::Zero(d)};
  for (std::size_t i = 0; i < static_cast<std::size_t>(table.vertex_count); i += 2) {
    most[0] = hn::Max(most[0], reach(i));
    most[1] = hn::Max(most[1], reach(i + 1));
  }
  return hn::And(hn::BitCast(d32, hn::Max(most[0], most[1])), number_bits);
}

HWY_INLINE V look_up(const std::array<float, kVertexEntries>& entries, Indices vertex) {
#if HWY_TARGET == HWY_AVX3
  return V{_mm512_permutex2var_ps(_mm512_load_ps(entries.data()), vertex.raw, _mm512_load_ps(entries.data() + 16))};
#else
  return hn::GatherIndex(Tag(), entries.data(), vertex);
#endif
}

HWY_INLINE void find_correspondence(const AlignmentTable& table, const QueryFrame& frame, std::size_t first,
                                    Correspondence& found) {
  const Tag d;
  const hn::RebindToSigned<Tag> d32;
  const auto component = [](double value) { return static_cast<float>(value); };
  V direction[3];  // of the slabs, seen from N
  V slab[3];
  for (std::size_t axis = 0; axis < 3; ++axis)
    slab[axis] = hn::Load(d, table.direction[axis].data() + first);
  for (int axis = 0; axis < 3; ++axis) {
    direction[axis] = hn::Add(hn::Mul(slab[0], hn::Set(d, component(frame.R_MN(0, axis)))),
                              hn::Add(hn::Mul(slab[1], hn::Set(d, component(frame.R_MN(1, axis)))),
                                      hn::Mul(slab[2], hn::Set(d, component(frame.R_MN(2, axis))))));
  }
  const auto vertex = farthest_vertex(table, direction);

  V weight[3];
  for (std::size_t term = 0; term < 3; ++term) {
    const auto entry = [&](std::size_t axis) HWY_ATTR { return look_up(table.weights[3 * term + axis], vertex); };
    weight[term] = hn::Add(hn::Mul(direction[0], entry(0)),
                           hn::Add(hn::Mul(direction[1], entry(1)), hn::Mul(direction[2], entry(2))));
  }
  // For a mirrored vertex, all weights have the opposite sign.
  const V sum = hn::Add(weight[0], hn::Add(weight[1], weight[2]));
  const auto mirrored = hn::And(hn::SignBit(d), sum);
  const V unit = hn::Set(d, kWeightUnit * component(frame.ratio));
  hn::Vec<decltype(d32)> weight_of[3];
  V residual = hn::Zero(d);  // bound on the error of the direction after rounding weights to non-negative ones
  for (std::size_t term = 0; term < 3; ++term) {
    const V exact = hn::Mul(hn::Xor(weight[term], mirrored), unit);
    const V rounded = hn::Round(hn::Max(hn::Zero(d), hn::Min(exact, hn::Set(d, kLargestValue))));
    residual = hn::Add(residual, hn::Abs(hn::Sub(exact, rounded)));
    weight_of[term] = hn::ConvertTo(d32, rounded);
  }
  const auto mirrored_bit = hn::ShiftRight<31>(hn::BitCast(d32, mirrored));  // 0 or −1
  hn::Store(hn::Sub(hn::Add(vertex, vertex), mirrored_bit), d32, found.vertex + first);

  // In grid steps: the residual times the radius of N; half a step for the rounding of each of three products; a
  // quarter for single precision in the weights (their matrices have norm 3 at most) and in the centre; and the
  // uncertainty of double precision.
  const V padding = hn::Add(hn::Mul(residual, hn::Set(d, kGridRadius / kWeightUnit * 1.001F)),
                            hn::Set(d, 1.5F + 0.25F + component(kGridRadius * frame.uncertainty * 1.001)));
  const auto coordinate = [&](int axis) HWY_ATTR { return hn::Set(d, component(kGridRadius * frame.p_MN[axis])); };
  const V center = hn::Add(hn::Mul(slab[0], coordinate(0)),
                           hn::Add(hn::Mul(slab[1], coordinate(1)), hn::Mul(slab[2], coordinate(2))));
  for (const bool is_above : {true, false}) {
    const V exact = hn::Ceil(is_above ? hn::Add(padding, center) : hn::Sub(padding, center));
    // The exact offset may exceed 16 bits. Above 32767, the offset becomes 32767 and the weights become 0, so the sum
    // stays 32767 and this half-space separates nothing. Below -32767, the offset is raised to -32767, which only makes
    // the box larger.
    const auto is_far = hn::Gt(exact, hn::Set(d, kLargestValue));
    const V kept = hn::Max(hn::Min(exact, hn::Set(d, kLargestValue)), hn::Set(d, -kLargestValue));
    Side& side = is_above ? found.above : found.below;
    hn::Store(hn::ConvertTo(d32, kept), d32, side.offset + first);
    for (std::size_t term = 0; term < 3; ++term)
      hn::Store(hn::IfThenZeroElse(hn::RebindMask(d32, is_far), weight_of[term]), d32, side.weight[term] + first);
  }
}

// Eight lanes for each of four or more values: for each child the value that faces `below`, then the value that faces
// `above`.
#if HWY_TARGET == HWY_AVX3

HWY_INLINE void spread(const std::int32_t* below, const std::int32_t* above, std::size_t rows, std::int16_t* lanes) {
  alignas(64) static constexpr std::int16_t kFirstRows[32] = {0, 0, 0, 0, 16, 16, 16, 16, 1, 1, 1, 1, 17, 17, 17, 17,
                                                              2, 2, 2, 2, 18, 18, 18, 18, 3, 3, 3, 3, 19, 19, 19, 19};
  const __m512i values = _mm512_inserti64x4(_mm512_castsi256_si512(_mm512_cvtepi32_epi16(_mm512_load_si512(below))),
                                            _mm512_cvtepi32_epi16(_mm512_load_si512(above)), 1);
  __m512i place = _mm512_load_si512(kFirstRows);
  for (std::size_t first = 0; first < rows; first += 4) {
    _mm512_store_si512(lanes + 8 * first, _mm512_permutexvar_epi16(place, values));
    place = _mm512_add_epi16(place, _mm512_set1_epi16(4));
  }
}

#else

HWY_INLINE void spread(const std::int32_t* below, const std::int32_t* above, std::size_t rows, std::int16_t* lanes) {
  const hn::FixedTag<std::int32_t, 4> d32;
  const hn::FixedTag<std::int16_t, 4> d16;
  const hn::FixedTag<std::int16_t, 8> row;
  const hn::FixedTag<std::uint8_t, 16> d8;
  alignas(16) static constexpr std::uint8_t kFirstRow[16] = {0, 1, 0, 1, 0, 1, 0, 1, 8, 9, 8, 9, 8, 9, 8, 9};
  for (std::size_t first = 0; first < rows; first += 4) {
    const auto values = hn::BitCast(d8, hn::Combine(row, hn::DemoteTo(d16, hn::Load(d32, above + first)),
                                                    hn::DemoteTo(d16, hn::Load(d32, below + first))));
    auto place = hn::Load(d8, kFirstRow);
    for (std::size_t i = 0; i < 4; ++i) {
      hn::Store(hn::BitCast(row, hn::TableLookupBytes(values, place)), row, lanes + 8 * (first + i));
      place = hn::Add(place, hn::Set(d8, 2));
    }
  }
}

#endif

void align(const AlignmentTable& table, const QueryFrame& frame, DopAlignment& alignment) {
  Correspondence found;
  for (std::size_t first = 0; first < kAlignmentLanes; first += hn::Lanes(Tag()))
    find_correspondence(table, frame, first, found);

  alignment.slabs = table.slabs;
  const auto rows = static_cast<std::size_t>(4 * slab_lines(table.slabs));
  for (std::size_t term = 0; term < 3; ++term)
    spread(found.below.weight[term], found.above.weight[term], rows, alignment.weight[term].data());
  spread(found.below.offset, found.above.offset, rows, alignment.offset.data());
  for (std::size_t i = 0; i < rows; ++i) {
    const auto& source = table.source[static_cast<std::size_t>(found.vertex[i])];
    for (std::size_t term = 0; term < 3; ++term)
      std::memcpy(&alignment.source[term][2 * i], &source[2 * term], 2 * sizeof(QuarterLine));
  }
  const hn::FixedTag<std::int16_t, 8> row;
  // Rows beyond the last slab separate nothing.
  for (auto i = static_cast<std::size_t>(table.slabs); i < rows; ++i)
    hn::Store(hn::Set(row, std::int16_t{32767}), row, alignment.offset.data() + 8 * i);
}

}  // namespace glissade::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace glissade::collision {
namespace {

HWY_EXPORT(align);

}  // namespace

void align(int k, const QueryFrame& frame, DopAlignment& alignment) {
  HWY_DYNAMIC_DISPATCH(align)(alignment_table(k), frame, alignment);
}

}  // namespace glissade::collision
#endif
