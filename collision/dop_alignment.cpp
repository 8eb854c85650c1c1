// Compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "glissade/collision/dop_alignment.cpp"
#include "dop_alignment.h"

#include <cstring>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "alignment_table.h"

HWY_BEFORE_NAMESPACE();
namespace glissade::collision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr float kWeightUnit = 32768.0F;
constexpr float kLargestValue = 32767.0F;

// Every lane is a slab of the base.
using Tag = hn::CappedTag<float, kAlignmentLanes>;
using V = hn::Vec<Tag>;

// The correspondence of some slabs: where it is, and what it weighs.
struct alignas(64) Side {
  std::int32_t weight[3][kAlignmentLanes];
  std::int32_t offset[kAlignmentLanes];
};
struct alignas(64) Correspondence {
  std::int32_t vertex[kAlignmentLanes];  ///< 2 · vertex + mirrored
  Side above;
  Side below;
};

// The vertex of the generic DOP that is furthest along each direction or its opposite, as its number. The number is
// kept in the lowest bits of the reach, so that one maximum finds both; which of two nearly equal vertices wins is no
// matter.
HWY_INLINE hn::Vec<hn::RebindToSigned<Tag>> furthest_vertex(const AlignmentTable& table, const V (&direction)[3]) {
  const Tag d;
  const hn::RebindToSigned<Tag> d32;
  constexpr std::int32_t kNumberBits = 31;
  const auto reach_bits = hn::Set(d32, 0x7fffffff & ~kNumberBits);
  auto most = hn::Zero(d);
  for (int i = 0; i < table.vertex_count; ++i) {
    const auto& x = table.position[static_cast<std::size_t>(i)];
    const V reach = hn::MulAdd(direction[0], hn::Set(d, x[0]),
                               hn::MulAdd(direction[1], hn::Set(d, x[1]), hn::Mul(direction[2], hn::Set(d, x[2]))));
    const auto tagged = hn::Or(hn::And(hn::BitCast(d32, reach), reach_bits), hn::Set(d32, i));
    most = hn::Max(most, hn::BitCast(d, tagged));
  }
  return hn::And(hn::BitCast(d32, most), hn::Set(d32, kNumberBits));
}

HWY_INLINE void find_correspondence(const AlignmentTable& table, const QueryFrame& frame, std::size_t first,
                                    Correspondence& found) {
  const Tag d;
  const hn::RebindToSigned<Tag> d32;
  const auto component = [](double value) { return static_cast<float>(value); };
  V direction[3];  // of the slabs, seen from Q
  V slab[3];
  for (std::size_t axis = 0; axis < 3; ++axis)
    slab[axis] = hn::Load(d, table.direction[axis].data() + first);
  for (int axis = 0; axis < 3; ++axis) {
    direction[axis] = hn::MulAdd(slab[0], hn::Set(d, component(frame.R_PQ(0, axis))),
                                 hn::MulAdd(slab[1], hn::Set(d, component(frame.R_PQ(1, axis))),
                                            hn::Mul(slab[2], hn::Set(d, component(frame.R_PQ(2, axis))))));
  }
  const auto vertex = furthest_vertex(table, direction);

  V weight[3];
  for (std::size_t term = 0; term < 3; ++term) {
    const auto entry = [&](std::size_t axis)
                           HWY_ATTR { return hn::GatherIndex(d, table.weights[3 * term + axis].data(), vertex); };
    weight[term] =
        hn::MulAdd(direction[0], entry(0), hn::MulAdd(direction[1], entry(1), hn::Mul(direction[2], entry(2))));
  }
  // All weights of a mirrored vertex are of the other sign.
  const V sum = hn::Add(weight[0], hn::Add(weight[1], weight[2]));
  const auto mirrored = hn::And(hn::SignBit(d), sum);
  const V unit = hn::Set(d, kWeightUnit * component(frame.ratio));
  hn::Vec<decltype(d32)> weight_of[3];
  V residual = hn::Zero(d);  // what the rounded, non-negative weights leave of the direction, at most
  for (std::size_t term = 0; term < 3; ++term) {
    const V exact = hn::Mul(hn::Xor(weight[term], mirrored), unit);
    const V rounded = hn::Round(hn::Max(hn::Zero(d), hn::Min(exact, hn::Set(d, kLargestValue))));
    residual = hn::Add(residual, hn::Abs(hn::Sub(exact, rounded)));
    weight_of[term] = hn::ConvertTo(d32, rounded);
  }
  const auto mirrored_bit = hn::ShiftRight<31>(hn::BitCast(d32, mirrored));  // 0 or −1
  hn::Store(hn::Sub(hn::Add(vertex, vertex), mirrored_bit), d32, found.vertex + first);

  // Grid steps: the residual, over all of Q; half a step for rounding each of three products; what single precision did
  // to the weights (their matrices are of norm 3 at most) and to the centre; what double precision did before.
  const V padding = hn::MulAdd(residual, hn::Set(d, kGridRadius / kWeightUnit * 1.001F),
                               hn::Set(d, 1.5F + 0.25F + component(kGridRadius * frame.uncertainty * 1.001)));
  const auto coordinate = [&](int axis) HWY_ATTR { return hn::Set(d, component(kGridRadius * frame.p_PQ[axis])); };
  const V center =
      hn::MulAdd(slab[0], coordinate(0), hn::MulAdd(slab[1], coordinate(1), hn::Mul(slab[2], coordinate(2))));
  for (const bool is_above : {true, false}) {
    const V exact = hn::Ceil(is_above ? hn::Add(padding, center) : hn::Sub(padding, center));
    // An offset beyond 16 bits: on the far side it means that nothing is separated there, which no weight must change;
    // on the near side a smaller offset is safe.
    const auto is_far = hn::Gt(exact, hn::Set(d, kLargestValue));
    const V kept = hn::Max(hn::Min(exact, hn::Set(d, kLargestValue)), hn::Set(d, -kLargestValue));
    Side& side = is_above ? found.above : found.below;
    hn::Store(hn::ConvertTo(d32, kept), d32, side.offset + first);
    for (std::size_t term = 0; term < 3; ++term)
      hn::Store(hn::IfThenZeroElse(hn::RebindMask(d32, is_far), weight_of[term]), d32, side.weight[term] + first);
  }
}

// Four rows of eight lanes: of each of the four values, one lane for each child that it faces `below`, then `above`.
HWY_INLINE void spread(const std::int32_t* below, const std::int32_t* above, std::int16_t* lanes) {
  const hn::FixedTag<std::int32_t, 4> d32;
  const hn::FixedTag<std::int16_t, 4> d16;
  const hn::FixedTag<std::int16_t, 8> row;
  const hn::FixedTag<std::uint8_t, 16> d8;
  alignas(16) static constexpr std::uint8_t kFirstRow[16] = {0, 1, 0, 1, 0, 1, 0, 1, 8, 9, 8, 9, 8, 9, 8, 9};
  const auto values = hn::BitCast(
      d8, hn::Combine(row, hn::DemoteTo(d16, hn::Load(d32, above)), hn::DemoteTo(d16, hn::Load(d32, below))));
  auto place = hn::Load(d8, kFirstRow);
  for (std::size_t i = 0; i < 4; ++i) {
    hn::Store(hn::BitCast(row, hn::TableLookupBytes(values, place)), row, lanes + 8 * i);
    place = hn::Add(place, hn::Set(d8, 2));
  }
}

void align(const AlignmentTable& table, const QueryFrame& frame, DopAlignment& alignment) {
  Correspondence found;
  for (std::size_t first = 0; first < kAlignmentLanes; first += hn::Lanes(Tag()))
    find_correspondence(table, frame, first, found);

  alignment.slabs = table.slabs;
  const auto rows = static_cast<std::size_t>(4 * slab_lines(table.slabs));
  for (std::size_t first = 0; first < rows; first += 4) {
    for (std::size_t term = 0; term < 3; ++term)
      spread(found.below.weight[term] + first, found.above.weight[term] + first,
             alignment.weight[term].data() + 8 * first);
    spread(found.below.offset + first, found.above.offset + first, alignment.offset.data() + 8 * first);
  }
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
