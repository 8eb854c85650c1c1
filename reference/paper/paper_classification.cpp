#include "paper/paper_classification.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include <glissade/geometry/triangle_pair.h>

namespace glissade::reference {
namespace {

/// A triangle of a body at X_WB, in world coordinates.
geometry::TrianglePoints triangle_W(const contact::ContactBody& body, const Eigen::Isometry3d& X_WB,
                                    std::int32_t triangle) {
  const geometry::TriangleMesh& mesh = body.tree.mesh();
  return {X_WB * mesh.corner(triangle, 0), X_WB * mesh.corner(triangle, 1), X_WB * mesh.corner(triangle, 2)};
}

using geometry::TrianglePoints;

constexpr double kSmallestGap_m = 1e-10;  // the direction of a shorter difference is rounding

/// For each edge of a polygon, the number of polygons across it that touch the same other polygon.
class EdgeCounts {
 public:
  /// `side_of` returns, for a pair, the topology and the number of the polygon whose edges are counted, the obstacle,
  /// and the other polygon.
  template <typename SideOf>
  EdgeCounts(std::span<const TouchingPair> pairs, const SideOf& side_of) {
    keys_.reserve(3 * pairs.size());
    for (const TouchingPair& pair : pairs) {
      const auto& [topology, triangle, obstacle, other] = side_of(pair);
      for (const std::int32_t edge : topology.edges_of(triangle))
        keys_.push_back({obstacle, other, edge});
    }
    std::sort(keys_.begin(), keys_.end());
  }

  /// Polygons across this edge that touch the same other polygon.
  int across(std::int32_t obstacle, std::int32_t other, std::int32_t edge) const {
    const auto [first, last] = std::equal_range(keys_.begin(), keys_.end(), Key{obstacle, other, edge});
    return static_cast<int>(last - first) - 1;
  }

 private:
  using Key = std::array<std::int32_t, 3>;
  std::vector<Key> keys_;
};

/// One polygon of a touching pair, with its body and its corners at both poses.
struct Polygon {
  const contact::ContactBody* body;
  std::int32_t triangle;
  geometry::TrianglePoints touching;  // world coordinates at the touching pose
  geometry::TrianglePoints free;      // and at the visible pose

  std::int32_t edge(std::size_t i) const { return body->topology.edges_of(triangle)[i]; }
  std::int32_t vertex(std::size_t i) const {
    return body->tree.mesh().triangles[static_cast<std::size_t>(triangle)][i];
  }
};

Eigen::Vector3d normal_of(const geometry::TrianglePoints& t) {
  return (t[1] - t[0]).cross(t[2] - t[0]).normalized();
}

using EdgeFlags = std::array<bool, 3>;

bool any(const EdgeFlags& flags) {
  return flags[0] || flags[1] || flags[2];
}

/// The edges of `a` that meet the triangle `b` at the touching pose.
EdgeFlags edges_that_meet(const Polygon& a, const Polygon& b) {
  EdgeFlags meet{};
  if (geometry::is_degenerate(b.touching)) return meet;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d& end = a.touching[(i + 1) % 3];
    meet[i] = geometry::triangles_intersect(b.touching, {a.touching[i], end, end});
  }
  return meet;
}

/// The vertex of `a` that passes the plane of `b` between the two poses and is within `near` (metres) of `b` at the
/// visible pose; the nearest if there are several.
std::optional<std::size_t> vertex_through(const Polygon& a, const Polygon& b, double near) {
  const Eigen::Vector3d n_free = (b.free[1] - b.free[0]).cross(b.free[2] - b.free[0]);
  const Eigen::Vector3d n_touching = (b.touching[1] - b.touching[0]).cross(b.touching[2] - b.touching[0]);
  std::optional<std::size_t> found;
  double nearest = near;
  for (std::size_t i = 0; i < 3; ++i) {
    const double before = n_free.dot(a.free[i] - b.free[0]);
    const double after = n_touching.dot(a.touching[i] - b.touching[0]);
    if (before * after > 0.0) continue;
    const double distance = (geometry::closest_on_triangle(a.free[i], b.free).point - a.free[i]).norm();
    if (distance <= nearest) {
      nearest = distance;
      found = i;
    }
  }
  return found;
}

class Classification {
 public:
  Classification(std::span<const contact::Obstacle> obstacles, const contact::SlidingPart& part_V,
                 std::span<const TouchingPair> pairs, const Eigen::Isometry3d& X_WC, const Eigen::Isometry3d& X_WV,
                 double near, std::vector<PaperContact>& contacts)
      : obstacles_(obstacles),
        part_V_(part_V),
        X_WC_(X_WC),
        X_WV_(X_WV),
        X_VW_(X_WV.inverse(Eigen::Isometry)),
        near_(near),
        edges_of_p_(pairs,
                    [&](const TouchingPair& pair) {
                      return std::tie(part_V.topology, pair.part_triangle, pair.obstacle, pair.obstacle_triangle);
                    }),
        edges_of_q_(pairs,
                    [&](const TouchingPair& pair) {
                      return std::tie(obstacles[static_cast<std::size_t>(pair.obstacle)].body->topology,
                                      pair.obstacle_triangle, pair.obstacle, pair.part_triangle);
                    }),
        contacts_(contacts) {}

  void add(const TouchingPair& pair) {
    const contact::Obstacle& obstacle = obstacles_[static_cast<std::size_t>(pair.obstacle)];
    const geometry::TrianglePoints q_W = triangle_W(*obstacle.body, obstacle.X_WO, pair.obstacle_triangle);
    pair_ = pair;
    p_ = {&part_V_, pair.part_triangle, triangle_W(part_V_, X_WC_, pair.part_triangle),
          triangle_W(part_V_, X_WV_, pair.part_triangle)};
    q_ = {obstacle.body.get(), pair.obstacle_triangle, q_W, q_W};

    EdgeFlags edges_of_p;
    EdgeFlags edges_of_q;
    AdjacencyCounts counts;
    counts.n_p = count(p_, edges_of_p_, pair.obstacle_triangle, edges_of_p);
    counts.n_q = count(q_, edges_of_q_, pair.part_triangle, edges_of_q);
    if (counts.n_p == 0) edges_of_p = edges_that_meet(p_, q_);
    if (counts.n_q == 0) edges_of_q = edges_that_meet(q_, p_);
    counts.edge_of_p_meets_q = counts.n_p == 0 && any(edges_of_p);
    counts.edge_of_q_meets_p = counts.n_q == 0 && any(edges_of_q);
    bool found = false;
    switch (kind_of(counts)) {
      case PaperContactKind::kVertexFace:
        found = add_vertex_face();
        break;
      case PaperContactKind::kFaceVertex:
        found = add_face_vertex();
        break;
      case PaperContactKind::kEdgeEdge:
        found = add_edge_edge(edges_of_p, edges_of_q);
        break;
      case PaperContactKind::kUnclear:
        break;
    }
    if (!found) add_closest();
  }

 private:
  /// The paper's n; `across` flags the edges across which the counted polygons lie.
  int count(const Polygon& polygon, const EdgeCounts& counts, std::int32_t other, EdgeFlags& across) const {
    int n = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const int here = counts.across(pair_.obstacle, other, polygon.edge(i));
      across[i] = here > 0;
      n += here;
    }
    return n;
  }

  bool add_vertex_face() {
    const auto corner = vertex_through(p_, q_, near_);
    if (!corner) return false;
    const Eigen::Vector3d& x_W = p_.free[*corner];
    const Eigen::Vector3d n_W = normal_of(q_.free);
    add({PaperContactKind::kVertexFace, p_.vertex(*corner), pair_.obstacle, pair_.obstacle_triangle}, n_W, x_W,
        x_W - n_W.dot(x_W - q_.free[0]) * n_W);
    return true;
  }

  bool add_face_vertex() {
    const auto corner = vertex_through(q_, p_, near_);
    if (!corner) return false;
    const Eigen::Vector3d& y_W = q_.free[*corner];
    const Eigen::Vector3d n_W = normal_of(p_.free);
    add({PaperContactKind::kFaceVertex, pair_.part_triangle, pair_.obstacle, q_.vertex(*corner)}, n_W,
        y_W - n_W.dot(y_W - p_.free[0]) * n_W, y_W);
    return true;
  }

  /// Adds the contact of the two closest among the flagged edges.
  bool add_edge_edge(const EdgeFlags& edges_of_p, const EdgeFlags& edges_of_q) {
    double nearest = near_;
    PaperContact::Features features{PaperContactKind::kEdgeEdge, -1, pair_.obstacle, -1};
    geometry::SegmentPoints closest{};
    Eigen::Vector3d n_W;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        geometry::SegmentPoints points;
        if (!edges_of_p[i] || !edges_of_q[j] ||
            !geometry::interior_closest_points(p_.free[i], p_.free[(i + 1) % 3], q_.free[j], q_.free[(j + 1) % 3],
                                               points)) {
          continue;
        }
        const double distance = (points.p - points.q).norm();
        if (distance > nearest) continue;
        nearest = distance;
        closest = points;
        features.of_part = p_.edge(i);
        features.of_obstacle = q_.edge(j);
        n_W = (p_.free[(i + 1) % 3] - p_.free[i]).cross(q_.free[(j + 1) % 3] - q_.free[j]).normalized();
      }
    }
    if (features.of_part < 0) return false;
    add(features, n_W, closest.p, closest.q);
    return true;
  }

  void add_closest() {
    const geometry::TriangleDistance apart = geometry::triangle_distance(q_.free, p_.free);
    Eigen::Vector3d n_W = apart.p_b - apart.p_a;
    if (apart.distance < kSmallestGap_m) {
      // The plane that the motion crosses more steeply.
      const Eigen::Vector3d motion_W = motion_of(apart.p_b);
      const Eigen::Vector3d n_p = normal_of(p_.free);
      const Eigen::Vector3d n_q = normal_of(q_.free);
      n_W = std::abs(n_p.dot(motion_W)) > std::abs(n_q.dot(motion_W)) ? n_p : n_q;
    }
    add({PaperContactKind::kUnclear, pair_.part_triangle, pair_.obstacle, pair_.obstacle_triangle}, n_W.normalized(),
        apart.p_b, apart.p_a);
  }

  /// The sign of `n_W` is arbitrary.
  void add(const PaperContact::Features& features, const Eigen::Vector3d& n_W, const Eigen::Vector3d& x_W,
           const Eigen::Vector3d& y_W) {
    double side = n_W.dot(x_W - y_W);
    if (std::abs(side) < kSmallestGap_m) side = -n_W.dot(motion_of(x_W));
    const Eigen::Vector3d p_V = X_VW_ * x_W;
    contacts_.push_back(
        {features, pair_.part_triangle, pair_.obstacle_triangle, side < 0.0 ? Eigen::Vector3d(-n_W) : n_W, p_V, y_W});
  }

  /// The motion of a point of the part from the visible pose to the touching pose.
  Eigen::Vector3d motion_of(const Eigen::Vector3d& x_W) const { return X_WC_ * (X_VW_ * x_W) - x_W; }

  std::span<const contact::Obstacle> obstacles_;
  const contact::SlidingPart& part_V_;
  const Eigen::Isometry3d& X_WC_;
  const Eigen::Isometry3d& X_WV_;
  Eigen::Isometry3d X_VW_;
  double near_;
  EdgeCounts edges_of_p_;
  EdgeCounts edges_of_q_;
  std::vector<PaperContact>& contacts_;
  TouchingPair pair_{};
  Polygon p_{};
  Polygon q_{};
};

}  // namespace

PaperContactKind kind_of(const AdjacencyCounts& counts) {
  const bool rim_p = counts.n_p == 0;
  const bool rim_q = counts.n_q == 0;
  if (rim_p && rim_q) {
    if (counts.edge_of_p_meets_q && counts.edge_of_q_meets_p) return PaperContactKind::kEdgeEdge;
    if (counts.edge_of_p_meets_q) return PaperContactKind::kVertexFace;
    return counts.edge_of_q_meets_p ? PaperContactKind::kFaceVertex : PaperContactKind::kUnclear;
  }
  if (rim_p) return counts.edge_of_p_meets_q ? PaperContactKind::kEdgeEdge : PaperContactKind::kFaceVertex;
  if (rim_q) return counts.edge_of_q_meets_p ? PaperContactKind::kEdgeEdge : PaperContactKind::kVertexFace;
  if (counts.n_p == counts.n_q) return PaperContactKind::kEdgeEdge;
  return counts.n_p > counts.n_q ? PaperContactKind::kVertexFace : PaperContactKind::kFaceVertex;
}

void classify_contacts(std::span<const contact::Obstacle> obstacles, const contact::SlidingPart& part_V,
                       std::span<const TouchingPair> pairs, const Eigen::Isometry3d& X_WC,
                       const Eigen::Isometry3d& X_WV, double near, std::vector<PaperContact>& contacts) {
  Classification classification(obstacles, part_V, pairs, X_WC, X_WV, near, contacts);
  for (const TouchingPair& pair : pairs)
    classification.add(pair);
}

void keep_first_of_each(std::vector<PaperContact>& contacts) {
  std::stable_sort(contacts.begin(), contacts.end(),
                   [](const PaperContact& a, const PaperContact& b) { return a.features < b.features; });
  contacts.erase(std::unique(contacts.begin(), contacts.end(),
                             [](const PaperContact& a, const PaperContact& b) { return a.features == b.features; }),
                 contacts.end());
}

}  // namespace glissade::reference
