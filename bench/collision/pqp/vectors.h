#pragma once

/// Vectors of four floats, and poses of them. Only for the sources that are compiled for the processor of the machine.

#include <bit>

#include "tree.h"

namespace glissade::bench::pqp {

using Floats4 = float __attribute__((vector_size(16)));
using Truths4 = std::int32_t __attribute__((vector_size(16)));

inline Floats4 load(const float (&values)[4]) {
  return Floats4{values[0], values[1], values[2], values[3]};
}
inline Floats4 all(float value) {
  return Floats4{value, value, value, value};
}
inline Floats4 smaller(Floats4 a, Floats4 b) {
  return a < b ? a : b;
}
inline Floats4 larger(Floats4 a, Floats4 b) {
  return a > b ? a : b;
}
inline Floats4 clamped(Floats4 value, float high) {
  return smaller(larger(value, Floats4{}), all(high));
}
inline Floats4 magnitude(Floats4 a) {
  return larger(a, -a);
}
/// Of the first three lanes.
inline bool any_of_three(Truths4 truths) {
  using Halves = std::int64_t __attribute__((vector_size(16)));
  const Halves halves = std::bit_cast<Halves>(truths & Truths4{-1, -1, -1, 0});
  return (halves[0] | halves[1]) != 0;
}
inline float least_of_three(Floats4 a) {
  const float least = a[0] < a[1] ? a[0] : a[1];
  return least < a[2] ? least : a[2];
}
inline float largest_of_three(Floats4 a) {
  return -least_of_three(-a);
}
/// Lanes 1, 2, 0 of the first three.
inline Floats4 turned(Floats4 a) {
  return __builtin_shufflevector(a, a, 1, 2, 0, 3);
}

/// X_AB by columns. The fourth lanes have no meaning.
struct Columns {
  Floats4 x;
  Floats4 y;
  Floats4 z;
  Floats4 p;
};

inline Columns columns(const Pose& pose) {
  const auto column = [&](int j) { return Floats4{pose.rows[0][j], pose.rows[1][j], pose.rows[2][j], 0.0F}; };
  return {column(0), column(1), column(2), column(3)};
}

/// X_CB for the child C of A.
inline Columns seen_from_child(const Columns& X_AB, const Pose& X_AC) {
  const Floats4 first = load(X_AC.rows[0]);
  const Floats4 second = load(X_AC.rows[1]);
  const Floats4 third = load(X_AC.rows[2]);
  const auto turned_back = [&](Floats4 v_A) { return first * v_A[0] + second * v_A[1] + third * v_A[2]; };
  const Floats4 p_AC = {first[3], second[3], third[3], 0.0F};
  return {turned_back(X_AB.x), turned_back(X_AB.y), turned_back(X_AB.z), turned_back(X_AB.p - p_AC)};
}

/// X_AC for the child C of B.
inline Columns of_child(const Columns& X_AB, const Pose& X_BC) {
  const auto turn = [&](int column) {
    return X_AB.x * X_BC.rows[0][column] + X_AB.y * X_BC.rows[1][column] + X_AB.z * X_BC.rows[2][column];
  };
  return {turn(0), turn(1), turn(2), X_AB.p + turn(3)};
}

}  // namespace glissade::bench::pqp
