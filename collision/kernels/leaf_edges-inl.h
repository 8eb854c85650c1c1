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

// The greatest signed square of a gap of those along directions that were tried; 0 if none separates.
template <class V, bool kKeepsDirection>
struct GreatestGap {
  const Vector3<V> (&p)[3];
  const Vector3<V> (&q)[3];
  V square = hn::Zero(hn::DFromV<V>());
  Vector3<V> n{square, square, square};  // of any length; only if kKeepsDirection

  HWY_INLINE void try_along(const Vector3<V>& direction) {
    const V of_direction = signed_square_of_gap(direction, p, q);
    if constexpr (kKeepsDirection) n = choose(hn::Gt(of_direction, square), direction, n);
    square = hn::Max(square, of_direction);
  }
  // Cross products of two edges.
  HWY_INLINE void try_cross_products() {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3<V> edge_M = minus(p[(i + 1) % 3], p[i]);
      for (std::size_t j = 0; j < 3; ++j)
        try_along(times(edge_M, minus(q[(j + 1) % 3], q[j])));
    }
  }
  // Across the edges of both triangles within their planes: nothing else separates triangles beside each other in about
  // one plane. Normals have about unit length, because powers of the size of a triangle would underflow.
  HWY_INLINE void try_across_edges(const Vector3<V>& normal_M, const Vector3<V>& normal_N) {
    for (std::size_t i = 0; i < 3; ++i) {
      try_along(times(normal_M, minus(p[(i + 1) % 3], p[i])));
      try_along(times(normal_N, minus(q[(i + 1) % 3], q[i])));
    }
  }
};

// `LeafKernels::edges`, and with directions `LeafKernels::edges_and_directions`.
template <bool kKeepsDirections>
HWY_INLINE PairMask raise_gaps(const LeafFrame& frame, float distance, PairMask pairs, LeafPair& leaves) {
  const hn::CappedTag<float, kPairs> d;
  using V = hn::Vec<decltype(d)>;
  const PairMask lanes = (1U << hn::Lanes(d)) - 1U;
  PairMask mask = 0;
  for (std::size_t first = 0; first < kPairs; first += hn::Lanes(d)) {
    const PairMask asked = pairs >> first & lanes;
    if (asked == 0) continue;
    Vector3<V> p[3];
    Vector3<V> q[3];
    load_corners(d, leaves, first, p, q);
    GreatestGap<V, kKeepsDirections> greatest{p, q};
    const Vector3<V> normal_M = unit_normal_M(d, leaves, first);
    const Vector3<V> normal_N = unit_normal_N(d, leaves);
    float* const gaps = leaves.gaps.gap.data() + first;
    const V along_normals = hn::Load(d, gaps);
    // Raises the gaps of some pairs, and of no others, because which others share a vector depends on the instruction
    // set. Returns those within the distance.
    const auto raise = [&](PairMask some) HWY_ATTR {
      const V beyond = hn::Sub(hn::Mul(hn::Sqrt(greatest.square), hn::Set(d, 0.999999F)),
                               hn::Set(d, frame.uncertainty + kUnderflow));
      const V before = hn::Load(d, gaps);
      const V gap = hn::IfThenElse(mask_of(d, some), hn::Max(beyond, before), before);
      hn::Store(gap, d, gaps);
      return bits_of(d, hn::Not(hn::Gt(gap, hn::Set(d, distance)))) & some;
    };
    greatest.try_cross_products();
    PairMask near = raise(asked);
    if (near != 0) {
      greatest.try_across_edges(normal_M, normal_N);
      near = raise(near);
    }
    if constexpr (kKeepsDirections) {
      const auto by_edges = hn::Gt(hn::Load(d, gaps), along_normals);
      const auto by_N = mask_of(d, leaves.by_N >> first);
      const Vector3<V> n = choose(by_edges, greatest.n, choose(by_N, normal_N, normal_M));
      const auto is_from_N = hn::Lt(dot(n, minus(q[0], p[0])), hn::Zero(d));
      const auto store = [&](V component, std::size_t axis) HWY_ATTR {
        hn::Store(hn::IfThenElse(is_from_N, hn::Neg(component), component), d,
                  leaves.directions.n[axis].data() + first);
      };
      store(n.x, 0);
      store(n.y, 1);
      store(n.z, 2);
      leaves.by_edges = (leaves.by_edges & ~(lanes << first)) | bits_of(d, by_edges) << first;
    }
    mask |= near << first;
  }
  return mask;
}

PairMask edges(const LeafFrame& frame, float distance, PairMask pairs, LeafPair& leaves) {
  return raise_gaps<false>(frame, distance, pairs, leaves);
}

PairMask edges_and_directions(const LeafFrame& frame, float distance, PairMask pairs, LeafPair& leaves) {
  return raise_gaps<true>(frame, distance, pairs, leaves);
}

}  // namespace glissade::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
