// Gaps between triangles along cross products of their edges, and across edges in the planes of the triangles, for 16
// pairs at once. Compiled once for each instruction
// set.
#if defined(GLISSADE_COLLISION_LEAF_EDGES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GLISSADE_COLLISION_LEAF_EDGES_INL_H_
#undef GLISSADE_COLLISION_LEAF_EDGES_INL_H_
#else
#define GLISSADE_COLLISION_LEAF_EDGES_INL_H_
#endif

#include <cstddef>

#include <hwy/highway.h>

#include "kernels/child_pairs.h"
#include "kernels/leaf_frame.h"
#include "kernels/leaf_pair.h"
#include "kernels/triangle_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace glissade::collision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Cross products whose square is below kLeastSquare are ignored, because the square of a gap may underflow. An
// underflow changes that square by at most 2^-149, so the gap along any other cross product is too large by less than
// kUnderflow, which exceeds the root of 2^-149 / kLeastSquare.
constexpr float kLeastSquare = 1e-28F;
constexpr float kUnderflow = 4e-9F;

// The signed square of the gap along n, a vector of any length.
template <class V>
HWY_INLINE V signed_square_of_gap(const Vector3<V>& n, const Vector3<V> (&p)[3], const Vector3<V> (&q)[3]) {
  const hn::DFromV<V> d;
  const V p0 = dot(n, p[0]);
  const V p1 = dot(n, p[1]);
  const V p2 = dot(n, p[2]);
  const V q0 = dot(n, q[0]);
  const V q1 = dot(n, q[1]);
  const V q2 = dot(n, q[2]);
  const V gap = hn::Max(hn::Sub(hn::Min(p0, hn::Min(p1, p2)), hn::Max(q0, hn::Max(q1, q2))),
                        hn::Sub(hn::Min(q0, hn::Min(q1, q2)), hn::Max(p0, hn::Max(p1, p2))));
  const V square = dot(n, n);
  return hn::IfThenElseZero(hn::Ge(square, hn::Set(d, kLeastSquare)), hn::Div(hn::Mul(gap, hn::Abs(gap)), square));
}

// The greatest signed square of a gap along a cross product of two edges; 0 if none separates.
template <class V>
HWY_INLINE V gap_along_cross_products(const Vector3<V> (&p)[3], const Vector3<V> (&q)[3]) {
  V most = hn::Zero(hn::DFromV<V>());
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3<V> edge_M = minus(p[(i + 1) % 3], p[i]);
    for (std::size_t j = 0; j < 3; ++j)
      most = hn::Max(most, signed_square_of_gap(times(edge_M, minus(q[(j + 1) % 3], q[j])), p, q));
  }
  return most;
}

// The same across the edges of both triangles within their planes: nothing else separates triangles beside each other
// in about one plane. Normals have about unit length, because powers of the size of a triangle would underflow.
template <class V>
HWY_INLINE V gap_across_edges(const Vector3<V>& normal_M, const Vector3<V>& normal_N, const Vector3<V> (&p)[3],
                              const Vector3<V> (&q)[3]) {
  V most = hn::Zero(hn::DFromV<V>());
  for (std::size_t i = 0; i < 3; ++i) {
    most = hn::Max(most, signed_square_of_gap(times(normal_M, minus(p[(i + 1) % 3], p[i])), p, q));
    most = hn::Max(most, signed_square_of_gap(times(normal_N, minus(q[(i + 1) % 3], q[i])), p, q));
  }
  return most;
}

PairMask edges(const LeafFrame& frame, float distance, PairMask pairs, LeafPair& leaves) {
  const hn::CappedTag<float, kPairs> d;
  using V = hn::Vec<decltype(d)>;
  PairMask mask = 0;
  for (std::size_t first = 0; first < kPairs; first += hn::Lanes(d)) {
    const PairMask asked = pairs >> first & ((1U << hn::Lanes(d)) - 1U);
    if (asked == 0) continue;
    Vector3<V> p[3];
    Vector3<V> q[3];
    load_corners(d, leaves, first, p, q);
    float* const gaps = leaves.gaps.gap.data() + first;
    // Raises the gaps of some pairs, and of no others, because which others share a vector depends on the instruction
    // set. Returns those within the distance.
    const auto raise = [&](PairMask some, V signed_square) HWY_ATTR {
      const V beyond =
          hn::Sub(hn::Mul(hn::Sqrt(signed_square), hn::Set(d, 0.999999F)), hn::Set(d, frame.uncertainty + kUnderflow));
      const V before = hn::Load(d, gaps);
      const V gap = hn::IfThenElse(mask_of(d, some), hn::Max(beyond, before), before);
      hn::Store(gap, d, gaps);
      return bits_of(d, hn::Not(hn::Gt(gap, hn::Set(d, distance)))) & some;
    };
    PairMask near = raise(asked, gap_along_cross_products(p, q));
    if (near != 0)
      near = raise(near, gap_across_edges(unit_normal_M(d, leaves, first), unit_normal_N(d, leaves), p, q));
    mask |= near << first;
  }
  return mask;
}

}  // namespace glissade::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
