#include "kernels/alignment_table.h"

#include <numeric>

#include "tree/generic_dop.h"

namespace glissade::collision {
namespace {

AlignmentTable make_table(int k) {
  const DopDirections& directions = dop_directions(k);
  AlignmentTable table{};
  table.slabs = directions.slabs;
  for (std::size_t i = 0; i < static_cast<std::size_t>(directions.slabs); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      table.direction[axis][i] = static_cast<float>(directions.unit[i][static_cast<Eigen::Index>(axis)]);
  }

  // The quarter line of a node that holds the offsets of a half-space.
  const auto quarter = [&](int half_space) {
    const bool is_above = half_space < directions.slabs;
    const int number = is_above ? 2 * half_space : 2 * (half_space - directions.slabs) + 1;
    return quarter_line(static_cast<std::size_t>(number));
  };
  std::iota(table.number.begin(), table.number.end(), 0);
  std::size_t slot = 0;
  for (const GenericVertex& vertex : generic_dop_vertices(k)) {
    for (std::size_t term = 0; term < 3; ++term) {
      const auto row = static_cast<Eigen::Index>(term);
      table.position[slot][term] = static_cast<float>(vertex.position[row]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        table.weights[3 * term + axis][slot] =
            static_cast<float>(vertex.weights_of_direction(row, static_cast<Eigen::Index>(axis)));
      }
      // The bounds that face `above` are those of the opposite half-spaces.
      const QuarterLine own = quarter(vertex.half_spaces[term]);
      const QuarterLine opposite = quarter(directions.opposite(vertex.half_spaces[term]));
      table.source[2 * slot][2 * term] = opposite;
      table.source[2 * slot][2 * term + 1] = own;
      table.source[2 * slot + 1][2 * term] = own;
      table.source[2 * slot + 1][2 * term + 1] = opposite;
    }
    ++slot;
  }
  table.vertex_count = static_cast<int>(slot);
  return table;
}

}  // namespace

const AlignmentTable& alignment_table(int k) {
  static const std::array<AlignmentTable, kDopSizes.size()> tables{make_table(6), make_table(14), make_table(18),
                                                                   make_table(24), make_table(26)};
  return tables[dop_size_index(k)];
}

}  // namespace glissade::collision
