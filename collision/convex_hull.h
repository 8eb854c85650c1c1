#pragma once

/// The convex hull of an object, and a test of whether two hulls are apart (paper §2.2). A hull encloses an object much
/// more tightly than a box. The test takes nanoseconds for a pair that moves little between queries.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <glissade/base/export.h>
#include <glissade/geometry/triangle_mesh.h>

namespace glissade::collision {

struct HullFacets;

/// A convex hull. The input points may be coplanar, collinear or coincident. Immutable after construction, so objects
/// and threads may share it.
class GLISSADE_EXPORT ConvexHull {
 public:
  /// The hull of points in the frame of the object (metres). Throws std::invalid_argument if there is no point or if a
  /// coordinate is not finite. Cost O(n log n).
  explicit ConvexHull(std::span<const Eigen::Vector3d> points);

  /// The hull of the corners of all triangles of a mesh. Throws std::invalid_argument if the mesh has no triangle.
  explicit ConvexHull(const geometry::TriangleMesh& mesh);

  /// The corners of the hull, in no particular order.
  std::span<const Eigen::Vector3d> vertices() const { return vertices_; }

  /// The corners that share an edge with corner `vertex`, including edges that divide a flat face into triangles.
  std::span<const std::int32_t> neighbors(std::int32_t vertex) const {
    const auto v = static_cast<std::size_t>(vertex);
    return std::span(neighbors_)
        .subspan(static_cast<std::size_t>(first_neighbor_[v]),
                 static_cast<std::size_t>(first_neighbor_[v + 1] - first_neighbor_[v]));
  }

  /// The dimension of the hull: 3 for a solid, 2 for a polygon, 1 for a segment, 0 for a point.
  int dimension() const { return dimension_; }

  /// Centre of the axis-aligned bounding box of the corners, and the largest distance of a corner from this centre
  /// (metres).
  const Eigen::Vector3d& center() const { return center_; }
  double radius() const { return radius_; }

  /// The largest distance of a corner from the origin of the object's frame (metres). Rounding errors of coordinates
  /// are proportional to this distance.
  double reach() const { return reach_; }

  /// The largest distance (metres) by which an input point lies outside the hull of `vertices()`. The distance can be
  /// positive because Qhull omits points that lie nearly in a face.
  double outside() const { return outside_; }

  /// Support mapping: the corner farthest along `direction`, a vector of about unit length. The search climbs from
  /// neighbor to neighbor, beginning at corner `start`. Another corner may be farther than the result, but by at most
  /// `climbing_error`. The cost is proportional to the number of neighbors of all corners on the path. From an
  /// arbitrary start, the path has about √n corners. The path is very short if `start` is the result for a similar
  /// direction.
  std::int32_t support(const Eigen::Vector3d& direction, std::int32_t start) const;

  /// A corner at which `support` can start if no better start is known. The corner is the farthest along some direction
  /// within a few degrees of `direction`. Cost O(1).
  std::int32_t start_toward(const Eigen::Vector3d& direction) const { return starts_[cell_of(direction)]; }

  /// Upper bound (metres) of the error of `support`. Another corner may be farther along the direction than the result,
  /// by at most this length. The search can stop too early where rounding hides the difference between neighbors, as on
  /// narrow facets.
  double climbing_error() const { return climbing_error_; }

  /// The corner farthest along `direction`, found by examining all corners. Cost O(n).
  std::int32_t farthest(const Eigen::Vector3d& direction) const;

 private:
  using Edge = std::array<std::int32_t, 2>;

  // Each direction points to a cell on the surface of a cube. Each of the cube's six faces has kCells by kCells cells.
  static constexpr int kCells = 8;
  static std::size_t cell_of(const Eigen::Vector3d& direction);
  void find_starts();

  HullFacets find_corners(std::span<const Eigen::Vector3d> points);
  void take_corners(std::span<const Eigen::Vector3d> points, const std::vector<Edge>& edges);

  std::vector<Eigen::Vector3d> vertices_;
  std::vector<std::int32_t> first_neighbor_;  ///< start of each corner's list in `neighbors_`, and the end of the last
  std::vector<std::int32_t> neighbors_;
  std::vector<std::int32_t> starts_;  ///< by cell
  int dimension_ = 0;
  double outside_ = 0.0;
  double climbing_error_ = 0.0;
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  double radius_ = 0.0;
  double reach_ = 0.0;
};

inline std::size_t ConvexHull::cell_of(const Eigen::Vector3d& direction) {
  Eigen::Index axis = 0;
  const double largest = direction.cwiseAbs().maxCoeff(&axis);
  // Maps −1 to 1 along each side of a face to its cells. A direction of zero length also has a cell.
  const double scale = largest > 0.0 ? 0.5 * kCells / largest : 0.0;
  const auto cell = [&](Eigen::Index i) {
    return std::clamp(static_cast<int>(direction[i] * scale + 0.5 * kCells), 0, kCells - 1);
  };
  const int face = 2 * static_cast<int>(axis) + (direction[axis] < 0.0 ? 1 : 0);
  return static_cast<std::size_t>((face * kCells + cell((axis + 1) % 3)) * kCells + cell((axis + 2) % 3));
}

inline std::int32_t ConvexHull::support(const Eigen::Vector3d& direction, std::int32_t start) const {
  std::int32_t best = start;
  double height = direction.dot(vertices_[static_cast<std::size_t>(best)]);
  for (bool climbed = true; climbed;) {
    climbed = false;
    for (const std::int32_t next : neighbors(best)) {
      const double height_of_next = direction.dot(vertices_[static_cast<std::size_t>(next)]);
      if (height_of_next > height) {
        height = height_of_next;
        best = next;
        climbed = true;
      }
    }
  }
  return best;
}

/// The method that tests two hulls if the plane of the last query no longer separates them.
enum class HullTest : std::uint8_t {
  kExact,  ///< complete GJK, started from the simplex of the last query; exact up to rounding, see `hulls_apart`
  /// Up to 300 learning steps of a perceptron (paper §2.2). Each step turns a trial plane. The answer "apart" is
  /// certain, but the answer "not apart" may be wrong.
  kPerceptron,
};

/// Results of the last query of a pair of hulls. They speed up the next query. They change its answer only where
/// rounding leaves the answer undecided. Keep one `HullMemory` for each pair of objects, and always pass the two hulls
/// in the same order. Not thread-safe.
struct HullMemory {
  /// The separating plane, stored twice: once fixed to A (n_A, reach_A), once fixed to B (n_B, reach_B). Normals are
  /// unit vectors from A to B.
  Eigen::Vector3d n_A = Eigen::Vector3d::Zero();
  Eigen::Vector3d n_B = Eigen::Vector3d::Zero();
  double reach_A = 0.0;  ///< extent of A along n_A from the origin of A, metres
  double reach_B = 0.0;  ///< extent of B along −n_B from the origin of B, metres

  /// Lower bound (metres) of the distance between the hulls; 0 unless the last answer was "apart". The bound is
  /// measured along n_gap_A, a unit vector from A to B in the frame of A.
  double gap = 0.0;
  Eigen::Vector3d n_gap_A = Eigen::Vector3d::Zero();

  std::int32_t corner_A = 0;  ///< corner of A at which `support` starts
  std::int32_t corner_B = 0;
  /// The last simplex of GJK. Each point has a corner of A and a corner of B.
  std::array<std::array<std::int32_t, 2>, 4> simplex{};
  std::int8_t simplex_count = 0;
  std::int8_t planes_to_leave = 0;  ///< number of the next new planes that the test does not try to improve
  bool has_plane = false;
  bool by_centers = false;  ///< whether the last answer came from the line between the centres, after a large movement
  bool met = false;         ///< whether the last answer was that the hulls may meet

  std::int32_t loops = 0;  ///< number of learning steps and GJK rounds in the last query
};

/// Whether two hulls are certainly apart. X_AB is the pose of B in the frame of A. Touching hulls are not apart. With
/// HullTest::kExact, the answer is exact for the points from which the hulls were made, with one exception: if the gap
/// is within the rounding error, the answer is false. The rounding error is at most the sum of both
/// `ConvexHull::outside` plus 1e-13 of the sum of all coordinates involved (1e-11 for hulls like needles).
///
/// Allocates nothing. The cost is about 20 ns if the plane or simplex in the `HullMemory` still gives the answer.
/// Otherwise the cost is less than a microsecond after a small movement, and some microseconds after a large movement.
/// The cost is always bounded. Different threads may query the same hulls, each with its own `HullMemory`.
GLISSADE_EXPORT bool hulls_apart(const ConvexHull& hull_A, const ConvexHull& hull_B, const Eigen::Isometry3d& X_AB,
                                 HullMemory& memory, HullTest test = HullTest::kExact) noexcept;

}  // namespace glissade::collision
