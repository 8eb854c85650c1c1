// Compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "exact/closest_points.cpp"
#include <limits>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <glissade/geometry/triangle_pair.h>

#include "exact/face_corrections.h"

// Every operation is that of triangle_distance.cpp, in the same order and without fused multiply-add, so
// that every rounding is the same. There are the reasons too.
HWY_BEFORE_NAMESPACE();
namespace glissade::geometry::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, kPairsToMeasure>;
using V = hn::Vec<Tag>;
using Mask = hn::Mask<Tag>;

struct Vector3 {
  V x;
  V y;
  V z;
};

HWY_INLINE Vector3 plus(const Vector3& a, const Vector3& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE Vector3 minus(const Vector3& a, const Vector3& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Vector3 negative(const Vector3& a) {
  return {hn::Neg(a.x), hn::Neg(a.y), hn::Neg(a.z)};
}
HWY_INLINE Vector3 times(V s, const Vector3& a) {
  return {hn::Mul(s, a.x), hn::Mul(s, a.y), hn::Mul(s, a.z)};
}
HWY_INLINE Vector3 cross(const Vector3& a, const Vector3& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}
HWY_INLINE V dot(const Vector3& a, const Vector3& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
HWY_INLINE V sum_of_sizes(const Vector3& a) {
  return hn::Add(hn::Add(hn::Abs(a.x), hn::Abs(a.y)), hn::Abs(a.z));
}
HWY_INLINE V clamp_to_unit(V parameter) {
  const Tag d;
  return hn::IfThenElseZero(hn::Gt(parameter, hn::Zero(d)), hn::Min(parameter, hn::Set(d, 1.0)));
}

struct Face {
  Vector3 corners[3];
  Vector3 edges[3];
  V squared_lengths[3];
  Vector3 normal;
  V squared_normal;
};

HWY_INLINE Face load(const TrianglesOfPairs& corners, std::size_t first) {
  const Tag d;
  Face face;
  for (std::size_t c = 0; c < 3; ++c) {
    face.corners[c] = {hn::Load(d, corners[c][0].data() + first), hn::Load(d, corners[c][1].data() + first),
                       hn::Load(d, corners[c][2].data() + first)};
  }
  for (std::size_t c = 0; c < 3; ++c) {
    face.edges[c] = minus(face.corners[(c + 1) % 3], face.corners[c]);
    face.squared_lengths[c] = dot(face.edges[c], face.edges[c]);
  }
  face.normal = cross(face.edges[0], face.edges[1]);
  face.squared_normal = dot(face.normal, face.normal);
  return face;
}

HWY_INLINE V slab_uncertainty(const Face& a, const Face& b) {
  V reach = hn::Add(sum_of_sizes(minus(b.corners[0], a.corners[0])), sum_of_sizes(a.edges[0]));
  reach = hn::Add(reach, sum_of_sizes(a.edges[2]));
  reach = hn::Add(reach, sum_of_sizes(b.edges[0]));
  reach = hn::Add(reach, sum_of_sizes(b.edges[2]));
  return hn::Mul(hn::Mul(hn::Set(Tag(), 16.0 * std::numeric_limits<double>::epsilon()), reach), reach);
}

HWY_INLINE void face_coordinates(const Face& face, const Vector3& vector, V& u, V& v) {
  const Vector3 turned = cross(vector, face.normal);
  u = hn::Div(dot(face.edges[2], turned), face.squared_normal);
  v = hn::Div(dot(face.edges[0], turned), face.squared_normal);
}

HWY_INLINE Vector3 gap_at(const Vector3& offset, const Face& face, V u, V v) {
  return minus(plus(offset, times(u, face.edges[0])), times(v, face.edges[2]));
}

// The pairs as many as fit into a vector.
class Measurement {
 public:
  HWY_INLINE Measurement(const TrianglesToMeasure& triangles, std::size_t first)
      : a_(load(triangles.a, first)),
        b_(load(triangles.b, first)),
        uncertainty_(slab_uncertainty(a_, b_)),
        open_(hn::FirstN(Tag(), hn::Lanes(Tag()))),
        p_a_(a_.corners[0]),
        p_b_(b_.corners[0]),
        squared_distance_(hn::Inf(Tag())) {}

  HWY_INLINE void run() {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        try_edges(i, j);
        if (hn::AllFalse(Tag(), open_)) return;
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      Mask inside;
      const Vector3 a_to_b = gap_to_face(a_.corners[i], b_, inside);
      keep_closer(inside, a_.corners[i], plus(a_.corners[i], a_to_b), a_to_b);
      const Vector3 b_to_a = gap_to_face(b_.corners[i], a_, inside);
      keep_closer(inside, plus(b_.corners[i], b_to_a), b_.corners[i], b_to_a);
    }
  }

  HWY_INLINE void store(ClosestPoints& closest, std::size_t first) const {
    hn::Store(squared_distance_, Tag(), closest.squared_distance.data() + first);
    hn::Store(hn::IfThenElseZero(are_apart(), hn::Set(Tag(), 1.0)), Tag(), closest.is_apart.data() + first);
    store(p_a_, closest.p_a, first);
    store(p_b_, closest.p_b, first);
  }

 private:
  HWY_INLINE static void store(const Vector3& from, VectorsOfPairs& to, std::size_t first) {
    hn::Store(from.x, Tag(), to[0].data() + first);
    hn::Store(from.y, Tag(), to[1].data() + first);
    hn::Store(from.z, Tag(), to[2].data() + first);
  }

  // Whether the direction from point to point separates the triangles. The points need not be the closest ones; they
  // lie within the reach that the uncertainty is about. Differences of corners and points, the direction and the
  // products are rounded by less than 8 units of the reach's square in all, the uncertainty is 16, and half of a
  // distance squared of more than 4 times the uncertainty must be left.
  HWY_INLINE Mask are_apart() const {
    const Tag d;
    const Vector3 n = minus(p_b_, p_a_);
    V highest = hn::Zero(d);
    V lowest = hn::Zero(d);
    for (std::size_t c = 0; c < 3; ++c) {
      highest = hn::Max(highest, dot(n, minus(a_.corners[c], p_a_)));
      lowest = hn::Min(lowest, dot(n, minus(b_.corners[c], p_b_)));
    }
    const V between = dot(n, n);
    return hn::And(hn::Gt(between, hn::Mul(hn::Set(d, 4.0), uncertainty_)),
                   hn::Lt(hn::Sub(highest, lowest), hn::Mul(hn::Set(d, 0.5), between)));
  }

  HWY_INLINE void try_edges(std::size_t i, std::size_t j) {
    const Tag d;
    const Vector3& along_a = a_.edges[i];
    const Vector3& along_b = b_.edges[j];
    const Vector3 offset = minus(b_.corners[j], a_.corners[i]);
    const Vector3 normal = cross(along_a, along_b);
    const V squared_normal = dot(normal, normal);
    const V on_lines = hn::IfThenElseZero(hn::Gt(squared_normal, hn::Zero(d)),
                                          hn::Div(dot(cross(offset, along_b), normal), squared_normal));
    const V start = clamp_to_unit(on_lines);
    const V t = clamp_to_unit(hn::Div(dot(minus(times(start, along_a), offset), along_b), b_.squared_lengths[j]));
    const V s = clamp_to_unit(hn::Div(dot(plus(offset, times(t, along_b)), along_a), a_.squared_lengths[i]));
    const Vector3 gap = minus(plus(offset, times(t, along_b)), times(s, along_a));
    keep_closer(open_, plus(a_.corners[i], times(s, along_a)), plus(b_.corners[j], times(t, along_b)), gap);
    const Vector3 to_corner_a = minus(negative(a_.edges[(i + 2) % 3]), times(s, along_a));
    const Vector3 to_corner_b = minus(negative(b_.edges[(j + 2) % 3]), times(t, along_b));
    const Mask are_closest =
        hn::And(hn::Lt(dot(to_corner_a, gap), hn::Neg(uncertainty_)), hn::Gt(dot(to_corner_b, gap), uncertainty_));
    open_ = hn::AndNot(are_closest, open_);
  }

  HWY_INLINE static Vector3 gap_to_face(const Vector3& point, const Face& face, Mask& inside) {
    const Tag d;
    const Vector3 offset = minus(face.corners[0], point);
    V u;
    V v;
    face_coordinates(face, negative(offset), u, v);
    for (int i = 0; i < kFaceCorrections; ++i) {
      V more_u;
      V more_v;
      face_coordinates(face, negative(gap_at(offset, face, u, v)), more_u, more_v);
      u = hn::Add(u, more_u);
      v = hn::Add(v, more_v);
    }
    inside = hn::And(hn::And(hn::Ge(u, hn::Zero(d)), hn::Ge(v, hn::Zero(d))), hn::Le(hn::Add(u, v), hn::Set(d, 1.0)));
    return gap_at(offset, face, u, v);
  }

  HWY_INLINE void keep_closer(Mask candidates, const Vector3& p_a, const Vector3& p_b, const Vector3& gap) {
    const V squared_distance = dot(gap, gap);
    const Mask closer = hn::And(hn::And(open_, candidates), hn::Lt(squared_distance, squared_distance_));
    squared_distance_ = hn::IfThenElse(closer, squared_distance, squared_distance_);
    p_a_ = chosen(closer, p_a, p_a_);
    p_b_ = chosen(closer, p_b, p_b_);
  }

  HWY_INLINE static Vector3 chosen(Mask first, const Vector3& a, const Vector3& b) {
    return {hn::IfThenElse(first, a.x, b.x), hn::IfThenElse(first, a.y, b.y), hn::IfThenElse(first, a.z, b.z)};
  }

  Face a_;
  Face b_;
  V uncertainty_;
  Mask open_;  // pairs for which closer points may still be found
  Vector3 p_a_;
  Vector3 p_b_;
  V squared_distance_;
};

}  // namespace

void find_closest_points(const TrianglesToMeasure& triangles, ClosestPoints& closest) {
  for (std::size_t first = 0; first < kPairsToMeasure; first += hn::Lanes(Tag())) {
    Measurement measurement(triangles, first);
    measurement.run();
    measurement.store(closest, first);
  }
}

}  // namespace glissade::geometry::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace glissade::geometry {
namespace {

HWY_EXPORT(find_closest_points);

}  // namespace

void find_closest_points(const TrianglesToMeasure& triangles, ClosestPoints& closest) {
  HWY_DYNAMIC_DISPATCH(find_closest_points)(triangles, closest);
}

}  // namespace glissade::geometry
#endif
