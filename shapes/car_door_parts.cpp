#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <vector>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/triangle_mesh.h>
#include <glissade/shapes/car_door_parts.h>

namespace glissade::shapes {
namespace {

constexpr double kBoltHoleRadius = 0.004;
constexpr double kBeadHeight = 0.006;
constexpr double kBeadFlank = 0.003;

std::int64_t scaled(double triangles, double detail) {
  if (!(detail >= 0.001 && detail <= 100)) {
    std::ostringstream message;
    message << "detail must be from 0.001 to 100, but is " << detail << ".";
    throw std::invalid_argument(message.str());
  }
  return std::llround(triangles * detail);
}

/// Pose of a sheet at `y`: its (x, y) plane is the (x, -z) plane of the door, its normal points outwards along y.
Eigen::Isometry3d upright(double y) {
  Eigen::Isometry3d X_WSheet = Eigen::Isometry3d::Identity();
  X_WSheet.linear() << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  X_WSheet.translation().y() = y;
  return X_WSheet;
}

RoundedRectangle outline(double x, double z, double width, double height, double corner_radius) {
  return {{x, -z}, {width, height}, corner_radius};
}

RoundedRectangle round_hole(double x, double z, double radius) {
  return outline(x, z, 2 * radius, 2 * radius, radius);
}

Bead bead(double x, double z, double width, double height, double rise) {
  return {outline(x, z, width, height, std::min(width, height) / 2), rise, kBeadFlank};
}

}  // namespace

Eigen::Isometry3d start_pose_WV() {
  Eigen::Isometry3d X_WV = Eigen::Isometry3d::Identity();
  X_WV.translation() << 0.0, -0.25, -0.19;
  return X_WV;
}

Eigen::Isometry3d seat_pose_WV() {
  Eigen::Isometry3d X_WV = Eigen::Isometry3d::Identity();
  X_WV.translation() << -0.05, kMotorHalfDepth, kStopBeadZ - kMotorHalfHeight;
  return X_WV;
}

SheetMetal inner_panel_layout() {
  SheetMetal panel;
  panel.size = {kInnerPanelWidth, kInnerPanelHeight};
  panel.holes.push_back(
      outline(kAccessHoleX, kAccessHoleZ, kAccessHoleWidth, kAccessHoleHeight, kAccessHoleCornerRadius));
  // The stop bead rises outwards, against the bracket; the others sink towards the cabin, out of the motor's way.
  constexpr double kStopBeadWidth = 0.024;
  panel.beads.push_back(bead(-0.05, kStopBeadZ + kStopBeadWidth / 2, 0.3, kStopBeadWidth, kBeadHeight));
  panel.beads.push_back(bead(0.0, 0.26, 0.6, 0.04, -kBeadHeight));
  for (const double side : {-1.0, 1.0}) {
    panel.beads.push_back(bead(side * 0.32, -0.05, 0.04, 0.36, -kBeadHeight));
    panel.holes.push_back(round_hole(side * 0.4, 0.1, 0.012));
  }
  const Eigen::Vector3d p_WV = seat_pose_WV().translation();
  for (const double x_V : {-0.05, 0.075}) {
    for (const double z_V : {-0.035, 0.045}) {
      panel.holes.push_back(round_hole(p_WV.x() + x_V, p_WV.z() + z_V, kBoltHoleRadius));
    }
  }
  return panel;
}

geometry::TriangleMesh make_door_inner_panel(double detail) {
  return geometry::transformed(make_sheet(inner_panel_layout(), scaled(30'000, detail)), upright(0));
}

geometry::TriangleMesh make_door_outer_panel(double detail) {
  geometry::TriangleMesh panel = geometry::transformed(
      geometry::make_plate({kInnerPanelWidth, kInnerPanelHeight}, scaled(10'000, detail)), upright(0));
  for (Eigen::Vector3d& point : panel.vertices) {
    const double u = point.x() / (kInnerPanelWidth / 2);
    const double v = point.z() / (kInnerPanelHeight / 2);
    point.y() = 0.165 - 0.01 * u * u - 0.025 * v * v;
  }
  return panel;
}

geometry::TriangleMesh make_door_impact_tube(double detail) {
  Eigen::Isometry3d X_WTube = Eigen::Isometry3d::Identity();
  X_WTube.linear() << 0, 0, 1, 1, 0, 0, 0, 1, 0;  // the tube's z along x
  X_WTube.translation() << 0, kImpactTubeY, kImpactTubeZ;
  return geometry::transformed(geometry::make_tube(kImpactTubeRadius, kImpactTubeLength, scaled(5'000, detail)),
                               X_WTube);
}

geometry::TriangleMesh make_door_hose(double detail) {
  const std::vector<Eigen::Vector3d> points{{-0.42, 0.05, -0.24}, {-0.28, 0.09, -0.13}, {-0.12, 0.137, -0.03},
                                            {0.05, 0.139, 0.04},  {0.22, 0.12, 0.12},   {0.38, 0.07, 0.25}};
  return geometry::make_hose(points, 0.010, scaled(5'000, detail));
}

}  // namespace glissade::shapes
