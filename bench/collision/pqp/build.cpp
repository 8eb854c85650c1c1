#include "build.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

#include "bounds.h"

namespace glissade::bench::pqp {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Pose of N in P, of their poses in M.
Pose relative_pose(const Matrix3d& R_MP, const Vector3d& p_MP, const Matrix3d& R_MN, const Vector3d& p_MN) {
  const Eigen::Matrix3f R_PN = (R_MP.transpose() * R_MN).cast<float>();
  const Eigen::Vector3f p_PN = (R_MP.transpose() * (p_MN - p_MP)).cast<float>();
  Pose X_PN{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      X_PN.rows[i][j] = R_PN(i, j);
    X_PN.rows[i][3] = p_PN[i];
  }
  return X_PN;
}

class TreeBuilder {
 public:
  explicit TreeBuilder(const geometry::TriangleMesh& mesh) : mesh_(mesh), triangles_(mesh.triangles.size()) {
    std::iota(triangles_.begin(), triangles_.end(), 0);
  }

  Tree build() {
    tree_.boxes.resize(1);
    tree_.rectangles.resize(1);
    Bounds mesh_frame;
    mesh_frame.R_MN.setIdentity();
    mesh_frame.p_MC.setZero();
    mesh_frame.p_MO.setZero();
    add_node(0, triangles_, mesh_frame);
    return std::move(tree_);
  }

 private:
  void add_node(std::size_t node, std::span<std::int32_t> triangles, const Bounds& parent) {
    points_M_.clear();
    for (const std::int32_t triangle : triangles) {
      for (const Vector3d& corner : mesh_.corners(triangle))
        points_M_.push_back(corner);
    }
    const Bounds bounds = fit_bounds(points_M_);
    const auto children = tree_.boxes.size();
    const bool leaf = triangles.size() == 1;
    const auto child = leaf ? ~add_triangle(triangles[0]) : static_cast<std::int32_t>(children);
    set_node(node, bounds, parent, child);
    if (leaf) return;
    tree_.boxes.resize(children + 2);
    tree_.rectangles.resize(children + 2);
    const std::size_t first = split(triangles, bounds.R_MN);
    add_node(children, triangles.first(first), bounds);
    add_node(children + 1, triangles.subspan(first), bounds);
  }

  std::int32_t add_triangle(std::int32_t triangle) {
    TriangleNode node{};
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector3f corner = mesh_.corner(triangle, i % 3).cast<float>();
      node.x[i] = corner.x();
      node.y[i] = corner.y();
      node.z[i] = corner.z();
    }
    tree_.triangles.push_back(node);
    tree_.ids.push_back(triangle);
    return static_cast<std::int32_t>(tree_.triangles.size() - 1);
  }

  void set_node(std::size_t node, const Bounds& bounds, const Bounds& parent, std::int32_t child) {
    const Eigen::Vector3f half = bounds.half.cast<float>();
    tree_.boxes[node] = {.X_PN = relative_pose(parent.R_MN, parent.p_MC, bounds.R_MN, bounds.p_MC),
                         .half = {half.x(), half.y(), half.z()},
                         .child = child};
    const Eigen::Vector2f sides = bounds.sides.cast<float>();
    tree_.rectangles[node] = {.X_PN = relative_pose(parent.R_MN, parent.p_MO, bounds.R_MN, bounds.p_MO),
                              .sides = {sides.x(), sides.y()},
                              .radius = static_cast<float>(bounds.radius),
                              .child = child};
  }

  Vector3d centroid(std::int32_t triangle) const {
    const auto [a, b, c] = mesh_.corners(triangle);
    return (a + b + c) / 3.0;
  }

  // Moves the triangles of one side of the mean centroid to the front, and returns their number. Tries the longest axis
  // first; where no axis has triangles on both sides, takes halves.
  std::size_t split(std::span<std::int32_t> triangles, const Matrix3d& R_MN) const {
    Vector3d mean = Vector3d::Zero();
    for (const std::int32_t triangle : triangles)
      mean += centroid(triangle);
    mean /= static_cast<double>(triangles.size());
    for (int i = 0; i < 3; ++i) {
      const Vector3d axis = R_MN.col(i);
      const auto second = std::partition(triangles.begin(), triangles.end(), [&](std::int32_t triangle) {
        return axis.dot(centroid(triangle) - mean) <= 0.0;
      });
      if (second != triangles.begin() && second != triangles.end())
        return static_cast<std::size_t>(second - triangles.begin());
    }
    return triangles.size() / 2;
  }

  const geometry::TriangleMesh& mesh_;
  std::vector<std::int32_t> triangles_;
  std::vector<Vector3d> points_M_;  // of the node in work
  Tree tree_;
};

}  // namespace

Tree build_tree(const geometry::TriangleMesh& mesh) {
  return TreeBuilder(mesh).build();
}

}  // namespace glissade::bench::pqp
