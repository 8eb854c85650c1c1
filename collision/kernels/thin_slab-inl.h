// The test of thin slabs (thin_slab.h), four children against four. Compiled once for each instruction set.
#if defined(GLISSADE_COLLISION_THIN_SLAB_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GLISSADE_COLLISION_THIN_SLAB_INL_H_
#undef GLISSADE_COLLISION_THIN_SLAB_INL_H_
#else
#define GLISSADE_COLLISION_THIN_SLAB_INL_H_
#endif

#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>

#include "kernels/child_pairs.h"
#include "kernels/pair_lanes-inl.h"
#include "kernels/thin_slab.h"
#include "tree/dop_node.h"

HWY_BEFORE_NAMESPACE();
namespace glissade::collision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Thin slabs of some children, in grid steps of their own tree or of M.
template <class V>
struct ThinLanes {
  V normal[3];
  V center[3];
  V offset;
  V half_width;
  V radius;
};

template <class D, class V>
HWY_INLINE V rotated(D d, const ThinSlabFrame& frame, const V (&v)[3], std::size_t row) {
  return hn::Add(hn::Mul(hn::Set(d, frame.R_MN[row][0]), v[0]),
                 hn::Add(hn::Mul(hn::Set(d, frame.R_MN[row][1]), v[1]), hn::Mul(hn::Set(d, frame.R_MN[row][2]), v[2])));
}

template <class D, class V>
HWY_INLINE ThinLanes<V> moved_to_base(D d, const ThinSlabFrame& frame, const ThinLanes<V>& q) {
  const V ratio = hn::Set(d, frame.ratio);
  ThinLanes<V> moved;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    moved.normal[axis] = rotated(d, frame, q.normal, axis);
    moved.center[axis] = hn::Add(hn::Mul(ratio, rotated(d, frame, q.center, axis)), hn::Set(d, frame.p_MN[axis]));
  }
  moved.offset = hn::Mul(ratio, q.offset);
  moved.half_width = hn::Mul(ratio, q.half_width);
  moved.radius = hn::Mul(ratio, q.radius);
  return moved;
}

template <class D>
HWY_INLINE hn::Vec<D> to_float(D d, hn::Vec<hn::Rebind<std::int16_t, D>> values) {
  return hn::ConvertTo(d, hn::PromoteTo(hn::RebindToSigned<D>(), values));
}

// For each pair, the lesser of its overlaps along the normals of the two slabs.
template <class D, class V>
HWY_INLINE V thin_overlap(D d, const ThinLanes<V>& p, const ThinLanes<V>& q) {
  const auto dot = [](const V(&u)[3], const V(&v)[3]) HWY_ATTR {
    return hn::Add(hn::Mul(u[0], v[0]), hn::Add(hn::Mul(u[1], v[1]), hn::Mul(u[2], v[2])));
  };
  const V cosine = dot(p.normal, q.normal);
  // The chord between the normals, one of them reversed if they point to opposite sides, bounds the sine. Its error is
  // that of the lengths of the normals.
  V between[3];
  V chord[3];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    between[axis] = hn::Sub(q.center[axis], p.center[axis]);
    const V turned = hn::Xor(q.normal[axis], hn::And(hn::SignBit(d), cosine));
    chord[axis] = hn::Sub(p.normal[axis], turned);
  }
  const V sine = hn::Add(hn::Sqrt(dot(chord, chord)), hn::Set(d, 3e-4F));
  const V abs_cosine = hn::Abs(cosine);

  const V apart_M = hn::Abs(hn::Add(hn::Mul(q.offset, cosine), hn::Sub(dot(p.normal, between), p.offset)));
  const V reach_M = hn::Add(hn::Mul(q.half_width, abs_cosine), hn::Add(hn::Mul(q.radius, sine), p.half_width));
  const V apart_N = hn::Abs(hn::Sub(hn::Add(dot(q.normal, between), q.offset), hn::Mul(p.offset, cosine)));
  const V reach_N = hn::Add(hn::Mul(p.half_width, abs_cosine), hn::Add(hn::Mul(p.radius, sine), q.half_width));
  return hn::Min(hn::Sub(reach_M, apart_M), hn::Sub(reach_N, apart_N));
}

// Added before rounding to the nearest integer, so that the result is not less than the exact value: a half, and more
// than single precision loses.
constexpr float kRoundUp = 0.51F;

// Lowers the overlaps from pair `first` on. Returns the pairs that still overlap by at least `least_overlap`.
template <class D, class V>
HWY_INLINE PairMask lower_overlaps(D d, const ThinSlabFrame& frame, const ThinLanes<V>& p, const ThinLanes<V>& q,
                                   int least_overlap, std::size_t first, PairOverlaps& overlaps) {
  const hn::Rebind<std::int16_t, D> d16;
  std::int16_t* const lanes = overlaps.overlap.data() + first;
  const V overlap = hn::Add(thin_overlap(d, p, q), hn::Set(d, frame.padding + kRoundUp));
  const auto least = hn::Min(hn::DemoteTo(d16, hn::NearestInt(overlap)), hn::Load(d16, lanes));
  hn::Store(least, d16, lanes);
  return bits_of(d16, hn::Gt(least, hn::Set(d16, static_cast<std::int16_t>(least_overlap - 1)))) << first;
}

constexpr float kNormalStep = 1.0F / 32767.0F;

// For registers of 16 lanes: the data of a node fit into three registers, from which each pair takes the values of its
// child.
template <class D>
HWY_INLINE ThinLanes<hn::Vec<D>> thin_of_pairs(D d, const NodeHead& head, const SlabLine* node,
                                               const std::int32_t (&child_of_pair)[kPairs]) {
  using V = hn::Vec<D>;
  const hn::Rebind<std::int16_t, D> d16;
  const hn::Half<decltype(d16)> half;
  alignas(64) static constexpr float kUnits[kPairs] = {
      kNormalStep, kNormalStep, kNormalStep, kNormalStep, kNormalStep, kNormalStep, kNormalStep, kNormalStep,
      kNormalStep, kNormalStep, kNormalStep, kNormalStep, 1.0F,        1.0F,        1.0F,        1.0F};
  alignas(64) static constexpr std::int32_t kBelow[kPairs] = {4, 5, 6, 7, 4, 5, 6, 7, 12, 13, 14, 15, 12, 13, 14, 15};
  const auto middle = [&](V above_and_below) HWY_ATTR {
    const V below = hn::TableLookupLanes(above_and_below, hn::SetTableIndices(d, kBelow));
    return hn::Mul(hn::Sub(above_and_below, below), hn::Set(d, 0.5F));
  };
  const V normals_and_offset = hn::Mul(to_float(d, hn::Load(d16, head.normal[0].data())), hn::Load(d, kUnits));
  const V centers_xy = middle(to_float(d, hn::Load(d16, node->rows[0].above.data())));
  const V bounds_z_and_sizes =
      to_float(d, hn::Combine(d16, hn::Load(half, head.half_width.data()), hn::Load(half, node->rows[2].above.data())));
  const V center_z = middle(bounds_z_and_sizes);

  const hn::RebindToSigned<D> d32;
  const auto child = hn::Load(d32, child_of_pair);
  const auto spread = [&](V values, std::int32_t quarter) HWY_ATTR {
    return hn::TableLookupLanes(values, hn::IndicesFromVec(d, hn::Add(child, hn::Set(d32, 4 * quarter))));
  };
  return {{spread(normals_and_offset, 0), spread(normals_and_offset, 1), spread(normals_and_offset, 2)},
          {spread(centers_xy, 0), spread(centers_xy, 2), spread(center_z, 0)},
          spread(normals_and_offset, 3),
          spread(bounds_z_and_sizes, 2),
          spread(bounds_z_and_sizes, 3)};
}

// For shorter registers: a lane for each child.
using Four = hn::Vec<hn::FixedTag<float, kWidth>>;
HWY_INLINE ThinLanes<Four> thin_of_children(const NodeHead& head, const SlabLine* node) {
  const hn::FixedTag<float, kWidth> d;
  const hn::FixedTag<std::int16_t, kWidth> d16;
  const auto floats = [&](const FourValues& values) HWY_ATTR { return to_float(d, hn::Load(d16, values.data())); };
  const auto unit = [&](const FourValues& v) HWY_ATTR { return hn::Mul(floats(v), hn::Set(d, kNormalStep)); };
  const auto middle = [&](const SlabRow& row)
                          HWY_ATTR { return hn::Mul(hn::Sub(floats(row.above), floats(row.below)), hn::Set(d, 0.5F)); };
  return {{unit(head.normal[0]), unit(head.normal[1]), unit(head.normal[2])},
          {middle(node->rows[0]), middle(node->rows[1]), middle(node->rows[2])},
          floats(head.offset),
          floats(head.half_width),
          floats(head.radius)};
}

// Expands all nine values from a lane for each child to a lane for each pair, by change(array of four).
template <class V, class Change>
HWY_INLINE ThinLanes<V> spread_to_pairs(const ThinLanes<Four>& children, const Change& change) {
  const auto spread = [&](Four values) HWY_ATTR {
    alignas(16) float four[kWidth];
    hn::Store(values, hn::FixedTag<float, kWidth>(), four);
    return change(four);
  };
  const auto& [normal, center, offset, half_width, radius] = children;
  return {{spread(normal[0]), spread(normal[1]), spread(normal[2])},
          {spread(center[0]), spread(center[1]), spread(center[2])},
          spread(offset),
          spread(half_width),
          spread(radius)};
}

template <class D>
HWY_INLINE PairMask test_thin_in(D d, const ThinSlabFrame& frame, const NodeHead& head_M, const SlabLine* node_M,
                                 const NodeHead& head_N, const SlabLine* node_N, int least_overlap,
                                 PairOverlaps& overlaps) {
  if constexpr (hn::MaxLanes(D()) == kPairs) {
    alignas(64) static constexpr std::int32_t kOfP[kPairs] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
    alignas(64) static constexpr std::int32_t kOfQ[kPairs] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
    const auto p = thin_of_pairs(d, head_M, node_M, kOfP);
    const auto q = moved_to_base(d, frame, thin_of_pairs(d, head_N, node_N, kOfQ));
    return lower_overlaps(d, frame, p, q, least_overlap, 0, overlaps);
  } else {
    const hn::FixedTag<float, kWidth> d4;
    const ThinLanes<Four> p = thin_of_children(head_M, node_M);
    using V = hn::Vec<D>;
    const auto q = spread_to_pairs<V>(moved_to_base(d4, frame, thin_of_children(head_N, node_N)),
                                      [&](const float* four) HWY_ATTR { return of_N(d, four); });
    PairMask mask = 0;
    for (std::size_t first = 0; first < kPairs; first += hn::Lanes(d)) {
      const auto of_pairs = spread_to_pairs<V>(p, [&](const float* four) HWY_ATTR { return of_M(d, four, first); });
      mask |= lower_overlaps(d, frame, of_pairs, q, least_overlap, first, overlaps);
    }
    return mask;
  }
}

PairMask test_thin(const ThinSlabFrame& frame, const NodeHead& head_M, const SlabLine* node_M, const NodeHead& head_N,
                   const SlabLine* node_N, int least_overlap, PairOverlaps& overlaps) {
  const hn::CappedTag<float, kPairs> d;
  return test_thin_in(d, frame, head_M, node_M, head_N, node_N, least_overlap, overlaps);
}

}  // namespace glissade::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
