#include <cmath>
#include <numbers>

#include <glissade/apps/scene/parts_inside.h>
#include <glissade/apps/text.h>
#include <glissade/collision/dop_query.h>
#include <glissade/geometry/mesh_topology.h>

namespace glissade::apps {

namespace {

/// The solid angle of a triangle seen from the origin (van Oosterom and Strackee).
double solid_angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double la = a.norm();
  const double lb = b.norm();
  const double lc = c.norm();
  return 2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

/// Whether a closed surface, whose triangles have one orientation, winds round a point beside it: the solid angles sum
/// up to a multiple of the full one, and rounding is far from a half of that.
bool winds_round(const geometry::TriangleMesh& mesh, const Eigen::Vector3d& p) {
  double sum = 0.0;
  for (std::int32_t triangle = 0; triangle < std::ssize(mesh.triangles); ++triangle)
    sum += solid_angle(mesh.corner(triangle, 0) - p, mesh.corner(triangle, 1) - p, mesh.corner(triangle, 2) - p);
  return std::abs(sum) > 2.0 * std::numbers::pi;
}

bool is_inside(const collision::DopTree& part, const Eigen::Isometry3d& X_OV, const collision::DopTree& obstacle,
               collision::QueryWorkspace& workspace) {
  const geometry::TriangleMesh& mesh = obstacle.mesh();
  if (!winds_round(mesh, X_OV * part.mesh().corner(0, 0))) return false;
  const geometry::MeshReport report = geometry::report(mesh);
  return report.is_watertight && report.inconsistent_edges == 0 &&
         !collision::intersects(obstacle, part, X_OV, workspace);
}

}  // namespace

std::vector<std::string> parts_inside(const HapticScene& scene, std::span<const Eigen::Isometry3d> X_WV) {
  collision::QueryWorkspace workspace;
  std::vector<std::string> sentences;
  for (std::size_t p = 0; p < X_WV.size(); ++p) {
    for (const haptics::Obstacle& obstacle : scene.obstacles) {
      const Eigen::Isometry3d X_OV = obstacle.X_WO.inverse(Eigen::Isometry) * X_WV[p];
      if (!is_inside(scene.parts[p].part_V->tree, X_OV, obstacle.body->tree, workspace)) continue;
      sentences.push_back("part " + in_quotes(scene.parts[p].name) + " starts inside the closed surface of " +
                          obstacle.name + ", and cannot get out");
    }
  }
  return sentences;
}

std::vector<std::string> parts_inside(const HapticScene& scene) {
  std::vector<Eigen::Isometry3d> X_WV;
  for (const ScenePart& part : scene.parts)
    X_WV.push_back(part.X_WV_start);
  return parts_inside(scene, X_WV);
}

}  // namespace glissade::apps
