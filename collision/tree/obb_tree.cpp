#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include <Eigen/Eigenvalues>

#include <glissade/collision/dop_tree.h>

namespace glissade::collision {
namespace {

using Eigen::Vector3d;
using geometry::TriangleMesh;

/// Bound of the rounding errors of the sums here, relative to the largest coordinate.
constexpr double kRoundingOfBoxes = 32.0 * std::numeric_limits<double>::epsilon();

/// The corners of triangles, and the box around them.
class ObbFit {
 public:
  ObbFit(const TriangleMesh& mesh, std::span<const std::int32_t> triangles) : mesh_(mesh), triangles_(triangles) {
    for_each_corner([&](const Vector3d& x) { bounds_.extend(x); });
    find_largest();
    find_spread();
  }

  Obb box() const {
    const Vector3d thin = thinnest({mesh_normal_, spread_.col(0)});
    const Vector3d along = shortest_across(thin);
    Obb box;
    box.axes << thin, along, thin.cross(along).normalized();
    Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity());
    Vector3d high = -low;
    for_each_corner([&](const Vector3d& x) {
      const Vector3d in_axes = box.axes.transpose() * x;
      low = low.cwiseMin(in_axes);
      high = high.cwiseMax(in_axes);
    });
    box.c = box.axes * (0.5 * (low + high));
    const double rounding = kRoundingOfBoxes * bounds_.min().cwiseAbs().cwiseMax(bounds_.max().cwiseAbs()).maxCoeff();
    box.half_size = (0.5 * (high - low)).array() + rounding;
    double farthest = 0.0;
    for_each_corner([&](const Vector3d& x) { farthest = std::max(farthest, (x - box.c).squaredNorm()); });
    box.radius = std::sqrt(farthest) + rounding;
    return box;
  }

 private:
  template <typename Function>
  void for_each_corner(const Function& function) const {
    for (const std::int32_t t : triangles_) {
      for (int corner = 0; corner < 3; ++corner)
        function(mesh_.corner(t, corner));
    }
  }

  /// The largest triangle shows the plane of a patch best, and its edges often the patch's sides.
  void find_largest() {
    Vector3d largest = Vector3d::Zero();
    for (const std::int32_t t : triangles_) {
      const Vector3d normal = (mesh_.corner(t, 1) - mesh_.corner(t, 0)).cross(mesh_.corner(t, 2) - mesh_.corner(t, 0));
      if (normal.squaredNorm() < largest.squaredNorm()) continue;
      largest = normal;
      largest_triangle_ = t;
    }
    mesh_normal_ = largest.stableNormalized();
  }

  /// The principal directions of the corners, the one of least spread first.
  void find_spread() {
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for_each_corner([&](const Vector3d& x) {
      const Vector3d from_middle = x - bounds_.center();
      covariance += from_middle * from_middle.transpose();
    });
    spread_ = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors();
  }

  double thickness(const Vector3d& n) const {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for_each_corner([&](const Vector3d& x) {
      low = std::min(low, n.dot(x));
      high = std::max(high, n.dot(x));
    });
    return high - low;
  }

  Vector3d thinnest(std::initializer_list<Vector3d> directions) const {
    Vector3d best = Vector3d::UnitX();
    double least = std::numeric_limits<double>::infinity();
    for (const Vector3d& n : directions) {
      if (!(std::abs(n.norm() - 1.0) < 1e-9)) continue;  // the triangles have no such direction
      const double t = thickness(n);
      if (!(t < least)) continue;
      least = t;
      best = n.normalized();
    }
    return best;
  }

  /// A direction across `thin` that makes a box of small area.
  Vector3d shortest_across(const Vector3d& thin) const {
    Vector3d best = thin.unitOrthogonal();
    double least = std::numeric_limits<double>::infinity();
    const auto look = [&](const Vector3d& direction) {
      const Vector3d across = thin.cross(direction);
      if (!(across.norm() > 0.1 * direction.norm())) return;  // almost parallel to `thin`: ill-conditioned
      const Vector3d u = (across - thin * thin.dot(across)).normalized();
      const double area = thickness(u) * thickness(thin.cross(u));
      if (!(area < least)) return;
      least = area;
      best = u;
    };
    for (int i = 0; i < 3; ++i)
      look(mesh_.corner(largest_triangle_, (i + 1) % 3) - mesh_.corner(largest_triangle_, i));
    look(spread_.col(2));
    return best;
  }

  const TriangleMesh& mesh_;
  std::span<const std::int32_t> triangles_;
  Eigen::AlignedBox3d bounds_;
  std::int32_t largest_triangle_ = 0;
  Vector3d mesh_normal_ = Vector3d::Zero();
  Eigen::Matrix3d spread_ = Eigen::Matrix3d::Identity();
};

Obb obb_of(const TriangleMesh& mesh, std::span<const std::int32_t> triangles) {
  if (triangles.empty()) return {Vector3d::Zero(), Eigen::Matrix3d::Identity(), Vector3d::Zero(), -1.0};
  return ObbFit(mesh, triangles).box();
}

/// Visits nodes depth first, so that the triangles below each node are contiguous.
class ObbTreeBuilder {
 public:
  ObbTreeBuilder(const DopTree& tree, std::vector<Obb>& boxes) : tree_(tree), boxes_(boxes) {}

  void visit(std::uint32_t node) {
    const TreeNode head = tree_.node(node);
    for (int child = 0; child < head.child_count(); ++child) {
      const std::size_t begin = triangles_.size();
      if (head.is_leaf(child)) {
        add_leaf(head.child(child));
      } else {
        visit(head.child(child));
      }
      boxes_[static_cast<std::size_t>(DopTree::kWidth) * node + static_cast<std::size_t>(child)] =
          obb_of(tree_.mesh(), std::span(triangles_).subspan(begin));
    }
  }

 private:
  void add_leaf(std::uint32_t leaf) {
    for (const std::int32_t triangle : tree_.triangles_of_leaf(leaf)) {
      if (triangle >= 0) triangles_.push_back(triangle);
    }
  }

  const DopTree& tree_;
  std::vector<Obb>& boxes_;
  std::vector<std::int32_t> triangles_;
};

}  // namespace

ObbTree::ObbTree(const DopTree& tree) : boxes_(static_cast<std::size_t>(DopTree::kWidth) * tree.node_count()) {
  ObbTreeBuilder(tree, boxes_).visit(0);
}

}  // namespace glissade::collision
