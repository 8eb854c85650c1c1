#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <glissade/collision/dop_query.h>

namespace glissade::collision {
namespace {

using Eigen::Vector3d;

constexpr int kTriedDirections = 48;
constexpr std::size_t kTriedPairs = 16;                               // of triangles, whose normals are tried
constexpr std::array<double, 4> kTriedShares{0.995, 0.5, 0.25, 0.1};  // of the best length
constexpr double kLeastGain = 0.99;        // a nearby direction must shorten the way to this share
constexpr double kLengthPrecision = 1e-3;  // relative to a length
constexpr double kShortest = 1e-12;        // of the radii: bodies that only touch are apart after any way
constexpr double kFirstTilt = 0.4;         // radians
constexpr double kLastTilt = 0.005;
constexpr int kTriedNearby = 6;

// Directions spread evenly over the sphere: a spiral from pole to pole with turns by the golden angle.
Vector3d spiral_direction(int i) {
  const double z = 1.0 - (2.0 * i + 1.0) / kTriedDirections;
  const double angle = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
  const double radius = std::sqrt(1.0 - z * z);
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

Vector3d triangle_normal(const geometry::TriangleMesh& mesh, std::int32_t triangle) {
  const Vector3d& a = mesh.corner(triangle, 0);
  return (mesh.corner(triangle, 1) - a).cross(mesh.corner(triangle, 2) - a).normalized();
}

class WayOut {
 public:
  WayOut(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, QueryWorkspace& workspace,
         double clearance)
      : tree_A_(tree_A),
        tree_B_(tree_B),
        X_AB_(X_AB),
        workspace_(workspace),
        clearance_(clearance),
        shortest_(kShortest * (tree_A.radius() + tree_B.radius())),
        between_(X_AB * tree_B.center() - tree_A.center()) {}

  Vector3d find() {
    if (is_free(Vector3d::Zero())) return Vector3d::Zero();
    const Vector3d outward = between_.norm() > 0.0 ? between_.normalized() : Vector3d::UnitX();
    n_ = outward;
    length_ = shortened(outward, surely_free(outward));
    for (int i = 0; i < kTriedDirections; ++i)
      look_along(spiral_direction(i));
    look_along_normals();
    look_nearby();
    return length_ * n_;
  }

 private:
  bool is_free(const Vector3d& t_A) {
    Eigen::Isometry3d X = X_AB_;
    X.translation() += t_A;
    return !intersects(tree_A_, tree_B_, X, workspace_, clearance_);
  }

  // Length of the translation along n after which the bounding spheres are apart.
  double surely_free(const Vector3d& n) const {
    const double apart = 1.001 * (tree_A_.radius() + tree_B_.radius() + clearance_);
    const double along = n.dot(between_);
    const double across = (between_ - along * n).squaredNorm();
    return across < apart * apart ? std::max(0.0, std::sqrt(apart * apart - across) - along) : 0.0;
  }

  // Given a length along n at which the meshes are apart, returns a length at which they are apart and slightly below
  // which they are not.
  double shortened(const Vector3d& n, double free) {
    double inside = 0.0;
    while (free - inside > std::max(kLengthPrecision * free, shortest_)) {
      const double middle = 0.5 * (inside + free);
      (is_free(middle * n) ? free : inside) = middle;
    }
    return free;
  }

  bool improves(const Vector3d& n, double length) {
    if (length_ <= shortest_ || !is_free(length * n)) return false;
    n_ = n;
    length_ = shortened(n, length);
    return true;
  }

  void look_along(const Vector3d& n) {
    for (const double share : kTriedShares) {
      if (improves(n, share * length_)) return;
    }
  }

  void look_along_normals() {
    std::vector<TrianglePair> pairs;
    intersecting_pairs(tree_A_, tree_B_, X_AB_, workspace_, pairs, clearance_);
    const std::size_t step = std::max<std::size_t>(1, pairs.size() / kTriedPairs);
    for (std::size_t i = 0; i < pairs.size(); i += step) {
      const Vector3d n_A = triangle_normal(tree_A_.mesh(), pairs[i].triangle_A);
      const Vector3d n_B = X_AB_.linear() * triangle_normal(tree_B_.mesh(), pairs[i].triangle_B);
      for (const Vector3d& n : {n_A, Vector3d(-n_A), n_B, Vector3d(-n_B)})
        look_along(n);
    }
  }

  // Tries directions around the best one, in rings of decreasing radius.
  void look_nearby() {
    for (double turn = kFirstTilt; turn > kLastTilt;) {
      const Vector3d u = n_.unitOrthogonal();
      const Vector3d v = n_.cross(u);
      bool is_better = false;
      for (int i = 0; i < kTriedNearby && !is_better; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kTriedNearby;
        const Vector3d n = (n_ + turn * (std::cos(angle) * u + std::sin(angle) * v)).normalized();
        is_better = improves(n, kLeastGain * length_);
      }
      if (!is_better) turn *= 0.5;
    }
  }

  const DopTree& tree_A_;
  const DopTree& tree_B_;
  const Eigen::Isometry3d& X_AB_;
  QueryWorkspace& workspace_;
  double clearance_;
  double shortest_;   ///< a way that counts as none: metres
  Vector3d between_;  ///< from the centre of tree A to that of tree B
  Vector3d n_;        ///< the best direction so far
  double length_ = 0.0;
};

}  // namespace

Penetration find_way_out(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                         QueryWorkspace& workspace, double clearance) {
  return {WayOut(tree_A, tree_B, X_AB, workspace, clearance).find()};
}

}  // namespace glissade::collision
