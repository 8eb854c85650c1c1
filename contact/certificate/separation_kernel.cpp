// Compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "certificate/separation_kernel.cpp"
#include "certificate/separation_kernel.h"

#include <limits>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// Without fused multiply-add and with the same order of operations, so that every rounding is the same.
HWY_BEFORE_NAMESPACE();
namespace glissade::contact::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using geometry::TrianglesOfPairs;
using geometry::VectorsOfPairs;

using PairTag = hn::CappedTag<double, geometry::kPairsToMeasure>;
using PairNumbers = hn::Vec<PairTag>;

/// Triangles that come nearer by less than this fraction of the gap on a path hardly come nearer.
constexpr double kAlmostStill = 0.05;

struct PairVectors {
  PairNumbers x;
  PairNumbers y;
  PairNumbers z;
};

HWY_INLINE PairVectors plus(const PairVectors& a, const PairVectors& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE PairVectors minus(const PairVectors& a, const PairVectors& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE PairVectors times(PairNumbers s, const PairVectors& a) {
  return {hn::Mul(s, a.x), hn::Mul(s, a.y), hn::Mul(s, a.z)};
}
HWY_INLINE PairVectors cross(const PairVectors& a, const PairVectors& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}
HWY_INLINE PairNumbers dot(const PairVectors& a, const PairVectors& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
HWY_INLINE PairVectors turned_if(hn::Mask<PairTag> is_turned, const PairVectors& a) {
  return {hn::IfThenElse(is_turned, hn::Neg(a.x), a.x), hn::IfThenElse(is_turned, hn::Neg(a.y), a.y),
          hn::IfThenElse(is_turned, hn::Neg(a.z), a.z)};
}
/// Zero stays zero.
HWY_INLINE PairVectors normalized(const PairVectors& a) {
  const PairTag d;
  const PairNumbers length = hn::Sqrt(dot(a, a));
  const auto has_length = hn::Gt(length, hn::Zero(d));
  return times(hn::IfThenElseZero(has_length, hn::Div(hn::Set(d, 1.0), length)), a);
}

HWY_INLINE PairVectors load(const VectorsOfPairs& from, std::size_t first) {
  const PairTag d;
  return {hn::Load(d, from[0].data() + first), hn::Load(d, from[1].data() + first),
          hn::Load(d, from[2].data() + first)};
}
HWY_INLINE void store(const PairVectors& from, VectorsOfPairs& to, std::size_t first) {
  const PairTag d;
  hn::Store(from.x, d, to[0].data() + first);
  hn::Store(from.y, d, to[1].data() + first);
  hn::Store(from.z, d, to[2].data() + first);
}

struct PairTriangles {
  PairVectors corner[3];
};
struct TrianglesThen {
  PairTriangles obstacle;
  PairTriangles part;
};

HWY_INLINE PairTriangles load(const TrianglesOfPairs& from, std::size_t first) {
  return {{load(from[0], first), load(from[1], first), load(from[2], first)}};
}
HWY_INLINE void store(const PairTriangles& from, TrianglesOfPairs& to, std::size_t first) {
  for (std::size_t c = 0; c < 3; ++c)
    store(from.corner[c], to[c], first);
}
HWY_INLINE PairVectors sum_of_corners(const PairTriangles& t) {
  return plus(plus(t.corner[0], t.corner[1]), t.corner[2]);
}
HWY_INLINE PairVectors normal_of(const PairTriangles& t) {
  return normalized(cross(minus(t.corner[1], t.corner[0]), minus(t.corner[2], t.corner[0])));
}

HWY_INLINE PairTriangles mapped(const CornerMap& map, const PairTriangles& t) {
  const PairTag d;
  PairTriangles to;
  const auto row = [&](Eigen::Index r, const PairVectors& x) HWY_ATTR {
    const PairVectors of_row{hn::Set(d, map.A(r, 0)), hn::Set(d, map.A(r, 1)), hn::Set(d, map.A(r, 2))};
    return hn::Add(dot(of_row, x), hn::Set(d, map.t[r]));
  };
  for (std::size_t c = 0; c < 3; ++c)
    to.corner[c] = {row(0, t.corner[c]), row(1, t.corner[c]), row(2, t.corner[c])};
  return to;
}

struct Heights {
  PairNumbers bottom;
  PairNumbers top;
};
HWY_INLINE Heights range_of(PairNumbers h0, PairNumbers h1, PairNumbers h2) {
  return {hn::Min(h0, hn::Min(h1, h2)), hn::Max(h0, hn::Max(h1, h2))};
}
HWY_INLINE Heights heights(const PairVectors& n, const PairTriangles& t) {
  return range_of(dot(n, t.corner[0]), dot(n, t.corner[1]), dot(n, t.corner[2]));
}

/// How far a direction separates the triangles at both ends of a path, and for how many such paths.
struct Lasting {
  PairNumbers begin;
  PairNumbers end;
  PairNumbers paths;
};

/// Keeps the best of the directions that it is shown, for as many pairs as fit into a vector.
class Separator {
 public:
  HWY_INLINE Separator(const TrianglesThen& begin, const TrianglesThen& end, const PairVectors& motion,
                       const PathOfPart& path, const PairsOnPath& pairs, std::size_t first)
      : begin_(begin), end_(end), motion_(motion), path_(path) {
    const PairTag d;
    may_turn_ = hn::Gt(hn::Load(d, pairs.may_turn_with_part.data() + first), hn::Zero(d));
    n_ = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    turns_ = hn::Zero(d);
    best_ = {hn::Zero(d), hn::Set(d, -std::numeric_limits<double>::infinity()),
             hn::Set(d, -std::numeric_limits<double>::infinity())};
    is_open_ = hn::FirstN(d, hn::Lanes(d));
  }

  /// Goes on where another one ended, for pairs that have fewer than `enough` paths.
  HWY_INLINE void resume(const PairsOnPath& pairs, std::size_t first, double enough) {
    const PairTag d;
    n_ = load(pairs.n, first);
    turns_ = hn::Load(d, pairs.turns_with_part.data() + first);
    best_ = {hn::Load(d, pairs.gap_at_begin.data() + first), hn::Load(d, pairs.gap_at_end.data() + first),
             hn::Load(d, pairs.paths.data() + first)};
    is_open_ = hn::Lt(best_.paths, hn::Set(d, enough));
  }

  HWY_INLINE void look(const PairVectors& n) {
    look_along(normalized(minus(n, times(dot(n, motion_), motion_))));
    look_along(normalized(n));
  }

  HWY_INLINE void store_to(PairsOnPath& pairs, std::size_t first) const {
    const PairTag d;
    store(n_, pairs.n, first);
    hn::Store(best_.begin, d, pairs.gap_at_begin.data() + first);
    hn::Store(best_.end, d, pairs.gap_at_end.data() + first);
    hn::Store(best_.paths, d, pairs.paths.data() + first);
    hn::Store(turns_, d, pairs.turns_with_part.data() + first);
  }

 private:
  HWY_INLINE static PairNumbers gap_along(const PairVectors& n, const TrianglesThen& then) {
    return hn::Sub(heights(n, then.part).bottom, heights(n, then.obstacle).top);
  }

  HWY_INLINE static Lasting lasting(PairNumbers begin, PairNumbers end, double gap) {
    const PairTag d;
    const PairNumbers more = hn::Sub(hn::Min(begin, end), hn::Set(d, gap));
    const PairNumbers nearer = hn::Max(hn::Sub(begin, end), hn::Set(d, kAlmostStill * gap));
    return {begin, end, hn::IfThenElse(hn::Lt(more, hn::Zero(d)), more, hn::Div(more, nearer))};
  }

  /// The direction or its opposite, whichever separates the triangles farther at the beginning.
  HWY_INLINE void look_along(const PairVectors& either) {
    const PairTag d;
    const Heights obstacle = heights(either, begin_.obstacle);
    const Heights part = heights(either, begin_.part);
    const PairNumbers along = hn::Sub(part.bottom, obstacle.top);
    const PairNumbers opposite = hn::Sub(obstacle.bottom, part.top);
    const auto is_opposite = hn::Lt(along, opposite);
    const PairNumbers begin = hn::IfThenElse(is_opposite, opposite, along);
    const PairVectors n = turned_if(is_opposite, either);
    keep_if_better(n, lasting(begin, gap_along(n, end_), path_.gap), hn::Zero(d), is_open_);
    if (!path_.turns) return;
    const auto row = [&](Eigen::Index r) HWY_ATTR {
      return dot({hn::Set(d, path_.turn(r, 0)), hn::Set(d, path_.turn(r, 1)), hn::Set(d, path_.turn(r, 2))}, n);
    };
    const PairVectors n_end{row(0), row(1), row(2)};
    keep_if_better(n, lasting(begin, gap_along(n_end, end_), path_.gap_turning), hn::Set(d, 1.0),
                   hn::And(is_open_, may_turn_));
  }

  HWY_INLINE void keep_if_better(const PairVectors& n, const Lasting& found, PairNumbers turns,
                                 hn::Mask<PairTag> is_allowed) {
    const auto is_better = hn::And(is_allowed, hn::Gt(found.paths, best_.paths));
    n_ = {hn::IfThenElse(is_better, n.x, n_.x), hn::IfThenElse(is_better, n.y, n_.y),
          hn::IfThenElse(is_better, n.z, n_.z)};
    best_ = {hn::IfThenElse(is_better, found.begin, best_.begin), hn::IfThenElse(is_better, found.end, best_.end),
             hn::IfThenElse(is_better, found.paths, best_.paths)};
    turns_ = hn::IfThenElse(is_better, turns, turns_);
  }

  const TrianglesThen& begin_;
  const TrianglesThen& end_;
  const PairVectors& motion_;
  const PathOfPart& path_;
  hn::Mask<PairTag> may_turn_;
  PairVectors n_;
  PairNumbers turns_;
  Lasting best_;
  hn::Mask<PairTag> is_open_;  // pairs that may get another direction
};

HWY_INLINE void separate_some_by_normals(const geometry::TrianglesToMeasure& triangles, const PathOfPart& path,
                                         std::size_t first, PairsOnPath& pairs) {
  const PairTag d;
  const PairTriangles part = load(triangles.b, first);
  const PairTriangles obstacle = load(triangles.a, first);
  const TrianglesThen begin{obstacle, mapped(path.begin, part)};
  const TrianglesThen end{obstacle, mapped(path.end, part)};
  const PairVectors motion = normalized(minus(sum_of_corners(end.part), sum_of_corners(begin.part)));
  const PairVectors of_obstacle = normal_of(obstacle);
  PairVectors of_part = normal_of(begin.part);
  of_part = turned_if(hn::Lt(dot(of_part, of_obstacle), hn::Zero(d)), of_part);
  Separator separator(begin, end, motion, path, pairs, first);
  separator.look(plus(of_obstacle, of_part));
  separator.look(of_obstacle);
  separator.look(of_part);
  store(obstacle, pairs.begin.a, first);
  store(begin.part, pairs.begin.b, first);
  store(obstacle, pairs.end.a, first);
  store(end.part, pairs.end.b, first);
  store(motion, pairs.motion, first);
  separator.store_to(pairs, first);
  hn::Store(hn::Set(d, -std::numeric_limits<double>::infinity()), d, pairs.turning.data() + first);
}

/// Twice the height of a corner along the mean direction, which the product of two linear functions has halfway besides
/// the mean of its ends.
HWY_INLINE PairNumbers mixed_height(const PairVectors& n_begin, const PairVectors& n_end, const PairVectors& x_begin,
                                    const PairVectors& x_end) {
  return hn::Add(dot(n_begin, x_end), dot(n_end, x_begin));
}

HWY_INLINE void separate_some_by_turning(const geometry::ClosestPoints& begin, const geometry::ClosestPoints& end,
                                         std::size_t first, PairsOnPath& pairs) {
  const PairTag d;
  const PairTriangles obstacle = load(pairs.begin.a, first);
  const PairTriangles part_at_begin = load(pairs.begin.b, first);
  const PairTriangles part_at_end = load(pairs.end.b, first);
  const PairVectors n_begin = normalized(minus(load(begin.p_b, first), load(begin.p_a, first)));
  const PairVectors n_end = normalized(minus(load(end.p_b, first), load(end.p_a, first)));
  const PairNumbers at_begin = hn::Sub(heights(n_begin, part_at_begin).bottom, heights(n_begin, obstacle).top);
  const PairNumbers at_end = hn::Sub(heights(n_end, part_at_end).bottom, heights(n_end, obstacle).top);
  PairNumbers mixed[3];
  for (std::size_t c = 0; c < 3; ++c)
    mixed[c] = mixed_height(n_begin, n_end, part_at_begin.corner[c], part_at_end.corner[c]);
  const PairNumbers bottom = range_of(mixed[0], mixed[1], mixed[2]).bottom;
  const PairNumbers between = hn::Mul(hn::Set(d, 0.5), hn::Sub(bottom, heights(plus(n_begin, n_end), obstacle).top));
  const auto is_sought = hn::Lt(hn::Load(d, pairs.paths.data() + first), hn::Zero(d));
  const PairNumbers least = hn::Min(between, hn::Min(at_begin, at_end));
  hn::Store(hn::IfThenElse(is_sought, least, hn::Load(d, pairs.turning.data() + first)), d,
            pairs.turning.data() + first);
}

}  // namespace

void separate_by_normals(const geometry::TrianglesToMeasure& triangles, const PathOfPart& path, PairsOnPath& pairs) {
  for (std::size_t first = 0; first < geometry::kPairsToMeasure; first += hn::Lanes(PairTag()))
    separate_some_by_normals(triangles, path, first, pairs);
}

void separate_by_points(const geometry::ClosestPoints& points, const PathOfPart& path, double enough,
                        PairsOnPath& pairs) {
  for (std::size_t first = 0; first < geometry::kPairsToMeasure; first += hn::Lanes(PairTag())) {
    const TrianglesThen begin{load(pairs.begin.a, first), load(pairs.begin.b, first)};
    const TrianglesThen end{load(pairs.end.a, first), load(pairs.end.b, first)};
    const PairVectors motion = load(pairs.motion, first);
    Separator separator(begin, end, motion, path, pairs, first);
    separator.resume(pairs, first, enough);
    separator.look(minus(load(points.p_b, first), load(points.p_a, first)));
    separator.store_to(pairs, first);
  }
}

void separate_by_turning(const geometry::ClosestPoints& begin, const geometry::ClosestPoints& end, PairsOnPath& pairs) {
  for (std::size_t first = 0; first < geometry::kPairsToMeasure; first += hn::Lanes(PairTag()))
    separate_some_by_turning(begin, end, first, pairs);
}

}  // namespace glissade::contact::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace glissade::contact {
namespace {

HWY_EXPORT(separate_by_normals);
HWY_EXPORT(separate_by_points);
HWY_EXPORT(separate_by_turning);

}  // namespace

void separate_by_normals(const geometry::TrianglesToMeasure& triangles, const PathOfPart& path, PairsOnPath& pairs) {
  HWY_DYNAMIC_DISPATCH(separate_by_normals)(triangles, path, pairs);
}

void separate_by_points(const geometry::ClosestPoints& points, const PathOfPart& path, double enough,
                        PairsOnPath& pairs) {
  HWY_DYNAMIC_DISPATCH(separate_by_points)(points, path, enough, pairs);
}

void separate_by_turning(const geometry::ClosestPoints& begin, const geometry::ClosestPoints& end, PairsOnPath& pairs) {
  HWY_DYNAMIC_DISPATCH(separate_by_turning)(begin, end, pairs);
}

}  // namespace glissade::contact
#endif
