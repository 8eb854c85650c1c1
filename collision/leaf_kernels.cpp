// Compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "glissade/collision/leaf_kernels.cpp"
#include "leaf_kernels.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace glissade::collision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kPairs = kWidth * kWidth;
using Tag4 = hn::FixedTag<float, kWidth>;
using Four = hn::Vec<Tag4>;

// Four triangles in the frame of P, with what their own normals see of them.
struct LeafTriangles {
  alignas(64) float corner[3][3][kWidth];  // [axis][corner][triangle]
  alignas(16) float normal[3][kWidth];     // of any length
  alignas(16) float inverse_length[kWidth];
  alignas(16) float low[kWidth];  // least and greatest projection of the own corners on the normal
  alignas(16) float high[kWidth];
};

HWY_INLINE Four corner(const LeafTriangles& t, std::size_t axis, std::size_t c) {
  return hn::Load(Tag4(), t.corner[axis][c]);
}

HWY_INLINE void find_normals(LeafTriangles& t) {
  const Tag4 d;
  Four u[3];
  Four v[3];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    u[axis] = hn::Sub(corner(t, axis, 1), corner(t, axis, 0));
    v[axis] = hn::Sub(corner(t, axis, 2), corner(t, axis, 0));
  }
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
  hn::Store(hn::IfThenElseZero(usable, hn::Div(hn::Set(d, 0.999999F), hn::Sqrt(square))), d, t.inverse_length);
  for (std::size_t axis = 0; axis < 3; ++axis)
    hn::Store(n[axis], d, t.normal[axis]);
  const auto project = [&](std::size_t c) HWY_ATTR {
    return hn::MulAdd(n[0], corner(t, 0, c), hn::MulAdd(n[1], corner(t, 1, c), hn::Mul(n[2], corner(t, 2, c))));
  };
  const Four p0 = project(0);
  const Four p1 = project(1);
  const Four p2 = project(2);
  hn::Store(hn::Min(p0, hn::Min(p1, p2)), d, t.low);
  hn::Store(hn::Max(p0, hn::Max(p1, p2)), d, t.high);
}

HWY_INLINE void load_base(const TriangleLeaf& leaf, LeafTriangles& t) {
  const Tag4 d;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t c = 0; c < 3; ++c)
      hn::Store(hn::Load(d, leaf.corner[axis][c].data()), d, t.corner[axis][c]);
  }
}

HWY_INLINE void load_moved(const LeafFrame& frame, const TriangleLeaf& leaf, LeafTriangles& t) {
  const Tag4 d;
  for (std::size_t c = 0; c < 3; ++c) {
    const Four x = hn::Load(d, leaf.corner[0][c].data());
    const Four y = hn::Load(d, leaf.corner[1][c].data());
    const Four z = hn::Load(d, leaf.corner[2][c].data());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto& row = frame.matrix[axis];
      const Four moved = hn::MulAdd(
          x, hn::Set(d, row[0]),
          hn::MulAdd(y, hn::Set(d, row[1]), hn::MulAdd(z, hn::Set(d, row[2]), hn::Set(d, frame.p_PQ[axis]))));
      hn::Store(moved, d, t.corner[axis][c]);
    }
  }
}

// Lanes of a vector that starts at pair `first`: the triangle of P of each pair, and the triangle of Q.
template <class D>
HWY_INLINE hn::Vec<D> of_P(D d, const float* values, std::size_t first) {
  if constexpr (hn::MaxLanes(D()) == kWidth) {
    return hn::Set(d, values[first / kWidth]);
  } else {
    alignas(64) static constexpr std::int32_t kTriangle[kPairs] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
    return hn::TableLookupLanes(hn::LoadDup128(d, values), hn::SetTableIndices(d, kTriangle + first));
  }
}

template <class D>
HWY_INLINE hn::Vec<D> of_Q(D d, const float* values) {
  return hn::LoadDup128(d, values);
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

PairMask test(const LeafFrame& frame, const TriangleLeaf& leaf_P, const TriangleLeaf& leaf_Q, float distance,
              TriangleGaps& gaps) {
  LeafTriangles p;
  LeafTriangles q;
  load_base(leaf_P, p);
  load_moved(frame, leaf_Q, q);
  find_normals(p);
  find_normals(q);

  const hn::CappedTag<float, kPairs> d;
  using V = hn::Vec<decltype(d)>;
  PairMask mask = 0;
  for (std::size_t first = 0; first < kPairs; first += hn::Lanes(d)) {
    const auto normal_P = [&](std::size_t axis) HWY_ATTR { return of_P(d, p.normal[axis], first); };
    const auto normal_Q = [&](std::size_t axis) HWY_ATTR { return of_Q(d, q.normal[axis]); };
    const auto corner_P = [&](std::size_t axis, std::size_t c) HWY_ATTR { return of_P(d, p.corner[axis][c], first); };
    const auto corner_Q = [&](std::size_t axis, std::size_t c) HWY_ATTR { return of_Q(d, q.corner[axis][c]); };
    const V along_P = gap_along(d, normal_P, of_P(d, p.low, first), of_P(d, p.high, first), corner_Q);
    const V along_Q = gap_along(d, normal_Q, of_Q(d, q.low), of_Q(d, q.high), corner_P);
    const V gap = hn::Sub(
        hn::Max(hn::Mul(along_P, of_P(d, p.inverse_length, first)), hn::Mul(along_Q, of_Q(d, q.inverse_length))),
        hn::Set(d, frame.uncertainty));
    hn::Store(gap, d, gaps.gap.data() + first);
    std::uint8_t bits[8] = {};  // StoreMaskBits may write so many
    hn::StoreMaskBits(d, hn::Not(hn::Gt(gap, hn::Set(d, distance))), bits);
    mask |= static_cast<PairMask>(bits[0] | bits[1] << 8) << first;
  }

  const hn::FixedTag<std::int32_t, kWidth> d32;
  const auto present = [&](const TriangleLeaf& leaf) HWY_ATTR {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d32, hn::Gt(hn::Load(d32, leaf.triangle.data()), hn::Set(d32, -1)), bits);
    return static_cast<PairMask>(bits[0]);
  };
  // Four bits of Q, for each of P.
  alignas(32) static constexpr std::uint16_t kRowsOfP[16] = {0x0000, 0x000f, 0x00f0, 0x00ff, 0x0f00, 0x0f0f,
                                                             0x0ff0, 0x0fff, 0xf000, 0xf00f, 0xf0f0, 0xf0ff,
                                                             0xff00, 0xff0f, 0xfff0, 0xffff};
  return mask & kRowsOfP[present(leaf_P)] & (0x1111U * present(leaf_Q));
}

LeafKernels make_leaf_kernels() {
  return {test};
}

}  // namespace glissade::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace glissade::collision {

HWY_EXPORT(make_leaf_kernels);

LeafKernels leaf_kernels() {
  return HWY_DYNAMIC_DISPATCH(make_leaf_kernels)();
}

}  // namespace glissade::collision
#endif
