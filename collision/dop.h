#pragma once

/// The discretely oriented polytope (DOP): the intersection of k = 24 half-spaces of fixed directions (paper §2.1).

#include <array>

#include <Eigen/Core>

namespace glissade::collision {

/// Number of half-spaces; the paper found 24 to be the best (§2.1.2). They come in 12 opposite pairs.
inline constexpr int kDopDirections = 24;
inline constexpr int kDopSlabs = kDopDirections / 2;

/// The twelve slab directions: the axes, the edge directions of a cube and three of its corner directions, as small
/// integers so that projections on them are nearly exact. Half-space i < 12 has direction i, half-space i + 12 its
/// opposite.
inline constexpr std::array<std::array<int, 3>, kDopSlabs> kSlabDirections{{{1, 0, 0},
                                                                            {0, 1, 0},
                                                                            {0, 0, 1},
                                                                            {1, 1, 0},
                                                                            {1, -1, 0},
                                                                            {1, 0, 1},
                                                                            {1, 0, -1},
                                                                            {0, 1, 1},
                                                                            {0, 1, -1},
                                                                            {1, 1, 1},
                                                                            {1, 1, -1},
                                                                            {1, -1, 1}}};

/// Direction of half-space i, 0 ≤ i < 24; not a unit vector.
Eigen::Vector3d dop_direction(int half_space);

/// The half-space that faces the other way.
constexpr int opposite(int half_space) {
  return half_space < kDopSlabs ? half_space + kDopSlabs : half_space - kDopSlabs;
}

/// Support values: for every point x inside and every half-space i, dop_direction(i)·x ≤ support[i]. Single precision,
/// rounded outward.
struct Dop {
  std::array<float, kDopDirections> support;
};

}  // namespace glissade::collision
