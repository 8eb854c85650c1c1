#include "tree/dop_tree_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>

#include <glissade/geometry/triangle_pair.h>

#include "tree/dop.h"

namespace glissade::collision {
namespace {

using Eigen::Vector3d;

constexpr double kNormalUnit = 32767.0;

// In grid steps: rounding of corners to single precision, half a unit in the last place of the radius along each
// coordinate.
constexpr double kCornerRounding = 0.002;

// A thin slab is worth its test if it is thinner than the thinnest slab of the box by more than this factor.
constexpr double kThinEnough = 0.5;

Vector3d corner_of(const TriangleLeaf& leaf, std::size_t corner, std::size_t triangle) {
  return {static_cast<double>(leaf.corner[0][corner][triangle]), static_cast<double>(leaf.corner[1][corner][triangle]),
          static_cast<double>(leaf.corner[2][corner][triangle])};
}

template <typename Visit>
void for_each_corner(std::span<const TriangleLeaf> leaves, const Visit& visit) {
  for (const TriangleLeaf& leaf : leaves) {
    for (std::size_t t = 0; t < kWidth && leaf.triangle[t] != kNoTriangle; ++t) {
      for (std::size_t c = 0; c < 3; ++c)
        visit(corner_of(leaf, c, t));
    }
  }
}

// Falls back to some unit vector: a thin slab may have any direction.
Vector3d longest_axis(const Eigen::Matrix3d& tensor) {
  const Vector3d axis = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>().computeDirect(tensor).eigenvectors().col(2);
  return std::abs(axis.norm() - 1.0) < 1e-9 ? axis : Vector3d::UnitX();
}

std::int16_t grid_value(double value) {
  return static_cast<std::int16_t>(std::clamp(value, -32768.0, 32767.0));
}

class Fitting {
 public:
  Fitting(int directions, bool thin_slab, double padding, std::span<const TriangleLeaf> leaves,
          std::span<NodeHead> heads, std::span<SlabLine> slabs)
      : directions_(dop_directions(directions)),
        thin_slab_(thin_slab),
        padding_(padding),
        lines_(static_cast<std::size_t>(slab_lines(directions_.slabs))),
        leaves_(leaves),
        heads_(heads),
        slabs_(slabs) {}

  // Fits a node and everything below it, with leaves up to `leaf_end`. Returns Σ area · n nᵀ of its triangles. The
  // longest axis of this tensor is the direction in which the whole is thin; it does not depend on which way triangles
  // face.
  Eigen::Matrix3d fit(std::size_t node, std::size_t leaf_end) {
    NodeHead& head = heads_[node];
    head.thin = 0;
    for (std::size_t row = 0; row < 4 * lines_; ++row)
      row_of(node, row).above.fill(kGridRadius), row_of(node, row).below.fill(kGridRadius);

    Eigen::Matrix3d normals = Eigen::Matrix3d::Zero();
    for (int c = 0; c < head.child_count(); ++c) {
      const auto slot = static_cast<std::size_t>(c);
      std::size_t begin = head.child(c);
      std::size_t end = begin + 1;
      Eigen::Matrix3d child_normals;
      if (head.is_leaf(c)) {
        child_normals = normals_of(leaves_[begin]);
        enclose_leaf(leaves_[begin], node, slot);
      } else {
        const std::size_t child = begin;
        begin = heads_[child].first_leaf;
        end = c + 1 < head.node_count ? heads_[child + 1].first_leaf : leaf_end;
        child_normals = fit(child, end);
        enclose_node(child, node, slot);
      }
      fit_thin_slab(leaves_.subspan(begin, end - begin), child_normals, node, slot);
      normals += child_normals;
    }
    return normals;
  }

 private:
  SlabRow& row_of(std::size_t node, std::size_t row) { return slabs_[node * lines_ + row / 4].rows[row % 4]; }

  static Eigen::Matrix3d normals_of(const TriangleLeaf& leaf) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (std::size_t t = 0; t < kWidth && leaf.triangle[t] != kNoTriangle; ++t) {
      const Vector3d a = corner_of(leaf, 0, t);
      const Vector3d n = (corner_of(leaf, 1, t) - a).cross(corner_of(leaf, 2, t) - a);
      const double area = n.norm();
      if (area > 0.0) sum += n * n.transpose() / area;
    }
    return sum;
  }

  void enclose_leaf(const TriangleLeaf& leaf, std::size_t node, std::size_t slot) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(directions_.slabs); ++i) {
      double above = -std::numeric_limits<double>::infinity();
      double below = above;
      for_each_corner({&leaf, 1}, [&](const Vector3d& x) {
        const double projection = kGridRadius * directions_.unit[i].dot(x);
        above = std::max(above, projection);
        below = std::max(below, -projection);
      });
      row_of(node, i).above[slot] = grid_value(std::ceil(above + padding_));
      row_of(node, i).below[slot] = grid_value(std::ceil(below + padding_));
    }
  }

  void enclose_node(std::size_t child, std::size_t node, std::size_t slot) {
    const auto grandchildren = static_cast<std::ptrdiff_t>(heads_[child].child_count());
    for (std::size_t i = 0; i < static_cast<std::size_t>(directions_.slabs); ++i) {
      const SlabRow& from = row_of(child, i);
      SlabRow& to = row_of(node, i);
      to.above[slot] = *std::max_element(from.above.begin(), from.above.begin() + grandchildren);
      to.below[slot] = *std::max_element(from.below.begin(), from.below.begin() + grandchildren);
    }
  }

  void fit_thin_slab(std::span<const TriangleLeaf> leaves, const Eigen::Matrix3d& normals, std::size_t node,
                     std::size_t slot) {
    NodeHead& head = heads_[node];
    const Vector3d thin_direction = longest_axis(normals);
    Vector3d normal;
    Vector3d center;
    for (int axis = 0; axis < 3; ++axis) {
      const auto row = static_cast<std::size_t>(axis);
      head.normal[row][slot] = grid_value(std::trunc(thin_direction[axis] * kNormalUnit));
      normal[axis] = head.normal[row][slot] / kNormalUnit;
      center[axis] = 0.5 * (row_of(node, row).above[slot] - row_of(node, row).below[slot]);
    }

    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    double square_radius = 0.0;
    for_each_corner(leaves, [&](const Vector3d& x) {
      const Vector3d from_center = kGridRadius * x - center;
      const double height = normal.dot(from_center);
      low = std::min(low, height);
      high = std::max(high, height);
      square_radius = std::max(square_radius, from_center.squaredNorm());
    });
    const double offset = std::round(0.5 * (low + high));
    const double half_width = std::ceil(std::max(high - offset, offset - low) + padding_);
    head.offset[slot] = grid_value(offset);
    head.half_width[slot] = grid_value(half_width);
    head.radius[slot] = grid_value(std::ceil(std::sqrt(square_radius) + padding_));

    double thinnest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < static_cast<std::size_t>(directions_.slabs); ++i)
      thinnest = std::min(thinnest, 0.5 * (row_of(node, i).above[slot] + row_of(node, i).below[slot]));
    if (thin_slab_ && half_width < kThinEnough * thinnest) head.thin |= static_cast<std::uint8_t>(1U << slot);
  }

  const DopDirections& directions_;
  const bool thin_slab_;
  const double padding_;
  const std::size_t lines_;
  const std::span<const TriangleLeaf> leaves_;
  const std::span<NodeHead> heads_;
  const std::span<SlabLine> slabs_;
};

}  // namespace

TreeGrid grid_of(const geometry::TriangleMesh& mesh) {
  Eigen::Array3d low = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array3d high = -low;
  const auto for_each_vertex = [&](const auto& visit) {
    for (const geometry::Triangle& triangle : mesh.triangles) {
      for (const std::int32_t index : triangle)
        visit(mesh.vertices[static_cast<std::size_t>(index)]);
    }
  };
  for_each_vertex([&](const Vector3d& x) {
    low = low.min(x.array());
    high = high.max(x.array());
  });
  TreeGrid grid{0.5 * (low + high).matrix(), Eigen::Vector3d::Zero(), 0.0};
  for_each_vertex([&](const Vector3d& x) { grid.radius = std::max(grid.radius, (x - grid.center).squaredNorm()); });
  grid.half_size = ((high - grid.center.array()).max(grid.center.array() - low) * (1.0 + 1e-12)).matrix();
  grid.radius = std::sqrt(grid.radius) * (1.0 + 1e-12);
  if (!(grid.radius > 0.0)) grid.radius = 1.0;  // all in one point: any positive radius will do
  return grid;
}

std::int64_t fit_leaves(const geometry::TriangleMesh& mesh, const TreeGrid& grid, std::span<TriangleLeaf> leaves) {
  std::int64_t degenerate = 0;
  for (TriangleLeaf& leaf : leaves) {
    for (std::size_t t = 0; t < kWidth; ++t) {
      if (leaf.triangle[t] == kNoTriangle) {  // any corners will do
        for (auto& axis : leaf.corner) {
          for (auto& corner : axis)
            corner[t] = corner[0];
        }
        continue;
      }
      const std::int32_t triangle = leaf.triangle[t] < 0 ? -1 - leaf.triangle[t] : leaf.triangle[t];
      const geometry::TrianglePoints points = mesh.corners(triangle);
      const bool has_area = !geometry::is_degenerate(points);
      leaf.triangle[t] = has_area ? triangle : -1 - triangle;
      if (!has_area) ++degenerate;
      for (std::size_t c = 0; c < 3; ++c) {
        const Vector3d x = (points[c] - grid.center) / grid.radius;
        for (std::size_t axis = 0; axis < 3; ++axis)
          leaf.corner[axis][c][t] = static_cast<float>(x[static_cast<Eigen::Index>(axis)]);
      }
    }
  }
  return degenerate;
}

void fit_nodes(int directions, bool thin_slab, std::span<const TriangleLeaf> leaves, std::span<NodeHead> heads,
               std::span<SlabLine> slabs) {
  Fitting(directions, thin_slab, kCornerRounding, leaves, heads, slabs).fit(0, leaves.size());
}

}  // namespace glissade::collision
