// Compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/leaf_kernels.cpp"
#include "kernels/leaf_kernels.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "kernels/leaf_crossing-inl.h"
#include "kernels/leaf_edges-inl.h"
#include "kernels/pair_lanes-inl.h"

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
  for (std::size_t axis = 0; axis < 3; ++axis) {
    u[axis] = hn::Sub(corner(t, axis, 1), corner(t, axis, 0));
    v[axis] = hn::Sub(corner(t, axis, 2), corner(t, axis, 0));
  }
  const auto square_of = [](const Four(&e)[3]) HWY_ATTR {
    return hn::Add(hn::Mul(e[0], e[0]), hn::Add(hn::Mul(e[1], e[1]), hn::Mul(e[2], e[2])));
  };
  const Four longer = hn::Sqrt(hn::Max(square_of(u), square_of(v)));
  hn::Store(hn::Mul(longer, hn::Set(d, 1.000001F)), d, t.extent.data());
  Four n[3];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t y = (axis + 1) % 3;
    const std::size_t z = (axis + 2) % 3;
    n[axis] = hn::Sub(hn::Mul(u[y], v[z]), hn::Mul(u[z], v[y]));
  }
  const Four square = square_of(n);
  // Any vector is a valid separating axis. Gaps along it are taken for distances, so its inverse length is rounded
  // down. If the square underflows, the inverse length is 0, and nothing is separated.
  const auto usable = hn::Ge(square, hn::Set(d, 1e-36F));
  hn::Store(hn::IfThenElseZero(usable, hn::Div(hn::Set(d, 0.999999F), hn::Sqrt(square))), d, t.inverse_length.data());
  for (std::size_t axis = 0; axis < 3; ++axis)
    hn::Store(n[axis], d, t.normal[axis].data());
  const auto project = [&](std::size_t c) HWY_ATTR {
    return hn::Add(hn::Mul(n[0], corner(t, 0, c)),
                   hn::Add(hn::Mul(n[1], corner(t, 1, c)), hn::Mul(n[2], corner(t, 2, c))));
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

void prepare_M(const TriangleLeaf& leaf_M, LeafPair& leaves) {
  const Tag4 d;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t c = 0; c < 3; ++c)
      hn::Store(hn::Load(d, leaf_M.corner[axis][c].data()), d, leaves.p.corner[axis][c].data());
  }
  find_normals(leaves.p);
  // The row of four pairs for each triangle in the mask.
  alignas(32) static constexpr std::uint16_t kRows[16] = {0x0000, 0x000f, 0x00f0, 0x00ff, 0x0f00, 0x0f0f,
                                                          0x0ff0, 0x0fff, 0xf000, 0xf00f, 0xf0f0, 0xf0ff,
                                                          0xff00, 0xff0f, 0xfff0, 0xffff};
  leaves.present_M = kRows[present(leaf_M)];
}

void prepare_N(const LeafFrame& frame, const TriangleLeaf& leaf_N, LeafPair& leaves) {
  const Tag4 d;
  for (std::size_t c = 0; c < 3; ++c) {
    const Four x = hn::Load(d, leaf_N.corner[0][c].data());
    const Four y = hn::Load(d, leaf_N.corner[1][c].data());
    const Four z = hn::Load(d, leaf_N.corner[2][c].data());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto& row = frame.matrix[axis];
      const Four moved = hn::Add(hn::Mul(x, hn::Set(d, row[0])),
                                 hn::Add(hn::Mul(y, hn::Set(d, row[1])),
                                         hn::Add(hn::Mul(z, hn::Set(d, row[2])), hn::Set(d, frame.p_MN[axis]))));
      hn::Store(moved, d, leaves.q.corner[axis][c].data());
    }
  }
  find_normals(leaves.q);
  leaves.present_N = 0x1111U * present(leaf_N);
}

// Values of four triangles of M and four of N, as many as fit into a vector.
template <class D>
HWY_INLINE hn::Vec<D> of_both(D d, const float* values_M, const float* values_N, std::size_t first) {
  if constexpr (hn::MaxLanes(D()) == kWidth) {
    return hn::Load(d, first == 0 ? values_M : values_N);
  } else {
    return hn::Combine(d, hn::Load(Tag4(), values_N), hn::Load(Tag4(), values_M));
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
          const V at = hn::Add(hn::Mul(normal[0], coordinate(0)),
                               hn::Add(hn::Mul(normal[1], coordinate(1)), hn::Mul(normal[2], coordinate(2))));
          low = c + t == 0 ? at : hn::Min(low, at);
          high = c + t == 0 ? at : hn::Max(high, at);
        }
      }
    };
    V low_M;
    V high_M;
    V low_N;
    V high_N;
    project(leaves.p, low_M, high_M);
    project(leaves.q, low_N, high_N);
    const V gap = hn::Max(hn::Sub(low_M, high_N), hn::Sub(low_N, high_M));
    const V inverse_length = of_both(d, leaves.p.inverse_length.data(), leaves.q.inverse_length.data(), first);
    most = hn::Max(most, hn::Mul(gap, inverse_length));
  }
  return hn::GetLane(hn::MaxOfLanes(d, most)) - frame.uncertainty;
}

// Gap of three corners beyond the interval [low, high] along a normal, on either side of it.
template <class D, class Normal, class Corner>
HWY_INLINE hn::Vec<D> gap_along(D, const Normal& n, hn::Vec<D> low, hn::Vec<D> high, const Corner& corner_of) {
  const auto project = [&](std::size_t c) HWY_ATTR {
    return hn::Add(hn::Mul(n(0), corner_of(0, c)),
                   hn::Add(hn::Mul(n(1), corner_of(1, c)), hn::Mul(n(2), corner_of(2, c))));
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
  PairMask by_N = 0;
  for (std::size_t first = 0; first < kPairs; first += hn::Lanes(d)) {
    const auto normal_M = [&](std::size_t axis) HWY_ATTR { return of_M(d, p.normal[axis].data(), first); };
    const auto normal_N = [&](std::size_t axis) HWY_ATTR { return of_N(d, q.normal[axis].data()); };
    const auto corner_M = [&](std::size_t axis, std::size_t c)
                              HWY_ATTR { return of_M(d, p.corner[axis][c].data(), first); };
    const auto corner_N = [&](std::size_t axis, std::size_t c) HWY_ATTR { return of_N(d, q.corner[axis][c].data()); };
    const V along_M =
        hn::Mul(gap_along(d, normal_M, of_M(d, p.low.data(), first), of_M(d, p.high.data(), first), corner_N),
                of_M(d, p.inverse_length.data(), first));
    const V along_N = hn::Mul(gap_along(d, normal_N, of_N(d, q.low.data()), of_N(d, q.high.data()), corner_M),
                              of_N(d, q.inverse_length.data()));
    const V gap = hn::Sub(hn::Max(along_M, along_N), hn::Set(d, frame.uncertainty));
    hn::Store(gap, d, leaves.gaps.gap.data() + first);
    mask |= bits_of(d, hn::Not(hn::Gt(gap, hn::Set(d, distance)))) << first;
    by_N |= bits_of(d, hn::Gt(along_N, along_M)) << first;
  }
  leaves.by_N = by_N;
  return mask & leaves.present();
}

void along(const LeafFrame& frame, const std::array<float, 3>& direction, LeafPair& leaves) {
  const Tag4 d4;
  struct alignas(16) Extents {
    float low[kWidth];
    float high[kWidth];
  };
  const auto project = [&](const LeafTriangles& t) HWY_ATTR {
    Four at[3];
    for (std::size_t c = 0; c < 3; ++c) {
      at[c] = hn::Add(hn::Mul(hn::Set(d4, direction[0]), corner(t, 0, c)),
                      hn::Add(hn::Mul(hn::Set(d4, direction[1]), corner(t, 1, c)),
                              hn::Mul(hn::Set(d4, direction[2]), corner(t, 2, c))));
    }
    Extents extents;
    hn::Store(hn::Min(at[0], hn::Min(at[1], at[2])), d4, extents.low);
    hn::Store(hn::Max(at[0], hn::Max(at[1], at[2])), d4, extents.high);
    return extents;
  };
  const Extents p = project(leaves.p);
  const Extents q = project(leaves.q);
  const hn::CappedTag<float, kPairs> d;
  for (std::size_t first = 0; first < kPairs; first += hn::Lanes(d)) {
    const auto gap =
        hn::Max(hn::Sub(of_M(d, p.low, first), of_N(d, q.high)), hn::Sub(of_N(d, q.low), of_M(d, p.high, first)));
    // The direction may be longer than 1 by its rounding.
    const auto certain = hn::Sub(hn::Mul(gap, hn::Set(d, 0.999999F)), hn::Set(d, frame.uncertainty));
    float* const gaps = leaves.gaps.gap.data() + first;
    hn::Store(hn::Max(certain, hn::Load(d, gaps)), d, gaps);
  }
}

// Ignores the gaps of all other pairs.
float least_gap(const LeafPair& leaves, PairMask pairs) {
  const hn::CappedTag<float, kPairs> d;
  auto least = hn::Set(d, 1e30F);
  for (std::size_t first = 0; first < kPairs; first += hn::Lanes(d)) {
    const auto gap = hn::Load(d, leaves.gaps.gap.data() + first);
    least = hn::Min(least, hn::IfThenElse(mask_of(d, pairs >> first), gap, least));
  }
  return hn::GetLane(hn::MinOfLanes(d, least));
}

const LeafKernels& leaf_kernels_of_target() {
  static constexpr LeafKernels kKernels = {
      prepare_M, prepare_N, leaf_gap, test, along, cross, edges, edges_and_directions, least_gap};
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
