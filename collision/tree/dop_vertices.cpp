#include "tree/dop_vertices.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace glissade::collision {
namespace {

// Vertices are computed in integers: directions are small integers, and plane offsets are rounded up to whole parts of
// a grid step. The determinant of three directions with components −1, 0 and 1 is at most 4. Therefore vertices times
// twelve have integer coordinates, and so have the other quotients by such a determinant below.
using IntegerVector = Eigen::Matrix<std::int64_t, 3, 1>;
constexpr std::int64_t kPartsOfStep = 64;
constexpr std::int64_t kTwelve = 12;
constexpr double kUnitsOfStep = static_cast<double>(kTwelve * kPartsOfStep);

constexpr std::size_t kMostVertices = static_cast<std::size_t>(most_vertices(2 * kMostSlabs));

struct HalfSpace {
  IntegerVector normal;
  std::int64_t offset = 0;
};

struct Polytope {
  std::array<HalfSpace, 2 * kMostSlabs> half_spaces;
  std::size_t half_space_count = 0;
  std::array<IntegerVector, kMostVertices> vertices;  // times twelve
  std::size_t vertex_count = 0;

  void set_half_spaces(const DopDirections& directions, const SlabLine* node, std::size_t child) {
    half_space_count = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(directions.slabs); ++i) {
      const SlabRow& row = node[i / 4].rows[i % 4];
      const auto& b = directions.integer[i];
      const IntegerVector normal(b[0], b[1], b[2]);
      const double length = std::sqrt(static_cast<double>(normal.squaredNorm()));
      const auto offset = [&](std::int16_t steps) {
        return static_cast<std::int64_t>(std::ceil(steps * length * static_cast<double>(kPartsOfStep)));
      };
      half_spaces[half_space_count++] = {normal, offset(row.above[child])};
      half_spaces[half_space_count++] = {-normal, offset(row.below[child])};
    }
  }

  // Every vertex is an end of a segment: the part of a line of two planes that lies within all half-spaces.
  void find_vertices() {
    vertex_count = 0;
    for (std::size_t i = 0; i < half_space_count; ++i) {
      for (std::size_t j = i + 1; j < half_space_count; ++j)
        add_ends_of_line(half_spaces[i], half_spaces[j]);
    }
  }

  void add_ends_of_line(const HalfSpace& a, const HalfSpace& b) {
    const IntegerVector along = a.normal.cross(b.normal);
    const std::int64_t square = along.squaredNorm();
    if (square == 0) return;
    // Points of the line are (start + t · along) / square; t is multiplied by twelve, too.
    const IntegerVector start = a.offset * b.normal.cross(along) + b.offset * along.cross(a.normal);
    std::int64_t first = std::numeric_limits<std::int64_t>::min();
    std::int64_t last = std::numeric_limits<std::int64_t>::max();
    for (std::size_t l = 0; l < half_space_count; ++l) {
      const std::int64_t room = half_spaces[l].offset * square - half_spaces[l].normal.dot(start);
      const std::int64_t determinant = half_spaces[l].normal.dot(along);
      if (determinant > 0) last = std::min(last, room * (kTwelve / determinant));
      if (determinant < 0) first = std::max(first, room * (kTwelve / determinant));
      if (first > last || (determinant == 0 && room < 0)) return;
    }
    add_vertex((kTwelve * start + first * along) / square);
    add_vertex((kTwelve * start + last * along) / square);
  }

  void add_vertex(const IntegerVector& x) {
    const auto* end = vertices.begin() + vertex_count;
    if (std::find(vertices.cbegin(), end, x) == end) vertices[vertex_count++] = x;
  }
};

}  // namespace

DopVertices::DopVertices(int k, std::size_t nodes)
    : k_(k), stride_(static_cast<std::size_t>(most_vertices(k) + 3) / 4), groups_(nodes * stride_), counts_(nodes) {}

void DopVertices::fit(std::span<const NodeHead> heads, std::span<const SlabLine> slabs) {
  const DopDirections& directions = dop_directions(k_);
  const auto lines = static_cast<std::size_t>(slab_lines(directions.slabs));
  std::array<Polytope, kWidth> children;
  for (std::size_t node = 0; node < heads.size(); ++node) {
    const auto child_count = static_cast<std::size_t>(heads[node].child_count());
    std::size_t most = 0;
    for (std::size_t c = 0; c < child_count; ++c) {
      children[c].set_half_spaces(directions, &slabs[node * lines], c);
      children[c].find_vertices();
      most = std::max(most, children[c].vertex_count);
    }

    const std::size_t count = (most + 3) / 4;
    counts_[node] = static_cast<std::uint8_t>(count);
    for (std::size_t v = 0; v < 4 * count; ++v) {
      for (std::size_t c = 0; c < kWidth; ++c) {
        const Polytope& child = children[c < child_count ? c : 0];  // an absent child may have any vertices
        const IntegerVector& x = child.vertices[v < child.vertex_count ? v : 0];
        VertexGroup& group = groups_[node * stride_ + v / 4];
        for (std::size_t axis = 0; axis < 3; ++axis) {
          group.coordinate[axis][v % 4 * kWidth + c] =
              static_cast<float>(static_cast<double>(x[static_cast<Eigen::Index>(axis)]) / kUnitsOfStep);
        }
      }
    }
  }
}

}  // namespace glissade::collision
