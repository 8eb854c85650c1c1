#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include <glissade/base/require.h>
#include <glissade/geometry/triangle_mesh.h>
#include <glissade/shapes/sheet_metal.h>

#include "surfaces/planar_triangulation.h"

namespace glissade::shapes {
namespace {

// A vertex nearer than this to an edge of a bead's flank counts as on it: flat regions must be flat to the last bit.
constexpr double kOnOutline = 2e-7;

[[noreturn]] void reject_outline(const std::string& what, const RoundedRectangle& outline) {
  std::ostringstream message;
  message << what << ": the outline at (" << outline.center.transpose() << ") m of size (" << outline.size.transpose()
          << ") m and corner radius " << outline.corner_radius << " m.";
  throw std::invalid_argument(message.str());
}

void check_outline(const RoundedRectangle& outline) {
  base::require_positive("the size of an outline", outline.size.x());
  base::require_positive("the size of an outline", outline.size.y());
  const bool fits = outline.corner_radius >= 0 && outline.corner_radius <= outline.size.minCoeff() / 2 * (1 + 1e-12);
  if (!fits) reject_outline("A corner radius must be from 0 to half the smaller size", outline);
}

void check_within(const SheetMetal& sheet, const RoundedRectangle& outline) {
  check_outline(outline);
  const Eigen::Vector2d reach = outline.center.cwiseAbs() + outline.size / 2;
  const bool is_within = reach.x() < sheet.size.x() / 2 && reach.y() < sheet.size.y() / 2;
  if (!is_within) reject_outline("Holes and beads must lie within the sheet", outline);
}

void check(const SheetMetal& sheet) {
  check_outline({Eigen::Vector2d::Zero(), sheet.size, sheet.corner_radius});
  for (const RoundedRectangle& hole : sheet.holes) {
    check_within(sheet, hole);
  }
  for (const Bead& bead : sheet.beads) {
    check_within(sheet, bead.foot);
    base::require_positive("the flank_width of a bead", bead.flank_width);
    if (!std::isfinite(bead.height)) reject_outline("The height of a bead must be finite", bead.foot);
    if (bead.flank_width >= bead.foot.size.minCoeff() / 2)
      reject_outline("The flanks leave the bead no top", bead.foot);
  }
}

/// The longest edge that still resolves the outline near `point`, where edges are about `edge` long: short at its
/// corners, so that they are arcs, and shorter than its width elsewhere. Farther away edges may grow with the distance.
double allowed_edge(const RoundedRectangle& outline, const Eigen::Vector2d& point, double edge) {
  const double width = outline.size.minCoeff();
  double allowed = std::max(0.8 * width, 2.0 * (std::abs(signed_distance(outline, point)) - edge / 2));
  if (outline.corner_radius > 0) {
    const Eigen::Vector2d corner = outline.size / 2 - Eigen::Vector2d::Constant(outline.corner_radius);
    const double distance = ((point - outline.center).cwiseAbs() - corner).norm() - outline.corner_radius;
    allowed = std::min(allowed, std::max(1.2 * outline.corner_radius, 2.0 * (distance - edge / 2)));
  }
  return allowed;
}

double height_at(const SheetMetal& sheet, const Eigen::Vector2d& point) {
  double height = 0;
  for (const Bead& bead : sheet.beads) {
    const double depth = -signed_distance(bead.foot, point);
    if (depth <= kOnOutline) continue;
    height = depth >= bead.flank_width - kOnOutline ? bead.height : bead.height * depth / bead.flank_width;
  }
  return height;
}

geometry::TriangleMesh sheet_with_cells(const SheetMetal& sheet, double cell) {
  const RoundedRectangle blank{Eigen::Vector2d::Zero(), sheet.size, sheet.corner_radius};
  std::vector<RoundedRectangle> outlines = sheet.holes;
  if (sheet.corner_radius > 0) outlines.push_back(blank);
  for (const Bead& bead : sheet.beads) {
    outlines.push_back(bead.foot);
  }
  PlanarTriangulation plane(sheet.size, cell);
  plane.refine([&](const Eigen::Vector2d& point, double edge) {
    double allowed = edge;
    for (const RoundedRectangle& outline : outlines) {
      allowed = std::min(allowed, allowed_edge(outline, point, edge));
    }
    return allowed;
  });
  if (sheet.corner_radius > 0) {
    const auto beyond_blank = [&](const Eigen::Vector2d& point) { return signed_distance(blank, point); };
    plane.cut(beyond_blank);
    plane.discard_beyond(beyond_blank);
  }
  for (const RoundedRectangle& hole : sheet.holes) {
    const auto within_hole = [&](const Eigen::Vector2d& point) { return -signed_distance(hole, point); };
    plane.cut(within_hole);
    plane.discard_beyond(within_hole);
  }
  for (const Bead& bead : sheet.beads) {
    plane.cut([&](const Eigen::Vector2d& point) { return signed_distance(bead.foot, point); });
    plane.cut([&](const Eigen::Vector2d& point) { return signed_distance(bead.foot, point) + bead.flank_width; });
  }
  geometry::TriangleMesh mesh;
  for (const Eigen::Vector2d& vertex : plane.vertices()) {
    mesh.vertices.emplace_back(vertex.x(), vertex.y(), height_at(sheet, vertex));
  }
  mesh.triangles = plane.triangles();
  return geometry::weld(mesh);  // drops the vertices of the holes
}

}  // namespace

double signed_distance(const RoundedRectangle& outline, const Eigen::Vector2d& point) {
  const Eigen::Vector2d beyond =
      (point - outline.center).cwiseAbs() - outline.size / 2 + Eigen::Vector2d::Constant(outline.corner_radius);
  return beyond.cwiseMax(0.0).norm() + std::min(beyond.maxCoeff(), 0.0) - outline.corner_radius;
}

geometry::TriangleMesh make_sheet(const SheetMetal& sheet, std::int64_t triangle_count) {
  check(sheet);
  base::require_triangle_count(triangle_count);
  const auto wanted = static_cast<double>(triangle_count);
  double cell = std::sqrt(2 * sheet.size.x() * sheet.size.y() / wanted);
  geometry::TriangleMesh mesh = sheet_with_cells(sheet, cell);
  // Outlines add triangles and holes remove some: correct the cell size by the resulting count.
  for (int attempt = 0; attempt < 3; ++attempt) {
    const double ratio = static_cast<double>(mesh.triangles.size()) / wanted;
    if (std::abs(ratio - 1) < 0.05) break;
    cell = std::min(cell * std::sqrt(ratio), sheet.size.maxCoeff());
    mesh = sheet_with_cells(sheet, cell);
  }
  return mesh;
}

}  // namespace glissade::shapes
