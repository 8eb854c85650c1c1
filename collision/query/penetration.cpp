#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
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
constexpr int kSweepSteps = 32;
constexpr double kBeyond = 1e-9;  // of the radii: a sweep goes so far beyond the place where triangles only touch

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

using Corners = std::array<Vector3d, 3>;

Corners corners_of(const geometry::TriangleMesh& mesh, std::int32_t triangle, const Eigen::Isometry3d& X) {
  return {X * mesh.corner(triangle, 0), X * mesh.corner(triangle, 1), X * mesh.corner(triangle, 2)};
}

// How far b must move along n until a direction separates it by more than the clearance from a, behind it.
double exit_length(const Corners& a, const Corners& b, const Vector3d& n, double clearance) {
  const auto edge = [](const Corners& triangle, std::size_t i) -> Vector3d {
    return triangle[(i + 1) % 3] - triangle[i];
  };
  double exit = std::numeric_limits<double>::infinity();
  const auto try_axis = [&](Vector3d axis) {
    const double norm = axis.norm();
    if (norm == 0.0) return;
    axis /= axis.dot(n) < 0.0 ? -norm : norm;
    const double speed = axis.dot(n);
    if (speed <= 0.0) return;
    const auto along = [&](const Vector3d& p) { return axis.dot(p); };
    const double last_a = std::max({along(a[0]), along(a[1]), along(a[2])});
    const double first_b = std::min({along(b[0]), along(b[1]), along(b[2])});
    exit = std::min(exit, (last_a + clearance - first_b) / speed);
  };
  const Vector3d normal_a = edge(a, 0).cross(edge(a, 1));
  const Vector3d normal_b = edge(b, 0).cross(edge(b, 1));
  try_axis(normal_a);
  try_axis(normal_b);
  for (std::size_t i = 0; i < 3; ++i) {
    try_axis(normal_a.cross(edge(a, i)));
    try_axis(normal_b.cross(edge(b, i)));
    for (std::size_t j = 0; j < 3; ++j)
      try_axis(edge(a, i).cross(edge(b, j)));
  }
  return exit;
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
    for (const Eigen::Matrix3d& axes_A :
         {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), Eigen::Matrix3d(X_AB_.linear())})
      sweep_along(axes_A);
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
    intersecting_pairs(tree_A_, tree_B_, X_AB_, workspace_, pairs_, clearance_);
    const std::size_t step = std::max<std::size_t>(1, pairs_.size() / kTriedPairs);
    for (std::size_t i = 0; i < pairs_.size(); i += step) {
      const Vector3d n_A = triangle_normal(tree_A_.mesh(), pairs_[i].triangle_A);
      const Vector3d n_B = X_AB_.linear() * triangle_normal(tree_B_.mesh(), pairs_[i].triangle_B);
      for (const Vector3d& n : {n_A, Vector3d(-n_A), n_B, Vector3d(-n_B)})
        look_along(n);
    }
  }

  // The axes and the diagonals between two of them: there, machined parts have free places that are small, such as the
  // middle of a hole.
  void sweep_along(const Eigen::Matrix3d& axes_A) {
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        for (int z = -1; z <= 1; ++z) {
          const int axes = std::abs(x) + std::abs(y) + std::abs(z);
          if (axes == 1 || axes == 2) sweep(axes_A * Vector3d(x, y, z).normalized());
        }
      }
    }
  }

  // Finds the first free place along n: each step goes as far as the triangles that intersect now certainly do.
  void sweep(const Vector3d& n) {
    double length = 0.0;
    for (int i = 0; i < kSweepSteps; ++i) {
      Eigen::Isometry3d X = X_AB_;
      X.translation() += length * n;
      intersecting_pairs(tree_A_, tree_B_, X, workspace_, pairs_, clearance_);
      if (pairs_.empty()) break;
      double exit = 0.0;
      for (const TrianglePair& pair : pairs_) {
        exit = std::max(exit, exit_length(corners_of(tree_A_.mesh(), pair.triangle_A, Eigen::Isometry3d::Identity()),
                                          corners_of(tree_B_.mesh(), pair.triangle_B, X), n, clearance_));
      }
      length += exit + kBeyond * (tree_A_.radius() + tree_B_.radius());
      if (length >= kLeastGain * length_) return;
    }
    improves(n, length);
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
  std::vector<TrianglePair> pairs_;
};

}  // namespace

Penetration find_way_out(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                         QueryWorkspace& workspace, double clearance) {
  if (!(clearance >= 0.0 && clearance <= 1e9))
    throw std::invalid_argument("the clearance of a way out is not between 0 and 1e9 m");
  return {WayOut(tree_A, tree_B, X_AB, workspace, clearance).find()};
}

}  // namespace glissade::collision
