#pragma once

/// Checks independently, after a run, that poses of a part are collision-free with static obstacles.
///
/// The check shares no code with the DOP-tree or the exact predicates. The obstacles' triangles are binned into a
/// uniform grid. Every triangle of the part is compared with every obstacle triangle in the same cells, by a
/// separating-axis test in double precision. A pair counts as free only if some axis certainly separates it. So
/// intersection, touching, and a gap below about 1e-14 of the triangles' extent are all collisions. Triangles whose
/// area is zero in double precision are ignored.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::reference {

/// A mesh and the pose X_WB of its frame B in the world.
struct PlacedMesh {
  std::shared_ptr<const geometry::TriangleMesh> mesh;
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
};

/// The obstacles in their grid. Immutable, so any number of threads may query it at once.
class GridCheck {
 public:
  /// A function that receives the number of poses checked so far. The worker threads call it, one call at a time.
  using Progress = std::function<void(std::size_t)>;

  /// Cost O(triangles + cells they cover); at most 2^24 cells. Throws std::invalid_argument for a null mesh or a
  /// coordinate that is not finite.
  explicit GridCheck(const std::vector<PlacedMesh>& obstacles);

  /// Whether the part at pose X_WV collides with any obstacle. Allocates; may be called from any thread. Throws
  /// std::invalid_argument when a vertex in the world is not finite.
  bool collides(const geometry::TriangleMesh& part_V, const Eigen::Isometry3d& X_WV) const;

  /// Checks many poses in parallel on all processors. The result has one entry per pose, which is 1 if the part
  /// collides there, else 0.
  std::vector<char> collisions(const geometry::TriangleMesh& part_V, std::span<const Eigen::Isometry3d> poses_WV,
                               const Progress& progress = {}) const;

  /// Edge length of a cell in metres; 0 without obstacles.
  double cell_size() const { return cell_size_; }

 private:
  /// An obstacle triangle in the world with its box.
  struct Obstacle {
    Eigen::Vector3d corners[3];
    Eigen::Vector3d low;
    Eigen::Vector3d high;
  };
  /// Inclusive ranges of cells along x, y, z.
  struct CellBox {
    Eigen::Array3i low;
    Eigen::Array3i high;
  };

  void gather(const PlacedMesh& obstacle);
  void lay_out_cells();
  void fill_cells();
  bool plane_meets_cell(const Obstacle& obstacle, const Eigen::Array3i& cell) const;
  CellBox cells_of(const Eigen::Vector3d& low, const Eigen::Vector3d& high) const;
  bool any_block_occupied(const CellBox& cells) const;
  std::size_t cell_index(const Eigen::Array3i& cell) const;
  std::size_t block_index(const Eigen::Array3i& block) const;
  bool collides(std::span<const geometry::Triangle> triangles, std::span<const Eigen::Vector3d> vertices_W) const;
  bool triangle_collides(const Eigen::Vector3d& p0, const Eigen::Vector3d& p1, const Eigen::Vector3d& p2) const;

  std::vector<Obstacle> obstacles_;
  double cell_size_ = 0.0;
  Eigen::Vector3d low_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d high_ = Eigen::Vector3d::Zero();
  Eigen::Array3i cell_counts_ = Eigen::Array3i::Zero();
  Eigen::Array3i block_counts_ = Eigen::Array3i::Zero();
  std::vector<std::uint32_t> cell_begin_;  ///< index of the first obstacle of each cell in cell_obstacles_
  std::vector<std::uint32_t> cell_obstacles_;
  std::vector<char> block_occupied_;  ///< 1 for each block of 8 × 8 × 8 cells with obstacles, else 0
};

}  // namespace glissade::reference
