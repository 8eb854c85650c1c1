// Intersection of triangles, for 16 pairs at once, decided only where single precision is certain. Compiled once for
// each instruction set.
#if defined(GLISSADE_COLLISION_LEAF_CROSSING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GLISSADE_COLLISION_LEAF_CROSSING_INL_H_
#undef GLISSADE_COLLISION_LEAF_CROSSING_INL_H_
#else
#define GLISSADE_COLLISION_LEAF_CROSSING_INL_H_
#endif

#include <cstddef>

#include <hwy/highway.h>

#include "kernels/leaf_frame.h"
#include "kernels/leaf_pair.h"
#include "kernels/triangle_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace glissade::collision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The corners of a triangle. The apex is alone on its side of the other triangle's plane.
template <class V>
struct Apex {
  Vector3<V> apex;
  Vector3<V> left;
  Vector3<V> right;
  V side;  // of the apex
};

template <class D, class V>
HWY_INLINE hn::Mask<D> same_sign(D d, V a, V b) {
  const hn::RebindToSigned<D> d32;
  return hn::RebindMask(d, hn::Gt(hn::BitCast(d32, hn::Xor(a, b)), hn::Set(d32, -1)));
}

template <class D, class V>
HWY_INLINE Apex<V> find_apex(D d, const Vector3<V> (&corner)[3], const V (&side)[3]) {
  const auto alone0 = same_sign(d, side[1], side[2]);
  const auto alone1 = same_sign(d, side[0], side[2]);
  return {choose(alone0, corner[0], choose(alone1, corner[1], corner[2])),
          choose(alone0, corner[1], choose(alone1, corner[2], corner[0])),
          choose(alone0, corner[2], choose(alone1, corner[0], corner[1])),
          hn::IfThenElse(alone0, side[0], hn::IfThenElse(alone1, side[1], side[2]))};
}

// The corners of two triangles, in single precision.
template <class V>
struct TwoTriangles {
  Vector3<V> p[3];
  Vector3<V> q[3];
};

template <class V>
struct DeterminantErrors {
  V of_sides_p;  // of the corners of M and the plane of N
  V of_sides_q;
  V of_orientation;
};

// The error of a determinant of three differences u, v, w of corners, whose components have errors of at most e_u, e_v,
// e_w, is at most √3 (e_u |v||w| + e_v |u||w| + e_w |u||v|), with lengths that include the errors. Let ε be
// `corner_uncertainty`. The error is 2 ε for differences of two corners of N, ε for those between M and N, and
// `edge_uncertainty_M` for those within M, which is not moved. No difference between the triangles is longer than that
// of their first corners plus both extents; none within a triangle is longer than two extents. Each product undergoes
// nine roundings of at most 2^-24 of its value, and the products of all components add up to less than 1.16 |u||v||w|.
template <class D, class V>
HWY_INLINE DeterminantErrors<V> determinant_errors(D d, const LeafFrame& frame, const TwoTriangles<V>& t, V extent_p,
                                                   V extent_q) {
  constexpr float kRoot3 = 1.7321F;
  const float of_both = kRoot3 * frame.corner_uncertainty;
  const V rounding = hn::Set(d, 1e-6F);
  const V smallest = hn::Set(d, 1e-30F);  // for underflow
  const V p = hn::Add(extent_p, hn::Set(d, 4.0F * frame.corner_uncertainty));
  const V q = hn::Add(extent_q, hn::Set(d, 4.0F * frame.corner_uncertainty));
  const Vector3<V> between = minus(t.q[0], t.p[0]);
  const V most = hn::Add(hn::Mul(hn::Sqrt(dot(between, between)), hn::Set(d, 1.000001F)), hn::Add(p, q));

  const V four_of_both = hn::Set(d, 4.0F * of_both);
  const V one_of_both = hn::Set(d, of_both);
  const V of_p = hn::Set(d, kRoot3 * frame.edge_uncertainty_M);
  const V two_of_p = hn::Set(d, 2.0F * kRoot3 * frame.edge_uncertainty_M);
  // `of_corners`: contribution of the errors of corners; `whole`: |u||v||w|.
  const auto error_of = [&](V of_corners, V whole)
                            HWY_ATTR { return hn::Add(of_corners, hn::Add(hn::Mul(rounding, whole), smallest)); };
  const V q_most = hn::Mul(q, most);
  const V p_most = hn::Mul(p, most);
  return {error_of(hn::Add(hn::Mul(four_of_both, q_most), hn::Mul(one_of_both, hn::Mul(q, q))), hn::Mul(q, q_most)),
          error_of(hn::Add(hn::Mul(two_of_p, p_most), hn::Mul(one_of_both, hn::Mul(p, p))), hn::Mul(p, p_most)),
          error_of(hn::Add(hn::Mul(four_of_both, p_most), hn::Mul(of_p, hn::Mul(most, most))),
                   hn::Mul(hn::Add(p, p), hn::Mul(most, most)))};
}

// For three corners, determinants whose signs are their sides of a plane.
template <class V>
struct Sides {
  V side[3];
  V least;  // of their absolute values
};

template <class V>
HWY_INLINE Sides<V> sides_of(const Vector3<V> (&corner)[3], const Vector3<V>& normal, const Vector3<V>& on_plane) {
  Sides<V> sides;
  for (std::size_t c = 0; c < 3; ++c)
    sides.side[c] = hn::Neg(dot(normal, minus(corner[c], on_plane)));
  sides.least = hn::Min(hn::Abs(sides.side[0]), hn::Min(hn::Abs(sides.side[1]), hn::Abs(sides.side[2])));
  return sides;
}

template <class D, class V>
HWY_INLINE hn::Mask<D> all_on_one_side(D d, const Sides<V>& sides) {
  return hn::And(same_sign(d, sides.side[0], sides.side[1]), same_sign(d, sides.side[1], sides.side[2]));
}

// Two orientations that decide whether the triangles overlap on the line in which their planes intersect: they do if
// `left` is negative and `right` is positive.
template <class V>
struct Orientations {
  V left;
  V right;
};

template <class D, class V>
HWY_INLINE Orientations<V> orientations(D d, const TwoTriangles<V>& t, const Sides<V>& sides_p,
                                        const Sides<V>& sides_q) {
  const Apex<V> a = find_apex(d, t.p, sides_p.side);
  const Apex<V> b = find_apex(d, t.q, sides_q.side);
  const auto turn_b = hn::Lt(a.side, hn::Zero(d));
  const auto turn_a = hn::Lt(b.side, hn::Zero(d));
  const Vector3<V> to_b = minus(b.apex, a.apex);
  const auto orientation = [&](const Vector3<V>& end_a, const Vector3<V>& end_b) HWY_ATTR {
    return hn::Neg(dot(times(minus(end_a, a.apex), to_b), minus(end_b, a.apex)));
  };
  return {orientation(choose(turn_a, a.right, a.left), choose(turn_b, b.right, b.left)),
          orientation(choose(turn_a, a.left, a.right), choose(turn_b, b.left, b.right))};
}

// As `filtered_intersection` in triangle_filter.h, for 16 pairs at once.
CertainPairs cross(const LeafFrame& frame, const LeafPair& leaves) {
  const hn::CappedTag<float, kPairs> d;
  using V = hn::Vec<decltype(d)>;
  CertainPairs certain{};
  for (std::size_t first = 0; first < kPairs; first += hn::Lanes(d)) {
    TwoTriangles<V> t;
    load_corners(d, leaves, first, t.p, t.q);
    const DeterminantErrors<V> errors =
        determinant_errors(d, frame, t, of_M(d, leaves.p.extent.data(), first), of_N(d, leaves.q.extent.data()));
    const auto& normal_M = leaves.p.normal;
    const auto& normal_N = leaves.q.normal;
    const Sides<V> sides_p =
        sides_of(t.p, {of_N(d, normal_N[0].data()), of_N(d, normal_N[1].data()), of_N(d, normal_N[2].data())}, t.q[0]);
    const Sides<V> sides_q = sides_of(
        t.q,
        {of_M(d, normal_M[0].data(), first), of_M(d, normal_M[1].data(), first), of_M(d, normal_M[2].data(), first)},
        t.p[0]);
    // If one triangle lies entirely on one side of the other's plane, there is no apex; `test` finds that case.
    const auto sides_certain =
        hn::AndNot(hn::Or(all_on_one_side(d, sides_p), all_on_one_side(d, sides_q)),
                   hn::And(hn::Gt(sides_p.least, errors.of_sides_p), hn::Gt(sides_q.least, errors.of_sides_q)));

    const auto [left, right] = orientations(d, t, sides_p, sides_q);
    const V error = errors.of_orientation;
    const V minus_error = hn::Neg(error);
    const auto intersect = hn::And(hn::Lt(left, minus_error), hn::Gt(right, error));
    const auto apart = hn::Or(hn::Gt(left, error), hn::Lt(right, minus_error));
    certain.intersect |= bits_of(d, hn::And(intersect, sides_certain)) << first;
    certain.apart |= bits_of(d, hn::And(apart, sides_certain)) << first;
  }
  return certain;
}

}  // namespace glissade::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
