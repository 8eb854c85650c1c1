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

#include "node_kernels.h"
#include "pair_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace glissade::collision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Four lanes of one node's thin slabs, in grid steps of P and its frame.
struct ThinChildren {
  alignas(16) float normal[3][kWidth];
  alignas(16) float center[3][kWidth];
  alignas(16) float offset[kWidth];
  alignas(16) float half_width[kWidth];
  alignas(16) float radius[kWidth];
};

template <class D4>
HWY_INLINE hn::Vec<D4> to_float(D4 d, const FourValues& values) {
  const hn::FixedTag<std::int16_t, kWidth> d16;
  return hn::ConvertTo(d, hn::PromoteTo(hn::RebindToSigned<D4>(), hn::Load(d16, values.data())));
}

HWY_INLINE void load_thin(const NodeHead& head, const SlabLine* node, ThinChildren& children) {
  const hn::FixedTag<float, kWidth> d;
  const auto half = hn::Set(d, 0.5F);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    hn::Store(hn::Mul(to_float(d, head.normal[axis]), hn::Set(d, 1.0F / 32767.0F)), d, children.normal[axis]);
    const SlabRow& row = node->rows[axis];
    hn::Store(hn::Mul(half, hn::Sub(to_float(d, row.above), to_float(d, row.below))), d, children.center[axis]);
  }
  hn::Store(to_float(d, head.offset), d, children.offset);
  hn::Store(to_float(d, head.half_width), d, children.half_width);
  hn::Store(to_float(d, head.radius), d, children.radius);
}

HWY_INLINE void move_to_base(const ThinSlabFrame& frame, ThinChildren& children) {
  const hn::FixedTag<float, kWidth> d;
  const auto rotated = [&](const float(&v)[3][kWidth], std::size_t row) HWY_ATTR {
    return hn::MulAdd(hn::Set(d, frame.R_PQ[row][0]), hn::Load(d, v[0]),
                      hn::MulAdd(hn::Set(d, frame.R_PQ[row][1]), hn::Load(d, v[1]),
                                 hn::Mul(hn::Set(d, frame.R_PQ[row][2]), hn::Load(d, v[2]))));
  };
  const auto ratio = hn::Set(d, frame.ratio);
  hn::Vec<decltype(d)> normal[3] = {rotated(children.normal, 0), rotated(children.normal, 1),
                                    rotated(children.normal, 2)};
  hn::Vec<decltype(d)> center[3] = {rotated(children.center, 0), rotated(children.center, 1),
                                    rotated(children.center, 2)};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    hn::Store(normal[axis], d, children.normal[axis]);
    hn::Store(hn::MulAdd(ratio, center[axis], hn::Set(d, frame.p_PQ[axis])), d, children.center[axis]);
  }
  hn::Store(hn::Mul(ratio, hn::Load(d, children.offset)), d, children.offset);
  hn::Store(hn::Mul(ratio, hn::Load(d, children.half_width)), d, children.half_width);
  hn::Store(hn::Mul(ratio, hn::Load(d, children.radius)), d, children.radius);
}

// How far pairs overlap along the thinner of their two slabs, from pair `first` on.
template <class D>
HWY_INLINE hn::Vec<D> thin_overlap(D d, const ThinChildren& p, const ThinChildren& q, std::size_t first) {
  using V = hn::Vec<D>;
  V n_P[3];
  V n_Q[3];
  V between[3];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    n_P[axis] = of_P(d, p.normal[axis], first);
    n_Q[axis] = of_Q(d, q.normal[axis]);
    between[axis] = hn::Sub(of_Q(d, q.center[axis]), of_P(d, p.center[axis], first));
  }
  const auto dot = [](const V(&u)[3], const V(&v)[3])
                       HWY_ATTR { return hn::MulAdd(u[0], v[0], hn::MulAdd(u[1], v[1], hn::Mul(u[2], v[2]))); };
  const V cosine = dot(n_P, n_Q);
  // The chord between the normals, turned to the same side, bounds the sine; its error is that of the normals' length.
  V chord[3];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const V turned = hn::Xor(n_Q[axis], hn::And(hn::SignBit(d), cosine));
    chord[axis] = hn::Sub(n_P[axis], turned);
  }
  const V sine = hn::Add(hn::Sqrt(dot(chord, chord)), hn::Set(d, 3e-4F));
  const V abs_cosine = hn::Abs(cosine);

  const V offset_P = of_P(d, p.offset, first);
  const V offset_Q = of_Q(d, q.offset);
  const V half_P = of_P(d, p.half_width, first);
  const V half_Q = of_Q(d, q.half_width);
  const V apart_P = hn::Abs(hn::MulAdd(offset_Q, cosine, hn::Sub(dot(n_P, between), offset_P)));
  const V reach_P = hn::MulAdd(half_Q, abs_cosine, hn::MulAdd(of_Q(d, q.radius), sine, half_P));
  const V apart_Q = hn::Abs(hn::NegMulAdd(offset_P, cosine, hn::Add(dot(n_Q, between), offset_Q)));
  const V reach_Q = hn::MulAdd(half_P, abs_cosine, hn::MulAdd(of_P(d, p.radius, first), sine, half_Q));
  return hn::Min(hn::Sub(reach_P, apart_P), hn::Sub(reach_Q, apart_Q));
}

PairMask test_thin(const ThinSlabFrame& frame, const NodeHead& head_P, const SlabLine* node_P, const NodeHead& head_Q,
                   const SlabLine* node_Q, int least_overlap, PairOverlaps& overlaps) {
  ThinChildren p;
  ThinChildren q;
  load_thin(head_P, node_P, p);
  load_thin(head_Q, node_Q, q);
  move_to_base(frame, q);

  const hn::CappedTag<float, kPairs> d;
  const hn::Rebind<std::int16_t, decltype(d)> d16;
  const hn::RebindToSigned<decltype(d)> d32;
  PairMask mask = 0;
  for (std::size_t first = 0; first < kPairs; first += hn::Lanes(d)) {
    const auto overlap = hn::Add(thin_overlap(d, p, q, first), hn::Set(d, frame.padding));
    const auto whole = hn::DemoteTo(d16, hn::ConvertTo(d32, hn::Ceil(overlap)));
    const auto least = hn::Min(whole, hn::Load(d16, overlaps.overlap.data() + first));
    hn::Store(least, d16, overlaps.overlap.data() + first);
    const auto kept = hn::Gt(least, hn::Set(d16, static_cast<std::int16_t>(least_overlap - 1)));
    mask |= bits_of(d16, kept) << first;
  }
  return mask;
}

}  // namespace glissade::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
