// Compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "features/corner_kernel.cpp"
#include "features/corner_kernel.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// Every operation is that of geometry/triangle_pair.h, in the same order and without fused multiply-add, so that
// every rounding is the same.
HWY_BEFORE_NAMESPACE();
namespace glissade::contact::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using Double = hn::CappedTag<double, kCornersAtOnce>;
using Doubles = hn::Vec<Double>;

struct Point {
  Doubles x;
  Doubles y;
  Doubles z;
};

HWY_INLINE Point minus(const Point& a, const Point& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Point times(const Point& a, Doubles s) {
  return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)};
}
HWY_INLINE Point cross(const Point& a, const Point& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}
HWY_INLINE Doubles dot(const Point& a, const Point& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
HWY_INLINE Doubles norm(const Point& a) {
  return hn::Sqrt(dot(a, a));
}
HWY_INLINE Point chosen(hn::Mask<Double> first, const Point& a, const Point& b) {
  return {hn::IfThenElse(first, a.x, b.x), hn::IfThenElse(first, a.y, b.y), hn::IfThenElse(first, a.z, b.z)};
}

HWY_INLINE Point load(const VectorsOfCorners& from, std::size_t first) {
  const Double d;
  return {hn::Load(d, from[0].data() + first), hn::Load(d, from[1].data() + first),
          hn::Load(d, from[2].data() + first)};
}
HWY_INLINE void store(const Point& from, VectorsOfCorners& to, std::size_t first) {
  const Double d;
  hn::Store(from.x, d, to[0].data() + first);
  hn::Store(from.y, d, to[1].data() + first);
  hn::Store(from.z, d, to[2].data() + first);
}
HWY_INLINE hn::Mask<Double> flags(const NumbersOfCorners& from, std::size_t first) {
  const Double d;
  return hn::Gt(hn::Load(d, from.data() + first), hn::Zero(d));
}

HWY_INLINE void find_some(const CornersOverTriangles& corners, std::size_t first, CornersOverFaces& over) {
  const Double d;
  const Point x = load(corners.x, first);
  Point t[3];
  for (std::size_t c = 0; c < 3; ++c)
    t[c] = load(corners.triangle[c], first);
  const Point normal = cross(minus(t[1], t[0]), minus(t[2], t[0]));
  hn::Mask<Double> is_inside = hn::FirstN(d, hn::Lanes(d));
  for (std::size_t c = 0; c < 3; ++c) {
    const Doubles side = dot(cross(normal, minus(t[(c + 1) % 3], t[c])), minus(x, t[c]));
    is_inside = hn::And(is_inside, hn::Ge(side, hn::Zero(d)));
  }
  const Point point = minus(x, times(normal, hn::Div(dot(normal, minus(x, t[0])), dot(normal, normal))));
  const Point n = chosen(flags(corners.is_of_obstacle, first), minus(point, x), minus(x, point));
  const Doubles gap = norm(n);
  Doubles to_rims = hn::Inf(d);
  for (std::size_t c = 0; c < 3; ++c) {
    const Point along = minus(t[(c + 1) % 3], t[c]);
    const Doubles distance = hn::Div(norm(cross(along, minus(point, t[c]))), norm(along));
    const auto is_nearer = hn::And(flags(corners.is_rim[c], first), hn::Lt(distance, to_rims));
    to_rims = hn::IfThenElse(is_nearer, distance, to_rims);
  }
  hn::Store(hn::IfThenElseZero(is_inside, hn::Set(d, 1.0)), d, over.is_inside.data() + first);
  store(point, over.point, first);
  hn::Store(gap, d, over.gap.data() + first);
  store({hn::Div(n.x, gap), hn::Div(n.y, gap), hn::Div(n.z, gap)}, over.n, first);
  hn::Store(to_rims, d, over.to_rims.data() + first);
}

}  // namespace

void find_corners_over_faces(const CornersOverTriangles& corners, CornersOverFaces& over) {
  for (std::size_t first = 0; first < kCornersAtOnce; first += hn::Lanes(Double()))
    find_some(corners, first, over);
}

}  // namespace glissade::contact::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace glissade::contact {
namespace {

HWY_EXPORT(find_corners_over_faces);

}  // namespace

void find_corners_over_faces(const CornersOverTriangles& corners, CornersOverFaces& over) {
  HWY_DYNAMIC_DISPATCH(find_corners_over_faces)(corners, over);
}

}  // namespace glissade::contact
#endif
