// Compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "glissade/collision/leaf_kernels.cpp"
#include "leaf_kernels.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "pair_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace glissade::collision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag4 = hn::FixedTag<float, kWidth>;
using Four = hn::Vec<Tag4>;

HWY_INLINE Four corner(const LeafTriangles& t, std::size_t axis, std::size_t c) {
  return hn::Load(Tag4(), t.corner[axis][c].data());
}

HWY_INLINE void find_normals(LeafTriangles& t) {
  const Tag4 d;
  Four u[3];
  Four v[3];
  Four extent = hn::Zero(d);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    u[axis] = hn::Sub(corner(t, axis, 1), corner(t, axis, 0));
    v[axis] = hn::Sub(corner(t, axis, 2), corner(t, axis, 0));
    extent = hn::Max(extent, hn::Max(hn::Abs(u[axis]), hn::Abs(v[axis])));
  }
  hn::Store(extent, d, t.extent.data());
  Four n[3];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t y = (axis + 1) % 3;
    const std::size_t z = (axis + 2) % 3;
    n[axis] = hn::NegMulAdd(u[z], v[y], hn::Mul(u[y], v[z]));
  }
  const Four square = hn::MulAdd(n[0], n[0], hn::MulAdd(n[1], n[1], hn::Mul(n[2], n[2])));
  // Any vector may separate. Its inverse length is a little too short, because gaps along it are taken for distances;
  // where the square underflows, it is 0, and nothing is separated.
  const auto usable = hn::Ge(square, hn::Set(d, 1e-36F));
  hn::Store(hn::IfThenElseZero(usable, hn::Div(hn::Set(d, 0.999999F), hn::Sqrt(square))), d, t.inverse_length.data());
  for (std::size_t axis = 0; axis < 3; ++axis)
    hn::Store(n[axis], d, t.normal[axis].data());
  const auto project = [&](std::size_t c) HWY_ATTR {
    return hn::MulAdd(n[0], corner(t, 0, c), hn::MulAdd(n[1], corner(t, 1, c), hn::Mul(n[2], corner(t, 2, c))));
  };
  const Four p0 = project(0);
  const Four p1 = project(1);
  const Four p2 = project(2);
  hn::Store(hn::Min(p0, hn::Min(p1, p2)), d, t.low.data());
  hn::Store(hn::Max(p0, hn::Max(p1, p2)), d, t.high.data());
}

// One bit for each triangle.
HWY_INLINE PairMask present(const TriangleLeaf& leaf) {
  const hn::FixedTag<std::int32_t, kWidth> d;
  return bits_of(d, hn::Gt(hn::Load(d, leaf.triangle.data()), hn::Set(d, -1)));
}

void prepare_P(const TriangleLeaf& leaf_P, LeafPair& leaves) {
  const Tag4 d;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t c = 0; c < 3; ++c)
      hn::Store(hn::Load(d, leaf_P.corner[axis][c].data()), d, leaves.p.corner[axis][c].data());
  }
  find_normals(leaves.p);
  // Four bits for each.
  alignas(32) static constexpr std::uint16_t kRows[16] = {0x0000, 0x000f, 0x00f0, 0x00ff, 0x0f00, 0x0f0f,
                                                          0x0ff0, 0x0fff, 0xf000, 0xf00f, 0xf0f0, 0xf0ff,
                                                          0xff00, 0xff0f, 0xfff0, 0xffff};
  leaves.present_P = kRows[present(leaf_P)];
}

void prepare_Q(const LeafFrame& frame, const TriangleLeaf& leaf_Q, LeafPair& leaves) {
  const Tag4 d;
  for (std::size_t c = 0; c < 3; ++c) {
    const Four x = hn::Load(d, leaf_Q.corner[0][c].data());
    const Four y = hn::Load(d, leaf_Q.corner[1][c].data());
    const Four z = hn::Load(d, leaf_Q.corner[2][c].data());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto& row = frame.matrix[axis];
      const Four moved = hn::MulAdd(
          x, hn::Set(d, row[0]),
          hn::MulAdd(y, hn::Set(d, row[1]), hn::MulAdd(z, hn::Set(d, row[2]), hn::Set(d, frame.p_PQ[axis]))));
      hn::Store(moved, d, leaves.q.corner[axis][c].data());
    }
  }
  find_normals(leaves.q);
  leaves.present_Q = 0x1111U * present(leaf_Q);
}

// Values of four triangles of P and four of Q, as many as fit.
template <class D>
HWY_INLINE hn::Vec<D> of_both(D d, const float* values_P, const float* values_Q, std::size_t first) {
  if constexpr (hn::MaxLanes(D()) == kWidth) {
    return hn::Load(d, first == 0 ? values_P : values_Q);
  } else {
    return hn::Combine(d, hn::Load(Tag4(), values_Q), hn::Load(Tag4(), values_P));
  }
}

float leaf_gap(const LeafFrame& frame, const LeafPair& leaves) {
  const hn::CappedTag<float, 2 * kWidth> d;
  using V = hn::Vec<decltype(d)>;
  V most = hn::Set(d, -1e30F);
  for (std::size_t first = 0; first < 2 * kWidth; first += hn::Lanes(d)) {
    V normal[3];
    for (std::size_t axis = 0; axis < 3; ++axis)
      normal[axis] = of_both(d, leaves.p.normal[axis].data(), leaves.q.normal[axis].data(), first);
    const auto project = [&](const LeafTriangles& leaf, V& low, V& high) HWY_ATTR {
      for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t t = 0; t < kWidth; ++t) {
          const auto coordinate = [&](std::size_t axis) HWY_ATTR { return hn::Set(d, leaf.corner[axis][c][t]); };
          const V at = hn::MulAdd(normal[0], coordinate(0),
                                  hn::MulAdd(normal[1], coordinate(1), hn::Mul(normal[2], coordinate(2))));
          low = c + t == 0 ? at : hn::Min(low, at);
          high = c + t == 0 ? at : hn::Max(high, at);
        }
      }
    };
    V low_P;
    V high_P;
    V low_Q;
    V high_Q;
    project(leaves.p, low_P, high_P);
    project(leaves.q, low_Q, high_Q);
    const V gap = hn::Max(hn::Sub(low_P, high_Q), hn::Sub(low_Q, high_P));
    const V inverse_length = of_both(d, leaves.p.inverse_length.data(), leaves.q.inverse_length.data(), first);
    most = hn::Max(most, hn::Mul(gap, inverse_length));
  }
  return hn::GetLane(hn::MaxOfLanes(d, most)) - frame.uncertainty;
}

// How far three corners lie beyond the interval [low, high] along a normal, on either side of it.
template <class D, class Normal, class Corner>
HWY_INLINE hn::Vec<D> gap_along(D, const Normal& n, hn::Vec<D> low, hn::Vec<D> high, const Corner& corner_of) {
  const auto project = [&](std::size_t c) HWY_ATTR {
    return hn::MulAdd(n(0), corner_of(0, c), hn::MulAdd(n(1), corner_of(1, c), hn::Mul(n(2), corner_of(2, c))));
  };
  const auto p0 = project(0);
  const auto p1 = project(1);
  const auto p2 = project(2);
  return hn::Max(hn::Sub(hn::Min(p0, hn::Min(p1, p2)), high), hn::Sub(low, hn::Max(p0, hn::Max(p1, p2))));
}

PairMask test(const LeafFrame& frame, float distance, LeafPair& leaves) {
  const LeafTriangles& p = leaves.p;
  const LeafTriangles& q = leaves.q;
  const hn::CappedTag<float, kPairs> d;
  using V = hn::Vec<decltype(d)>;
  PairMask mask = 0;
  for (std::size_t first = 0; first < kPairs; first += hn::Lanes(d)) {
    const auto normal_P = [&](std::size_t axis) HWY_ATTR { return of_P(d, p.normal[axis].data(), first); };
    const auto normal_Q = [&](std::size_t axis) HWY_ATTR { return of_Q(d, q.normal[axis].data()); };
    const auto corner_P = [&](std::size_t axis, std::size_t c)
                              HWY_ATTR { return of_P(d, p.corner[axis][c].data(), first); };
    const auto corner_Q = [&](std::size_t axis, std::size_t c) HWY_ATTR { return of_Q(d, q.corner[axis][c].data()); };
    const V along_P = gap_along(d, normal_P, of_P(d, p.low.data(), first), of_P(d, p.high.data(), first), corner_Q);
    const V along_Q = gap_along(d, normal_Q, of_Q(d, q.low.data()), of_Q(d, q.high.data()), corner_P);
    const V gap = hn::Sub(hn::Max(hn::Mul(along_P, of_P(d, p.inverse_length.data(), first)),
                                  hn::Mul(along_Q, of_Q(d, q.inverse_length.data()))),
                          hn::Set(d, frame.uncertainty));
    hn::Store(gap, d, leaves.gaps.gap.data() + first);
    mask |= bits_of(d, hn::Not(hn::Gt(gap, hn::Set(d, distance)))) << first;
  }

  return mask & leaves.present();
}

template <class V>
struct Vector3 {
  V x;
  V y;
  V z;
};

// The corners of both triangles of each pair.
template <class D>
HWY_INLINE void load_corners(D d, const LeafPair& leaves, std::size_t first, Vector3<hn::Vec<D>> (&p)[3],
                             Vector3<hn::Vec<D>> (&q)[3]) {
  const auto& of_p = leaves.p.corner;
  const auto& of_q = leaves.q.corner;
  for (std::size_t c = 0; c < 3; ++c) {
    p[c] = {of_P(d, of_p[0][c].data(), first), of_P(d, of_p[1][c].data(), first), of_P(d, of_p[2][c].data(), first)};
    q[c] = {of_Q(d, of_q[0][c].data()), of_Q(d, of_q[1][c].data()), of_Q(d, of_q[2][c].data())};
  }
}

template <class V>
HWY_INLINE Vector3<V> minus(const Vector3<V>& a, const Vector3<V>& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
template <class V>
HWY_INLINE Vector3<V> times(const Vector3<V>& a, const Vector3<V>& b) {
  return {hn::NegMulAdd(a.z, b.y, hn::Mul(a.y, b.z)), hn::NegMulAdd(a.x, b.z, hn::Mul(a.z, b.x)),
          hn::NegMulAdd(a.y, b.x, hn::Mul(a.x, b.y))};
}
template <class V>
HWY_INLINE V dot(const Vector3<V>& a, const Vector3<V>& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
template <class M, class V>
HWY_INLINE Vector3<V> choose(M mask, const Vector3<V>& yes, const Vector3<V>& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y), hn::IfThenElse(mask, yes.z, no.z)};
}

// The corners of a triangle, first the one that is alone on its side of the other's plane.
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

// As `filtered_intersection` in triangle_filter.h, for 16 pairs at once.
CertainPairs cross(const LeafFrame& frame, const LeafPair& leaves) {
  const hn::CappedTag<float, kPairs> d;
  using V = hn::Vec<decltype(d)>;
  CertainPairs certain{};
  for (std::size_t first = 0; first < kPairs; first += hn::Lanes(d)) {
    Vector3<V> p[3];
    Vector3<V> q[3];
    load_corners(d, leaves, first, p, q);
    // No two of the six corners differ by more than `largest` in a coordinate, none of one triangle from its first by
    // more than its extent. A determinant of three such differences u, v, w, each coordinate off by 2 ε, is off by
    // 2√3 ε (|u||v| + |v||w| + |w||u|) and half as much again for products of errors, where |u| ≤ √3 extent and so on:
    // 16 ε (uv + vw + wu). 48 roundings add half an epsilon of uvw each.
    const V extent_p = of_P(d, leaves.p.extent.data(), first);
    const V extent_q = of_Q(d, leaves.q.extent.data());
    const auto between = minus(q[0], p[0]);
    const V largest = hn::Add(hn::Max(hn::Abs(between.x), hn::Max(hn::Abs(between.y), hn::Abs(between.z))),
                              hn::Add(extent_p, extent_q));
    const V of_corner = hn::Set(d, 16.0F * frame.corner_uncertainty);
    const V of_rounding = hn::Set(d, 4e-6F);
    const V smallest = hn::Set(d, 1e-30F);  // for underflow
    const auto error_of = [&](V u, V v, V w) HWY_ATTR {
      const V products = hn::MulAdd(u, v, hn::MulAdd(v, w, hn::Mul(w, u)));
      return hn::MulAdd(of_corner, products, hn::MulAdd(hn::Mul(of_rounding, u), hn::Mul(v, w), smallest));
    };
    const V error_of_sides_p = error_of(extent_q, extent_q, largest);
    const V error_of_sides_q = error_of(extent_p, extent_p, largest);
    const V error = error_of(hn::Add(extent_p, extent_p), largest, largest);

    const Vector3<V> normal_p{of_P(d, leaves.p.normal[0].data(), first), of_P(d, leaves.p.normal[1].data(), first),
                              of_P(d, leaves.p.normal[2].data(), first)};
    const Vector3<V> normal_q{of_Q(d, leaves.q.normal[0].data()), of_Q(d, leaves.q.normal[1].data()),
                              of_Q(d, leaves.q.normal[2].data())};
    V side_p[3];
    V side_q[3];
    V least_p = hn::Set(d, 1e30F);
    V least_q = least_p;
    for (std::size_t c = 0; c < 3; ++c) {
      side_p[c] = hn::Neg(dot(normal_q, minus(p[c], q[0])));
      side_q[c] = hn::Neg(dot(normal_p, minus(q[c], p[0])));
      least_p = hn::Min(least_p, hn::Abs(side_p[c]));
      least_q = hn::Min(least_q, hn::Abs(side_q[c]));
    }
    // Where one plane has all of the other triangle on one side, there is no apex; that is for `test` to find.
    const auto one_side = [&](const V(&side)[3]) HWY_ATTR {
      return hn::And(same_sign(d, side[0], side[1]), same_sign(d, side[1], side[2]));
    };
    const auto sides_certain =
        hn::AndNot(hn::Or(one_side(side_p), one_side(side_q)),
                   hn::And(hn::Gt(least_p, error_of_sides_p), hn::Gt(least_q, error_of_sides_q)));

    const Apex<V> a = find_apex(d, p, side_p);
    const Apex<V> b = find_apex(d, q, side_q);
    const auto zero = hn::Zero(d);
    const auto turn_b = hn::Lt(a.side, zero);
    const auto turn_a = hn::Lt(b.side, zero);
    const auto to_b = minus(b.apex, a.apex);
    const auto orientation = [&](const Vector3<V>& end_a, const Vector3<V>& end_b) HWY_ATTR {
      return hn::Neg(dot(times(minus(end_a, a.apex), to_b), minus(end_b, a.apex)));
    };
    const V left = orientation(choose(turn_a, a.right, a.left), choose(turn_b, b.right, b.left));
    const V right = orientation(choose(turn_a, a.left, a.right), choose(turn_b, b.left, b.right));
    const V minus_error = hn::Neg(error);
    const auto intersect = hn::And(hn::Lt(left, minus_error), hn::Gt(right, error));
    const auto apart = hn::Or(hn::Gt(left, error), hn::Lt(right, minus_error));
    certain.intersect |= bits_of(d, hn::And(intersect, sides_certain)) << first;
    certain.apart |= bits_of(d, hn::And(apart, sides_certain)) << first;
  }
  return certain;
}

// The square of the gap along a vector of any length, with its sign.
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
  return hn::IfThenElseZero(hn::Ge(square, hn::Set(d, 1e-36F)), hn::Div(hn::Mul(gap, hn::Abs(gap)), square));
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
    V most = hn::Zero(d);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3<V> edge_P = minus(p[(i + 1) % 3], p[i]);
      for (std::size_t j = 0; j < 3; ++j)
        most = hn::Max(most, signed_square_of_gap(times(edge_P, minus(q[(j + 1) % 3], q[j])), p, q));
    }
    const V along_edges = hn::MulSub(hn::Sqrt(most), hn::Set(d, 0.999999F), hn::Set(d, frame.uncertainty));
    float* const gaps = leaves.gaps.gap.data() + first;
    const V gap = hn::Max(along_edges, hn::Load(d, gaps));
    hn::Store(gap, d, gaps);
    mask |= bits_of(d, hn::Not(hn::Gt(gap, hn::Set(d, distance)))) << first;
  }
  return mask & pairs;
}

// Gaps of other pairs are infinite.
float least_gap(const LeafPair& leaves, PairMask pairs) {
  alignas(64) static constexpr std::int32_t kBit[kPairs] = {1,   2,   4,    8,    16,   32,   64,    128,
                                                            256, 512, 1024, 2048, 4096, 8192, 16384, 32768};
  const hn::CappedTag<float, kPairs> d;
  const hn::RebindToSigned<decltype(d)> d32;
  const auto in_mask = hn::Set(d32, static_cast<std::int32_t>(pairs));
  auto least = hn::Set(d, 1e30F);
  for (std::size_t first = 0; first < kPairs; first += hn::Lanes(d)) {
    const auto asked = hn::RebindMask(d, hn::TestBit(in_mask, hn::Load(d32, kBit + first)));
    least = hn::Min(least, hn::IfThenElse(asked, hn::Load(d, leaves.gaps.gap.data() + first), least));
  }
  return hn::GetLane(hn::MinOfLanes(d, least));
}

const LeafKernels& leaf_kernels_of_target() {
  static constexpr LeafKernels kKernels = {prepare_P, prepare_Q, leaf_gap, test, cross, edges, least_gap};
  return kKernels;
}

}  // namespace glissade::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace glissade::collision {

namespace {

HWY_EXPORT(leaf_kernels_of_target);

}  // namespace

const LeafKernels& leaf_kernels() {
  return HWY_DYNAMIC_DISPATCH(leaf_kernels_of_target)();
}

}  // namespace glissade::collision
#endif
