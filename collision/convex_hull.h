#pragma once

/// The convex hull of an object, and whether two hulls are apart (paper §2.2): a much tighter enclosure than a box, and
/// a test of nanoseconds for a pair that moves little from one query to the next.

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

/// Immutable after construction, so safe to share between objects and threads. Points that lie in one plane, on one
/// line or in one place have a hull, too.
class ConvexHull {
 public:
  /// Of some points, in metres, in the frame of the object. Throws std::invalid_argument when there is none, or one has
  /// a coordinate that is not finite. Cost O(n log n).
  explicit ConvexHull(std::span<const Eigen::Vector3d> points);

  /// Of the corners of the triangles of a mesh. Throws std::invalid_argument when it has no triangle.
  explicit ConvexHull(const geometry::TriangleMesh& mesh);

  /// The corners of the hull, in no particular order.
  std::span<const Eigen::Vector3d> vertices() const { return vertices_; }

  /// The corners that share an edge with corner `vertex`; edges that divide a flat face into triangles are among them.
  std::span<const std::int32_t> neighbors(std::int32_t vertex) const {
    const auto v = static_cast<std::size_t>(vertex);
    return std::span(neighbors_)
        .subspan(static_cast<std::size_t>(first_neighbor_[v]),
                 static_cast<std::size_t>(first_neighbor_[v + 1] - first_neighbor_[v]));
  }

  /// 3 for a solid, 2 for a polygon, 1 for a segment, 0 for a point.
  int dimension() const { return dimension_; }

  /// Of the bounding box of the corners, and the largest distance of a corner from there (metres).
  const Eigen::Vector3d& center() const { return center_; }
  double radius() const { return radius_; }

  /// The largest distance of a corner from the origin of the object's frame (metres): coordinates are rounded in
  /// proportion to it.
  double reach() const { return reach_; }

  /// How far a point that was given may lie outside the hull of `vertices()`, in metres: Qhull leaves out points that
  /// are nearly in a face.
  double outside() const { return outside_; }

  /// The corner that is furthest along `direction`, which must be about of unit length, found from corner `start` by
  /// climbing from neighbor to neighbor: no corner is further by more than `climbing_error`.
  /// Cost: the corners on the way and their neighbors, about √n from anywhere, next to nothing from where it was
  /// before.
  std::int32_t support(const Eigen::Vector3d& direction, std::int32_t start) const;

  /// A corner that is about furthest along `direction`, within some degrees, for climbing to begin at when nothing
  /// better is known. Cost O(1).
  std::int32_t start_toward(const Eigen::Vector3d& direction) const { return starts_[cell_of(direction)]; }

  /// How much further than the corner of `support` another may be, in metres: climbing stops where it sees no
  /// difference for rounding, which matters where facets are narrow.
  double climbing_error() const { return climbing_error_; }

  /// The corner that is furthest along `direction`: all are looked at.
  std::int32_t furthest(const Eigen::Vector3d& direction) const;

 private:
  using Edge = std::array<std::int32_t, 2>;

  // Directions by the cell of a cube that they point to: of each of its six faces, kCells by kCells.
  static constexpr int kCells = 8;
  static std::size_t cell_of(const Eigen::Vector3d& direction);
  void find_starts();

  HullFacets find_corners(std::span<const Eigen::Vector3d> points);
  void take_corners(std::span<const Eigen::Vector3d> points, const std::vector<Edge>& edges);

  std::vector<Eigen::Vector3d> vertices_;
  std::vector<std::int32_t> first_neighbor_;  ///< one more than vertices
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
  // The cells of a face, from −1 to 1 along either side. A direction of no length has a cell, too.
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

/// How hulls are told apart once the plane of the last query does not separate them any more.
enum class HullTest : std::uint8_t {
  kExact,       ///< GJK from where it was last time, to the end
  kPerceptron,  ///< the paper's: up to 300 learning steps; it may miss that hulls are apart, never that they meet
};

/// What a pair of hulls remembers of its last query. All of it is a guess: whatever is remembered, the answer is the
/// same, but where rounding leaves it open. Keep one for each pair of objects, in their order. Not thread-safe.
struct HullMemory {
  /// The plane, once fixed to A and once to B: a unit normal from A to B, and how far the hull reaches along it.
  Eigen::Vector3d n_A = Eigen::Vector3d::Zero();
  Eigen::Vector3d n_B = Eigen::Vector3d::Zero();
  double reach_A = 0.0;  ///< of A along n_A
  double reach_B = 0.0;  ///< of B against n_B

  /// A lower bound of the distance in metres along a unit vector, from A to B in the frame of A, if the last answer was
  /// that they are apart; else 0.
  double gap = 0.0;
  Eigen::Vector3d n_gap_A = Eigen::Vector3d::Zero();

  std::int32_t corner_A = 0;  ///< where climbing begins
  std::int32_t corner_B = 0;
  std::array<std::array<std::int32_t, 2>, 4> simplex{};  ///< corners of A and B, the last that GJK had in hand
  std::int8_t simplex_count = 0;
  std::int8_t planes_to_leave = 0;  ///< that many new planes are taken as they are found, without a try to turn them
  bool has_plane = false;
  bool met = false;  ///< the last answer was that they may meet

  std::int32_t loops = 0;  ///< of the last query: learning steps and rounds of GJK
};

/// Whether two hulls are certainly apart, at the pose X_AB of B in the frame of A. By default exact for the points that
/// the hulls were made of, but for gaps that are lost in rounding (1e-13 of all coordinates that take part, 1e-11 for
/// needles, and `ConvexHull::outside`), where the answer is no. Touching hulls are not apart.
///
/// Allocates nothing. Cost: about twenty nanoseconds while the plane or the four pairs hold, less than a microsecond
/// otherwise after a small movement, some microseconds after a large one; bounded in any case. Different threads may
/// ask about the same hulls, with memories of their own.
bool hulls_apart(const ConvexHull& hull_A, const ConvexHull& hull_B, const Eigen::Isometry3d& X_AB, HullMemory& memory,
                 HullTest test = HullTest::kExact) noexcept;

}  // namespace glissade::collision
