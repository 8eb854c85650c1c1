#include "tree/dop.h"

#include <span>
#include <stdexcept>
#include <string>

namespace glissade::collision {
namespace {

using IntegerDirection = std::array<int, 3>;

constexpr std::array<IntegerDirection, kMostSlabs> kCubeAxes{{{1, 0, 0},
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
                                                              {1, -1, 1},
                                                              {-1, 1, 1}}};

void append(DopDirections& directions, std::span<const IntegerDirection> more) {
  for (const IntegerDirection& b : more) {
    const auto slot = static_cast<std::size_t>(directions.slabs++);
    directions.integer[slot] = b;
    directions.unit[slot] = Eigen::Vector3d(b[0], b[1], b[2]).normalized();
  }
}

DopDirections make_directions(int k) {
  const std::span<const IntegerDirection> all(kCubeAxes);
  DopDirections directions{};
  if (k == 14) {
    append(directions, all.first(3));
    append(directions, all.last(4));
  } else {
    append(directions, all.first(static_cast<std::size_t>(k / 2)));
  }
  return directions;
}

}  // namespace

std::size_t dop_size_index(int k) {
  for (std::size_t i = 0; i < kDopSizes.size(); ++i) {
    if (kDopSizes[i] == k) return i;
  }
  throw std::invalid_argument("a DOP-tree has 6, 14, 18, 24 or 26 directions, not " + std::to_string(k));
}

const DopDirections& dop_directions(int k) {
  static const std::array<DopDirections, kDopSizes.size()> sets{
      make_directions(6), make_directions(14), make_directions(18), make_directions(24), make_directions(26)};
  return sets[dop_size_index(k)];
}

}  // namespace glissade::collision
