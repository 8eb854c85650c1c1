#pragma once

/// The comparison of two oriented boxes on the 15 axes of the separating-axis theorem (Gottschalk and others 1996,
/// section 5).

#include "vectors.h"

namespace glissade::bench::pqp {

/// Whether one of the axes separates the boxes. X_AB is the pose of box B in the frame of box A.
inline bool are_apart(const Columns& X_AB, const BoxNode& box_A, const BoxNode& box_B) {
  // Widens the boxes by a rounding, and makes products of nearly parallel edges harmless.
  const Floats4 rounding = all(1e-6F);
  const Floats4 x = magnitude(X_AB.x) + rounding;
  const Floats4 y = magnitude(X_AB.y) + rounding;
  const Floats4 z = magnitude(X_AB.z) + rounding;
  const float(&half_A)[3] = box_A.half;
  const float(&half_B)[3] = box_B.half;
  const Floats4 a = {half_A[0], half_A[1], half_A[2], 0.0F};

  // The faces of A, one in each lane.
  if (any_of_three(magnitude(X_AB.p) > a + x * half_B[0] + y * half_B[1] + z * half_B[2])) return true;

  // The faces of B.
  const Floats4 row_0 = {X_AB.x[0], X_AB.y[0], X_AB.z[0], 0.0F};
  const Floats4 row_1 = {X_AB.x[1], X_AB.y[1], X_AB.z[1], 0.0F};
  const Floats4 row_2 = {X_AB.x[2], X_AB.y[2], X_AB.z[2], 0.0F};
  const Floats4 b = {half_B[0], half_B[1], half_B[2], 0.0F};
  const Floats4 p_BA = row_0 * X_AB.p[0] + row_1 * X_AB.p[1] + row_2 * X_AB.p[2];
  const Floats4 reach_A = (magnitude(row_0) + rounding) * half_A[0] + (magnitude(row_1) + rounding) * half_A[1] +
                          (magnitude(row_2) + rounding) * half_A[2];
  if (any_of_three(magnitude(p_BA) > b + reach_A)) return true;

  // An edge of each: those of A in the lanes.
  const Floats4 p_1 = turned(X_AB.p);
  const Floats4 p_2 = turned(p_1);
  const Floats4 a_1 = turned(a);
  const Floats4 a_2 = turned(a_1);
  const auto apart = [&](Floats4 edge, Floats4 size, Floats4 reach_B) {
    const Floats4 edge_1 = turned(edge);
    const Floats4 size_1 = turned(size);
    return magnitude(edge_1 * p_2 - turned(edge_1) * p_1) > a_1 * turned(size_1) + a_2 * size_1 + reach_B;
  };
  return any_of_three(apart(X_AB.x, x, y * half_B[2] + z * half_B[1]) |
                      apart(X_AB.y, y, z * half_B[0] + x * half_B[2]) |
                      apart(X_AB.z, z, x * half_B[1] + y * half_B[0]));
}

}  // namespace glissade::bench::pqp
