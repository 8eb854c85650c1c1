#include "cycle/inset.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include <glissade/base/assert.h>
#include <glissade/contact/projection.h>

#include "cycle/orientation.h"

namespace glissade::contact {
namespace {

/// In depths: sharper corners do not move so far as their faces.
constexpr double kFarthestCorner = 10.0;
/// Share of the surface that may turn over: slivers do. If more does, there is nothing left inside.
constexpr double kTurnedOver = 0.01;
constexpr double kDepthPrecision = 1e-3;

/// Twice the area of a triangle along its normal.
Eigen::Vector3d twice_area(const geometry::TriangleMesh& mesh, std::size_t triangle) {
  const auto t = static_cast<std::int32_t>(triangle);
  return (mesh.corner(t, 1) - mesh.corner(t, 0)).cross(mesh.corner(t, 2) - mesh.corner(t, 0));
}

/// The shortest way of a vertex that takes each plane of its faces, with unit normals `inwards`, a metre inwards. Zero
/// where there is none.
Eigen::Vector3d way_inwards(ProjectionSolver& solver, const std::vector<ConstraintRow>& faces) {
  const Projection way = solver.project({}, {.translational = 1.0, .rotational = 1.0}, faces);
  if (way.status != ProjectionStatus::kSolved) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d& v = way.displacement().v;
  return v.norm() > kFarthestCorner ? Eigen::Vector3d(kFarthestCorner * v.normalized()) : v;
}

}  // namespace

Inset::Inset(const geometry::TriangleMesh& mesh) : mesh_(mesh), signs_(outward_signs(mesh)) {
  if (signs_.empty()) return;
  std::vector<std::vector<ConstraintRow>> faces(mesh.vertices.size());
  for (std::size_t t = 0; t < signs_.size(); ++t) {
    const Eigen::Vector3d inwards = -signs_[t] * twice_area(mesh, t).normalized();
    if (!(inwards.squaredNorm() > 0.5)) continue;  // without area
    for (const std::int32_t vertex : mesh.triangles[t])
      faces[static_cast<std::size_t>(vertex)].push_back({inwards, Eigen::Vector3d::Zero(), 1.0});
  }
  ProjectionSolver solver;
  for (const std::vector<ConstraintRow>& of_vertex : faces)
    inwards_.push_back(way_inwards(solver, of_vertex));
}

geometry::TriangleMesh Inset::at(double depth) {
  GLISSADE_ASSERT(exists());
  geometry::TriangleMesh mesh = mesh_;
  for (std::size_t v = 0; v < inwards_.size(); ++v)
    mesh.vertices[v] += depth * inwards_[v];
  return mesh;
}

/// Moves the mesh of the tree. Returns whether there is anything left inside.
bool Inset::move(double depth) {
  if (!moved_) moved_ = std::make_shared<geometry::TriangleMesh>(mesh_);
  if (!tree_) tree_.emplace(moved_);
  *moved_ = at(depth);
  double area = 0.0;
  double turned_over = 0.0;
  double enclosed = 0.0;  // six times the volume
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    const Eigen::Vector3d before = twice_area(mesh_, t);
    area += before.norm();
    const Eigen::Vector3d after = twice_area(*moved_, t);
    if (before.dot(after) <= 0.0) turned_over += before.norm();
    enclosed += signs_[t] * after.dot(moved_->corner(static_cast<std::int32_t>(t), 0) - moved_->corner(0, 0));
  }
  if (turned_over > kTurnedOver * area || enclosed <= 0.0) return false;
  tree_->refit();
  return true;
}

std::optional<double> Inset::overlap(const ContactBody& body, const Eigen::Isometry3d& X_OV, double resolution) {
  if (!exists()) return std::nullopt;
  const auto meets = [&] { return collision::intersects(body.tree, *tree_, X_OV, workspace_); };
  double too_little = 0.0;
  double enough = resolution;
  bool is_any_left = move(enough);
  while (is_any_left && meets()) {
    too_little = enough;
    enough *= 2.0;
    if (enough > tree_->radius()) return std::nullopt;
    is_any_left = move(enough);
  }
  while (too_little > 0.0 && enough - too_little > std::max(resolution, kDepthPrecision * enough)) {
    const double middle = 0.5 * (too_little + enough);
    const bool is_left = move(middle);
    if (is_left && meets()) {
      too_little = middle;
    } else {
      enough = middle;
      is_any_left = is_left;
    }
  }
  if (!is_any_left) return std::nullopt;
  move(enough);
  if (encloses(body.tree.mesh(), X_OV * moved_->corner(0, 0))) return std::nullopt;
  return too_little == 0.0 ? 0.0 : enough;
}

}  // namespace glissade::contact
