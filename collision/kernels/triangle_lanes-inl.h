// Vectors in space whose components have a lane for each triangle pair. Compiled once for each instruction set.
#if defined(GLISSADE_COLLISION_TRIANGLE_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GLISSADE_COLLISION_TRIANGLE_LANES_INL_H_
#undef GLISSADE_COLLISION_TRIANGLE_LANES_INL_H_
#else
#define GLISSADE_COLLISION_TRIANGLE_LANES_INL_H_
#endif

#include <cstddef>

#include <hwy/highway.h>

#include "kernels/leaf_pair.h"
#include "kernels/pair_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace glissade::collision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

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
    p[c] = {of_M(d, of_p[0][c].data(), first), of_M(d, of_p[1][c].data(), first), of_M(d, of_p[2][c].data(), first)};
    q[c] = {of_N(d, of_q[0][c].data()), of_N(d, of_q[1][c].data()), of_N(d, of_q[2][c].data())};
  }
}

// The normals of both triangles of each pair, of length 1 − 10⁻⁶ up to rounding, or 0 for a triangle that is too small.
template <class D>
HWY_INLINE Vector3<hn::Vec<D>> unit_normal_M(D d, const LeafPair& leaves, std::size_t first) {
  const auto length = of_M(d, leaves.p.inverse_length.data(), first);
  const auto& n = leaves.p.normal;
  return {hn::Mul(of_M(d, n[0].data(), first), length), hn::Mul(of_M(d, n[1].data(), first), length),
          hn::Mul(of_M(d, n[2].data(), first), length)};
}
template <class D>
HWY_INLINE Vector3<hn::Vec<D>> unit_normal_N(D d, const LeafPair& leaves) {
  const auto length = of_N(d, leaves.q.inverse_length.data());
  const auto& n = leaves.q.normal;
  return {hn::Mul(of_N(d, n[0].data()), length), hn::Mul(of_N(d, n[1].data()), length),
          hn::Mul(of_N(d, n[2].data()), length)};
}

template <class V>
HWY_INLINE Vector3<V> minus(const Vector3<V>& a, const Vector3<V>& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
template <class V>
HWY_INLINE Vector3<V> times(const Vector3<V>& a, const Vector3<V>& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}
template <class V>
HWY_INLINE V dot(const Vector3<V>& a, const Vector3<V>& b) {
  return hn::Add(hn::Mul(a.x, b.x), hn::Add(hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)));
}
template <class M, class V>
HWY_INLINE Vector3<V> choose(M mask, const Vector3<V>& yes, const Vector3<V>& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y), hn::IfThenElse(mask, yes.z, no.z)};
}

}  // namespace glissade::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
