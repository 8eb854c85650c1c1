#include <algorithm>
#include <cmath>
#include <mutex>
#include <stdexcept>

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <glissade/reference/grid_check.h>
#include <glissade/reference/separating_axis.h>

namespace glissade::reference {
namespace {

using Eigen::Array3i;
using Eigen::Vector3d;

constexpr int kBlockCells = 8;
constexpr double kMaxCells = 16'777'216.0;

const Vector3d& vertex_of(const geometry::TriangleMesh& mesh, const geometry::Triangle& triangle, std::size_t corner) {
  return mesh.vertices[static_cast<std::size_t>(triangle[corner])];
}

// Decided in the mesh's own frame: there the computed area of a degenerate triangle is exactly zero more often than
// after a rotation.
bool has_area(const geometry::TriangleMesh& mesh, const geometry::Triangle& triangle) {
  const Vector3d& p0 = vertex_of(mesh, triangle, 0);
  return (vertex_of(mesh, triangle, 1) - p0).cross(vertex_of(mesh, triangle, 2) - p0) != Vector3d::Zero();
}

std::vector<geometry::Triangle> triangles_with_area(const geometry::TriangleMesh& mesh) {
  std::vector<geometry::Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  std::copy_if(mesh.triangles.begin(), mesh.triangles.end(), std::back_inserter(triangles),
               [&](const geometry::Triangle& triangle) { return has_area(mesh, triangle); });
  return triangles;
}

void place(const geometry::TriangleMesh& part_V, const Eigen::Isometry3d& X_WV, std::vector<Vector3d>& vertices_W) {
  vertices_W.resize(part_V.vertices.size());
  std::transform(part_V.vertices.begin(), part_V.vertices.end(), vertices_W.begin(),
                 [&](const Vector3d& p_V) -> Vector3d { return X_WV * p_V; });
  if (!std::all_of(vertices_W.begin(), vertices_W.end(), [](const Vector3d& p) { return p.allFinite(); })) {
    throw std::invalid_argument("A mesh of the collision check has a vertex or a pose that is not finite.");
  }
}

}  // namespace

GridCheck::GridCheck(const std::vector<PlacedMesh>& obstacles) {
  for (const PlacedMesh& obstacle : obstacles) {
    if (obstacle.mesh == nullptr) throw std::invalid_argument("An obstacle of the collision check has no mesh.");
    gather(obstacle);
  }
  if (obstacles_.empty()) return;
  lay_out_cells();
  fill_cells();
}

void GridCheck::gather(const PlacedMesh& obstacle) {
  std::vector<Vector3d> vertices_W;
  place(*obstacle.mesh, obstacle.X_WB, vertices_W);
  for (const geometry::Triangle& triangle : triangles_with_area(*obstacle.mesh)) {
    const Vector3d& p0 = vertices_W[static_cast<std::size_t>(triangle[0])];
    const Vector3d& p1 = vertices_W[static_cast<std::size_t>(triangle[1])];
    const Vector3d& p2 = vertices_W[static_cast<std::size_t>(triangle[2])];
    obstacles_.push_back({{p0, p1, p2}, p0.cwiseMin(p1).cwiseMin(p2), p0.cwiseMax(p1).cwiseMax(p2)});
  }
}

void GridCheck::lay_out_cells() {
  low_ = obstacles_.front().low;
  high_ = obstacles_.front().high;
  double edge_sum = 0.0;
  for (const Obstacle& obstacle : obstacles_) {
    low_ = low_.cwiseMin(obstacle.low);
    high_ = high_.cwiseMax(obstacle.high);
    for (int i = 0; i < 3; ++i)
      edge_sum += (obstacle.corners[(i + 1) % 3] - obstacle.corners[i]).norm();
  }
  const Vector3d size = high_ - low_;
  cell_size_ = edge_sum / (3.0 * static_cast<double>(obstacles_.size()));
  while (((size / cell_size_).array().floor() + 1.0).prod() > kMaxCells)
    cell_size_ *= 1.25;
  cell_counts_ = ((size / cell_size_).array().floor() + 1.0).cast<int>();
  block_counts_ = (cell_counts_ + kBlockCells - 1) / kBlockCells;
}

void GridCheck::fill_cells() {
  const auto for_each_entry = [&](const auto& visit) {
    for (std::size_t i = 0; i < obstacles_.size(); ++i) {
      const CellBox cells = cells_of(obstacles_[i].low, obstacles_[i].high);
      for (int z = cells.low.z(); z <= cells.high.z(); ++z) {
        for (int y = cells.low.y(); y <= cells.high.y(); ++y) {
          for (int x = cells.low.x(); x <= cells.high.x(); ++x) {
            const Array3i cell(x, y, z);
            if (plane_meets_cell(obstacles_[i], cell)) visit(i, cell);
          }
        }
      }
    }
  };
  // Counting sort. The number of triangles in each cell fixes the end of its run; then each run is filled from its end.
  cell_begin_.assign(static_cast<std::size_t>(cell_counts_.prod()) + 1, 0);
  block_occupied_.assign(static_cast<std::size_t>(block_counts_.prod()), 0);
  for_each_entry([&](std::size_t, const Array3i& cell) {
    ++cell_begin_[cell_index(cell)];
    block_occupied_[block_index(cell / kBlockCells)] = 1;
  });
  std::uint32_t total = 0;
  for (std::uint32_t& entry : cell_begin_)
    entry = total += entry;
  cell_obstacles_.resize(total);
  for_each_entry([&](std::size_t i, const Array3i& cell) {
    cell_obstacles_[--cell_begin_[cell_index(cell)]] = static_cast<std::uint32_t>(i);
  });
}

// False for cells that the box of a slanted triangle covers but its plane does not meet.
bool GridCheck::plane_meets_cell(const Obstacle& obstacle, const Array3i& cell) const {
  const Vector3d normal = (obstacle.corners[1] - obstacle.corners[0]).cross(obstacle.corners[2] - obstacle.corners[0]);
  const Vector3d center = low_ + cell_size_ * (cell.cast<double>() + 0.5).matrix();
  // A little more than half a cell, plus a bound of rounding errors for needle triangles: a triangle along a border
  // must not be lost.
  const double extent = (obstacle.high - obstacle.low).lpNorm<1>() + cell_size_;
  const double half_width = 0.501 * cell_size_ * normal.lpNorm<1>() + 1e-14 * extent * extent * extent;
  return std::abs(normal.dot(center - obstacle.corners[0])) <= half_width;
}

GridCheck::CellBox GridCheck::cells_of(const Vector3d& low, const Vector3d& high) const {
  // Clamped before the conversion to int, because a part may be far away. The function is monotonic, so boxes that
  // overlap share a cell.
  const auto cell_at = [&](const Vector3d& p) -> Array3i {
    return ((p - low_) / cell_size_).array().floor().max(0.0).min((cell_counts_ - 1).cast<double>()).cast<int>();
  };
  return {cell_at(low), cell_at(high)};
}

std::size_t GridCheck::cell_index(const Array3i& cell) const {
  return static_cast<std::size_t>((cell.z() * cell_counts_.y() + cell.y()) * cell_counts_.x() + cell.x());
}

std::size_t GridCheck::block_index(const Array3i& block) const {
  return static_cast<std::size_t>((block.z() * block_counts_.y() + block.y()) * block_counts_.x() + block.x());
}

bool GridCheck::any_block_occupied(const CellBox& cells) const {
  const Array3i low = cells.low / kBlockCells;
  const Array3i high = cells.high / kBlockCells;
  for (int z = low.z(); z <= high.z(); ++z) {
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int x = low.x(); x <= high.x(); ++x) {
        if (block_occupied_[block_index({x, y, z})] != 0) return true;
      }
    }
  }
  return false;
}

bool GridCheck::triangle_collides(const Vector3d& p0, const Vector3d& p1, const Vector3d& p2) const {
  const Vector3d low = p0.cwiseMin(p1).cwiseMin(p2);
  const Vector3d high = p0.cwiseMax(p1).cwiseMax(p2);
  if ((low.array() > high_.array()).any() || (high.array() < low_.array()).any()) return false;
  const CellBox cells = cells_of(low, high);
  if (!any_block_occupied(cells)) return false;
  for (int z = cells.low.z(); z <= cells.high.z(); ++z) {
    for (int y = cells.low.y(); y <= cells.high.y(); ++y) {
      for (int x = cells.low.x(); x <= cells.high.x(); ++x) {
        const std::size_t cell = cell_index({x, y, z});
        for (std::uint32_t entry = cell_begin_[cell]; entry < cell_begin_[cell + 1]; ++entry) {
          const Obstacle& obstacle = obstacles_[cell_obstacles_[entry]];
          const bool boxes_meet =
              (low.array() <= obstacle.high.array()).all() && (obstacle.low.array() <= high.array()).all();
          if (boxes_meet && !separated({p0, p1, p2}, {obstacle.corners[0], obstacle.corners[1], obstacle.corners[2]})) {
            return true;
          }
        }
      }
    }
  }
  return false;
}

bool GridCheck::collides(std::span<const geometry::Triangle> triangles, std::span<const Vector3d> vertices_W) const {
  if (obstacles_.empty()) return false;
  return std::any_of(triangles.begin(), triangles.end(), [&](const geometry::Triangle& triangle) {
    return triangle_collides(vertices_W[static_cast<std::size_t>(triangle[0])],
                             vertices_W[static_cast<std::size_t>(triangle[1])],
                             vertices_W[static_cast<std::size_t>(triangle[2])]);
  });
}

bool GridCheck::collides(const geometry::TriangleMesh& part_V, const Eigen::Isometry3d& X_WV) const {
  std::vector<Vector3d> vertices_W;
  place(part_V, X_WV, vertices_W);
  return collides(triangles_with_area(part_V), vertices_W);
}

std::vector<char> GridCheck::collisions(const geometry::TriangleMesh& part_V,
                                        std::span<const Eigen::Isometry3d> poses_WV, const Progress& progress) const {
  const std::vector<geometry::Triangle> triangles = triangles_with_area(part_V);
  std::vector<char> colliding(poses_WV.size(), 0);
  tbb::enumerable_thread_specific<std::vector<Vector3d>> buffers;
  std::mutex mutex;
  std::size_t done = 0;
  tbb::parallel_for(std::size_t{0}, poses_WV.size(), [&](std::size_t i) {
    std::vector<Vector3d>& vertices_W = buffers.local();
    place(part_V, poses_WV[i], vertices_W);
    colliding[i] = collides(triangles, vertices_W) ? 1 : 0;
    if (progress) {
      const std::scoped_lock lock(mutex);
      progress(++done);
    }
  });
  return colliding;
}

}  // namespace glissade::reference
