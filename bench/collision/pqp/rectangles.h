#pragma once

/// The distance of two rectangles in space, for volumes swept by spheres (Larsen and others 1999).

#include <cmath>

#include "vectors.h"

namespace glissade::bench::pqp {

using Floats8 = float __attribute__((vector_size(32)));
using Truths8 = std::int32_t __attribute__((vector_size(32)));

inline Floats8 smaller(Floats8 a, Floats8 b) {
  return a < b ? a : b;
}
inline Floats8 clamped(Floats8 value, Floats8 high) {
  return smaller(value > Floats8{} ? value : Floats8{}, high);
}

/// Rectangles A and B, each in x and y of its frame, with a corner at the origin.
class RectanglePair {
 public:
  RectanglePair(const Columns& X_AB, const float (&sides_A)[2], const float (&sides_B)[2])
      : sides_{sides_A[0], sides_A[1], sides_B[0], sides_B[1]},
        R_AB_{X_AB.x[0], X_AB.y[0], X_AB.x[1], X_AB.y[1]},
        heights_{X_AB.x[2], X_AB.y[2], X_AB.z[0], X_AB.z[1]},
        p_AB_(X_AB.p),
        p_AB_along_B_{dot_p(X_AB.x), dot_p(X_AB.y), dot_p(X_AB.z), 0.0F} {}

  float squared_distance() const {
    const Corners corners = all_corners();
    if (any_pierces(corners)) return 0.0F;
    const Floats8 to_edges = smaller(squared_distances_of_edges<0>(), squared_distances_of_edges<1>());
    return least_of(smaller(to_edges, squared_distances_to_faces(corners)));
  }

 private:
  // In the first four lanes the corners of B in the frame of A, then those of A in the frame of B; each time in their
  // order around the rectangle.
  struct Corners {
    Floats8 x;
    Floats8 y;
    Floats8 z;
  };

  static float dot(Floats4 a, Floats4 b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  float dot_p(Floats4 axis_A) const { return dot(axis_A, p_AB_); }

  // One lane of `a` four times, then one lane of `b`, counted from 4 on.
  template <int i, int j>
  static Floats8 halves(Floats4 a, Floats4 b) {
    return __builtin_shufflevector(a, b, i, i, i, i, j, j, j, j);
  }

  Corners all_corners() const {
    const Floats8 x = Floats8{0.0F, 1.0F, 1.0F, 0.0F, 0.0F, 1.0F, 1.0F, 0.0F} * halves<2, 4>(sides_, sides_);
    const Floats8 y = Floats8{0.0F, 0.0F, 1.0F, 1.0F, 0.0F, 0.0F, 1.0F, 1.0F} * halves<3, 5>(sides_, sides_);
    const Floats4 p_BA = -p_AB_along_B_;
    return {x * halves<0, 4>(R_AB_, R_AB_) + y * halves<1, 6>(R_AB_, R_AB_) + halves<0, 4>(p_AB_, p_BA),
            x * halves<2, 5>(R_AB_, R_AB_) + y * halves<3, 7>(R_AB_, R_AB_) + halves<1, 5>(p_AB_, p_BA),
            x * halves<0, 6>(heights_, heights_) + y * halves<1, 7>(heights_, heights_) + halves<2, 6>(p_AB_, p_BA)};
  }

  // Whether points, of the lanes as above, are above or below the rectangle of the frame.
  Truths8 inside(Floats8 x, Floats8 y) const {
    const Floats8 zero{};
    return (x >= zero) & (x <= halves<0, 6>(sides_, sides_)) & (y >= zero) & (y <= halves<1, 7>(sides_, sides_));
  }

  static bool any(Truths8 truths) {
    const Truths4 half =
        __builtin_shufflevector(truths, truths, 0, 1, 2, 3) | __builtin_shufflevector(truths, truths, 4, 5, 6, 7);
    return (half[0] | half[1] | half[2] | half[3]) != 0;
  }

  // Whether an edge of one rectangle passes through the other.
  bool any_pierces(const Corners& corners) const {
    const auto next = [](Floats8 a) { return __builtin_shufflevector(a, a, 1, 2, 3, 0, 5, 6, 7, 4); };
    const Floats8 next_z = next(corners.z);
    const Truths8 crosses = corners.z * next_z <= Floats8{};
    if (!any(crosses)) return false;
    const Floats8 share = corners.z / (corners.z - next_z);
    return any(crosses & inside(corners.x + share * (next(corners.x) - corners.x),
                                corners.y + share * (next(corners.y) - corners.y)));
  }

  Floats8 squared_distances_to_faces(const Corners& corners) const {
    const Floats8 infinity = Floats8{} + HUGE_VALF;
    return inside(corners.x, corners.y) ? corners.z * corners.z : infinity;
  }

  // The closest points of two segments, for the edges along axis i of A and, in the two halves, those along the axes of
  // B. "Other" is the other axis of the same rectangle.
  template <int i>
  Floats8 squared_distances_of_edges() const {
    constexpr int kOther = 1 - i;
    const Floats8 length_A = Floats8{} + sides_[i];
    const Floats8 length_B = halves<2, 7>(sides_, sides_);
    const Floats8 start_A = Floats8{0.0F, 0.0F, 1.0F, 1.0F, 0.0F, 0.0F, 1.0F, 1.0F} * sides_[kOther];
    const Floats8 start_B = Floats8{0.0F, 1.0F, 0.0F, 1.0F, 0.0F, 1.0F, 0.0F, 1.0F} * halves<3, 6>(sides_, sides_);
    const Floats8 cosine = halves<2 * i, 2 * i + 5>(R_AB_, R_AB_);
    const Floats8 cosine_other = halves<2 * kOther, 2 * kOther + 5>(R_AB_, R_AB_);
    // From the start of the edge of A to the start of that of B, and the same along the edge of B.
    const Floats8 way = start_B * halves<2 * i + 1, 2 * i + 4>(R_AB_, R_AB_) + p_AB_[i];
    const Floats8 way_other = start_B * halves<2 * kOther + 1, 2 * kOther + 4>(R_AB_, R_AB_) + p_AB_[kOther] - start_A;
    const Floats8 way_up = start_B * halves<1, 4>(heights_, heights_) + p_AB_[2];
    const Floats8 way_B = halves<0, 5>(p_AB_along_B_, p_AB_along_B_) - start_A * cosine_other;

    // Of the edge of B, the part across that of A: a difference of squares would lose the sine of nearly parallel
    // edges.
    const Floats8 cosine_up = halves<0, 5>(heights_, heights_);
    const Floats8 sine_squared = cosine_other * cosine_other + cosine_up * cosine_up;
    const Floats8 scale = sine_squared > Floats8{} ? 1.0F / sine_squared : Floats8{};  // parallel: any point
    const Floats8 first_on_A =
        clamped(way - cosine * (way_other * cosine_other + way_up * cosine_up) * scale, length_A);
    const Floats8 on_B = clamped(first_on_A * cosine - way_B, length_B);
    const Floats8 on_A = clamped(way + on_B * cosine, length_A);
    const Floats8 along = way + on_B * cosine - on_A;
    const Floats8 across = way_other + on_B * cosine_other;
    const Floats8 up = way_up + on_B * cosine_up;
    return along * along + across * across + up * up;
  }

  static float least_of(Floats8 eight) {
    const Floats4 four =
        smaller(__builtin_shufflevector(eight, eight, 0, 1, 2, 3), __builtin_shufflevector(eight, eight, 4, 5, 6, 7));
    const Floats4 two = smaller(four, __builtin_shufflevector(four, four, 2, 3, 2, 3));
    return two[0] < two[1] ? two[0] : two[1];
  }

  Floats4 sides_;    // of A, then of B
  Floats4 R_AB_;     // xx, xy, yx, yy
  Floats4 heights_;  // the other entries: zx, zy, xz, yz
  Floats4 p_AB_;
  Floats4 p_AB_along_B_;
};

/// Distance of the volumes, 0 where they overlap.
inline float distance_of(const Columns& X_AB, const RectangleNode& volume_A, const RectangleNode& volume_B) {
  const float squared = RectanglePair(X_AB, volume_A.sides, volume_B.sides).squared_distance();
  return std::fmax(0.0F, std::sqrt(squared) - volume_A.radius - volume_B.radius);
}

}  // namespace glissade::bench::pqp
