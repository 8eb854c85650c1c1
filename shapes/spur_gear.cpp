#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/base/require.h>
#include <glissade/shapes/spur_gear.h>

#include "surfaces/loop_mesh.h"

namespace glissade::shapes {
namespace {

double involute(double pressure_angle) {
  return std::tan(pressure_angle) - pressure_angle;
}

struct FlankPoint {
  double radius;
  double half_angle;  // between the middle of the tooth and its flank
};

// From the root to the tip.
std::vector<FlankPoint> flank_of(const GearShape& gear) {
  const double pitch_radius = gear.module * gear.teeth / 2;
  const double base_radius = pitch_radius * std::cos(gear.pressure_angle);
  const double root_radius = pitch_radius - 1.25 * gear.module;
  const double tip_radius = pitch_radius + gear.module;
  const double start = std::max(base_radius, root_radius);
  std::vector<FlankPoint> flank;
  for (int i = 0; i < gear.flank_points; ++i) {
    const double radius = start + (tip_radius - start) * i / (gear.flank_points - 1);
    const double angle_at_radius = std::acos(std::min(1.0, base_radius / radius));
    flank.push_back(
        {radius, std::numbers::pi / (2 * gear.teeth) + involute(gear.pressure_angle) - involute(angle_at_radius)});
  }
  if (root_radius < base_radius) flank.insert(flank.begin(), {root_radius, flank.front().half_angle});
  return flank;
}

// Begins at the root before the tooth that lies on the x axis.
Loop outline_of(const GearShape& gear, const std::vector<FlankPoint>& flank) {
  Loop loop;
  const auto add = [&](double radius, double angle) {
    loop.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  };
  for (int tooth = 0; tooth < gear.teeth; ++tooth) {
    const double middle = 2 * std::numbers::pi * tooth / gear.teeth;
    for (auto point = flank.begin(); point != flank.end(); ++point)
      add(point->radius, middle - point->half_angle);
    for (auto point = flank.rbegin(); point != flank.rend(); ++point)
      add(point->radius, middle + point->half_angle);
  }
  return loop;
}

// The bore begins beside the tooth that lies on the x axis: a facet for each tooth and one for each gap.
Loop bore_of(const GearShape& gear) {
  const Eigen::Rotation2Dd turn(-std::numbers::pi / (2 * gear.teeth));
  Loop loop;
  for (const Eigen::Vector2d& point : round_loop(gear.bore_radius, 2 * gear.teeth))
    loop.emplace_back(turn * point);
  return loop;
}

// Adds the face between bore and outline, upwards if `faces_up`: each tooth is a ladder of quadrilaterals between its
// flanks and stands on the ring around the bore.
void add_face(LoopMesh& mesh, int outline, int bore, int teeth, int points_per_flank, bool faces_up) {
  const auto add = [&](std::array<LoopMesh::Point, 4> corners) {
    if (!faces_up) std::ranges::reverse(corners);
    mesh.add_quad(corners);
  };
  for (int tooth = 0; tooth < teeth; ++tooth) {
    const int left = 2 * tooth * points_per_flank;  // foot of the flank that rises along the outline
    const int right = left + 2 * points_per_flank - 1;
    const int below = 2 * tooth;
    add({{{bore, below}, {outline, left}, {outline, right}, {bore, below + 1}}});
    add({{{bore, below + 1}, {outline, right}, {outline, right + 1}, {bore, below + 2}}});
    for (int i = 0; i + 1 < points_per_flank; ++i)
      add({{{outline, left + i}, {outline, left + i + 1}, {outline, right - i - 1}, {outline, right - i}}});
  }
}

}  // namespace

geometry::TriangleMesh make_spur_gear(const GearShape& gear) {
  base::require_count("teeth", gear.teeth, 8, 1000);
  base::require_positive("module", gear.module);
  base::require_positive("width", gear.width);
  base::require_positive("bore_radius", gear.bore_radius);
  base::require_count("flank_points", gear.flank_points, 2, 1000);
  base::require_count("rows", gear.rows, 1, 10'000);
  base::require_between("pressure_angle", gear.pressure_angle, 0.2, 0.5);
  const std::vector<FlankPoint> flank = flank_of(gear);
  base::require_below("bore_radius", gear.bore_radius, "0.8 of the root radius", 0.8 * flank.front().radius);
  const Loop outline = outline_of(gear, flank);
  const auto points_per_flank = static_cast<int>(flank.size());
  const Loop bore = bore_of(gear);
  LoopMesh mesh;
  const int lower = mesh.add_loop(outline, 0.0);
  const int upper = mesh.add_wall(lower, outline, 0.0, gear.width, gear.rows);
  const int upper_bore = mesh.add_loop(bore, gear.width);
  const int lower_bore = mesh.add_wall(upper_bore, bore, gear.width, 0.0, gear.rows);
  add_face(mesh, lower, lower_bore, gear.teeth, points_per_flank, false);
  add_face(mesh, upper, upper_bore, gear.teeth, points_per_flank, true);
  return mesh.mesh();
}

geometry::TriangleMesh make_gear_base(const GearBaseShape& base) {
  base::require_positive("size", base.size);
  base::require_positive("thickness", base.thickness);
  base::require_positive("post_radius", base.post_radius);
  base::require_positive("post_height", base.post_height);
  base::require_positive("chamfer", base.chamfer);
  base::require_below("chamfer", base.chamfer, "the post's radius", base.post_radius);
  base::require_below("chamfer", base.chamfer, "the post's height", base.post_height);
  base::require_count("segments", base.segments, 8, 100'000, 8);
  const double corner_radius = base.post_radius / std::cos(std::numbers::pi / base.segments);
  base::require_below("the post's diameter over its corners", 2 * corner_radius, "the size", base.size);
  const Loop square = polygon_loop(4, base.size / 2, base.segments);
  const Loop wide = round_loop(base.post_radius, base.segments);
  const Loop narrow = round_loop(base.post_radius - base.chamfer, base.segments);
  LoopMesh mesh;
  const int bottom = mesh.add_loop(square, -base.thickness);
  const int edge = mesh.add_wall(bottom, square, -base.thickness, 0.0, 1);
  const int foot = mesh.add_loop(wide, 0.0);
  mesh.add_band(edge, foot);
  const int shoulder = mesh.add_wall(foot, wide, 0.0, base.post_height - base.chamfer, 1);
  const int top = mesh.add_wall(shoulder, narrow, base.post_height - base.chamfer, base.post_height, 1);
  mesh.add_cap(bottom, false);
  mesh.add_cap(top, true);
  return mesh.mesh();
}

}  // namespace glissade::shapes
