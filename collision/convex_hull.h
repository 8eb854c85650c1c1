#pragma once

/// The convex hull of an object, and the test whether two hulls are apart (paper §2.2). A hull encloses an object much
/// tighter than a box, and the test takes nanoseconds for a pair that moves little between queries.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::collision {

struct HullFacets;

/// Immutable after construction, so safe to share between objects and threads. Coplanar, collinear and coincident
/// points have a hull, too.
class ConvexHull {
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

  /// 3 for a solid, 2 for a polygon, 1 for a segment, 0 for a point.
  int dimension() const { return dimension_; }

  /// Centre of the axis-aligned bounding box of the corners, and the largest distance of a corner from it (metres).
  const Eigen::Vector3d& center() const { return center_; }
  double radius() const { return radius_; }

  /// The largest distance of a corner from the origin of the object's frame (metres). Rounding errors of coordinates
  /// are proportional to it.
  double reach() const { return reach_; }

  /// How far an input point may lie outside the hull of `vertices()`, in metres: Qhull omits points that lie nearly in
  /// a face.
  double outside() const { return outside_; }

  /// Support mapping: the corner farthest along `direction`, a vector of about unit length, found by climbing from
  /// corner `start` from neighbor to neighbor. No corner is farther by more than `climbing_error`. Cost: the corners on
  /// the way and their neighbors; about √n of them from an arbitrary start, very few from the result of a similar
  /// direction.
  std::int32_t support(const Eigen::Vector3d& direction, std::int32_t start) const;

  /// A start for climbing when no better one is known: a corner that is farthest along a direction within a few degrees
  /// of `direction`. Cost O(1).
  std::int32_t start_toward(const Eigen::Vector3d& direction) const { return starts_[cell_of(direction)]; }

  /// How much farther than the result of `support` another corner may be, in metres. Climbing stops where rounding
  /// hides the difference between neighbors, which matters where facets are narrow.
  double climbing_error() const { return climbing_error_; }

  /// The corner farthest along `direction`, found by examining all corners. Cost O(n).
  std::int32_t furthest(const Eigen::Vector3d& direction) const;

 private:
  using Edge = std::array<std::int32_t, 2>;

  // Directions are classified by the cell of a cube that they point to. Each of its six faces has kCells by kCells
  // cells.
  static constexpr int kCells = 8;
  static std::size_t cell_of(const Eigen::Vector3d& direction);
  void find_starts();

  HullFacets find_corners(std::span<const Eigen::Vector3d> points);
  void take_corners(std::span<const Eigen::Vector3d> points, const std::vector<Edge>& edges);

  std::vector<Eigen::Vector3d> vertices_;
  std::vector<std::int32_t> first_neighbor_;  ///< by corner, and the end of the last list
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
  // Maps −1 to 1 along each side of a face to its cells. A direction of zero length has a cell, too.
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

/// The test that follows if the plane of the last query no longer separates the hulls.
enum class HullTest : std::uint8_t {
  kExact,       ///< GJK to its end, starting from the simplex of the last query
  kPerceptron,  ///< the paper's: up to 300 learning steps; may miss that hulls are apart, never that they meet
};

/// Results of the last query of a pair of hulls, which speed up the next one. They are guesses: the answer does not
/// depend on them, except where rounding leaves it open. Keep one for each pair of objects, always in the same order.
/// Not thread-safe.
struct HullMemory {
  /// The separating plane, stored twice: fixed to A (n_A, reach_A) and fixed to B (n_B, reach_B). Normals are unit
  /// vectors from A to B.
  Eigen::Vector3d n_A = Eigen::Vector3d::Zero();
  Eigen::Vector3d n_B = Eigen::Vector3d::Zero();
  double reach_A = 0.0;  ///< how far A reaches along n_A from its origin, metres
  double reach_B = 0.0;  ///< how far B reaches against n_B from its origin, metres

  /// If the last answer was that the hulls are apart: a lower bound of their distance in metres, measured along the
  /// unit vector n_gap_A from A to B, in the frame of A. Otherwise 0.
  double gap = 0.0;
  Eigen::Vector3d n_gap_A = Eigen::Vector3d::Zero();

  std::int32_t corner_A = 0;  ///< start of climbing
  std::int32_t corner_B = 0;
  /// GJK's last simplex: for each point a corner of A and one of B.
  std::array<std::array<std::int32_t, 2>, 4> simplex{};
  std::int8_t simplex_count = 0;
  std::int8_t planes_to_leave = 0;  ///< number of new planes to keep as found, without an attempt to turn them
  bool has_plane = false;
  bool met = false;  ///< the last answer was that they may meet

  std::int32_t loops = 0;  ///< learning steps and rounds of GJK in the last query
};

/// Whether two hulls are certainly apart, at the pose X_AB of B in the frame of A. HullTest::kExact is exact for the
/// points that the hulls were made of, except for gaps of the size of rounding errors (1e-13 of all coordinates that
/// take part, 1e-11 for needles, plus `ConvexHull::outside`), where the answer is false. Touching hulls are not apart.
///
/// Allocates nothing. Cost: about 20 ns while the remembered plane or simplex decides; otherwise less than a
/// microsecond after a small movement and some microseconds after a large one; bounded in any case. Different threads
/// may query the same hulls, each with a memory of its own.
bool hulls_apart(const ConvexHull& hull_A, const ConvexHull& hull_B, const Eigen::Isometry3d& X_AB, HullMemory& memory,
                 HullTest test = HullTest::kExact) noexcept;

}  // namespace glissade::collision
