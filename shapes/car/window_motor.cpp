#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <sstream>
#include <stdexcept>
#include <vector>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/triangle_mesh.h>
#include <glissade/shapes/car_door_parts.h>
#include <glissade/shapes/sheet_metal.h>

namespace glissade::shapes {
namespace {

// The axis of gearbox and drum, along y_V.
constexpr double kMotorGearX = 0.04;
constexpr double kMotorGearZ = -0.005;
constexpr double kGearRadius = 0.05;

/// A corner of a profile of revolution: radius and position along the axis.
using Profile = std::vector<Eigen::Vector2d>;

/// `profile` with its edges divided into steps of at most `step`.
Profile divided(const Profile& profile, double step) {
  Profile result{profile.front()};
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const Eigen::Vector2d edge = profile[i] - profile[i - 1];
    const int count = std::max(1, static_cast<int>(std::lround(edge.norm() / step)));
    for (int k = 1; k < count; ++k) {
      result.push_back(profile[i - 1] + edge * (static_cast<double>(k) / count));
    }
    result.push_back(profile[i]);
  }
  return result;
}

/// The solid of revolution of `profile` about z with about `triangle_count` triangles of about equal edges. Its
/// outermost radius is met exactly at four points, so that its bounds do not depend on the count.
geometry::TriangleMesh turned(const Profile& profile, double triangle_count) {
  double length = 0;
  double area = 0;
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const double edge = (profile[i] - profile[i - 1]).norm();
    length += edge;
    area += std::numbers::pi * edge * (profile[i].x() + profile[i - 1].x());
  }
  const double circumference = area / length;
  const double step = std::sqrt(2 * area / triangle_count);
  const int segments = std::max(8, 4 * static_cast<int>(std::lround(circumference / step / 4)));
  // The steps along the profile compensate for the rounding of the segments.
  const double profile_step = 2 * length * segments / triangle_count;
  return geometry::make_revolution(divided(profile, profile_step), false, segments);
}

/// Pose in V of the gear's frame, whose z axis is the gear's axis, parallel to y of V.
Eigen::Isometry3d gear_axis() {
  Eigen::Isometry3d X_VGear = Eigen::Isometry3d::Identity();
  X_VGear.linear() << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  X_VGear.translation() << kMotorGearX, 0, kMotorGearZ;
  return X_VGear;
}

geometry::TriangleMesh motor_can(double triangle_count) {
  // From the flat end with its bearing cap at x = -0.09 into the gearbox.
  const Profile profile{{0, 0},         {0.008, 0},     {0.008, 0.004}, {0.022, 0.004},
                        {0.026, 0.008}, {0.026, 0.075}, {0.022, 0.079}, {0.022, 0.100}};
  Eigen::Isometry3d X_VCan = Eigen::Isometry3d::Identity();
  X_VCan.linear() << 0, 0, 1, 1, 0, 0, 0, 1, 0;  // the can's z along x
  X_VCan.translation() << -kMotorHalfWidth, -0.004, 0.010;
  return geometry::transformed(turned(profile, triangle_count), X_VCan);
}

geometry::TriangleMesh gearbox(double triangle_count) {
  const Profile profile{{0, -0.034},     {0.046, -0.034}, {kGearRadius, -0.030}, {kGearRadius, -0.012},
                        {0.046, -0.008}, {0.030, -0.008}, {0.030, -0.004},       {0, -0.004}};
  return geometry::transformed(turned(profile, triangle_count), gear_axis());
}

geometry::TriangleMesh drum(double triangle_count) {
  const Profile profile{{0.010, -0.005},      {kDrumRadius, 0.000},     {kDrumRadius, 0.004},
                        {0.021, 0.009},       {0.021, 0.027},           {kDrumRadius, 0.032},
                        {kDrumRadius, 0.036}, {0.024, kMotorHalfDepth}, {0, kMotorHalfDepth}};
  return geometry::transformed(turned(profile, triangle_count), gear_axis());
}

/// Twelve radial ribs on the outer face of the gearbox.
void add_ribs(double triangle_count, std::vector<geometry::TriangleMesh>& parts) {
  constexpr int kRibs = 12;
  const geometry::TriangleMesh rib =
      geometry::make_box({0.014, 0.003, 0.006}, std::llround(std::max(12.0, triangle_count / kRibs)));
  for (int i = 0; i < kRibs; ++i) {
    const Eigen::AngleAxisd turn(2 * std::numbers::pi * i / kRibs, Eigen::Vector3d::UnitZ());
    const Eigen::Isometry3d X_GearRib = turn * Eigen::Translation3d(0.037, 0, -0.007);
    parts.push_back(geometry::transformed(rib, gear_axis() * X_GearRib));
  }
}

/// The sheet-metal bracket in the plane y = -kMotorHalfDepth, with its bolt holes at those of the panel.
geometry::TriangleMesh bracket(double triangle_count) {
  const Eigen::Vector2d center(0.0125, 0.005);  // x and z of V
  SheetMetal sheet;
  sheet.size = {0.145, 0.1};
  sheet.corner_radius = 0.012;
  for (const double x_V : {-0.05, 0.075}) {
    for (const double z_V : {-0.035, 0.045}) {
      sheet.holes.push_back({{x_V - center.x(), -(z_V - center.y())}, {0.007, 0.007}, 0.0035});
    }
  }
  sheet.holes.push_back({{kMotorGearX - center.x(), -(kMotorGearZ - center.y())}, {0.03, 0.03}, 0.015});
  Eigen::Isometry3d X_VSheet = Eigen::Isometry3d::Identity();
  X_VSheet.linear() << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  X_VSheet.translation() << center.x(), -kMotorHalfDepth, center.y();
  return geometry::transformed(make_sheet(sheet, std::llround(std::max(1.0, triangle_count))), X_VSheet);
}

/// Three spacers between bracket and gearbox.
void add_spacers(double triangle_count, std::vector<geometry::TriangleMesh>& parts) {
  const geometry::TriangleMesh spacer =
      turned({{0, -0.0375}, {0.006, -0.0375}, {0.006, -0.03}, {0, -0.03}}, triangle_count / 3);
  for (int i = 0; i < 3; ++i) {
    const Eigen::AngleAxisd turn(2 * std::numbers::pi * i / 3, Eigen::Vector3d::UnitZ());
    const Eigen::Isometry3d X_GearSpacer = turn * Eigen::Translation3d(0.032, 0, 0);
    parts.push_back(geometry::transformed(spacer, gear_axis() * X_GearSpacer));
  }
}

}  // namespace

geometry::TriangleMesh make_window_motor(double detail) {
  if (!(detail >= 0.001 && detail <= 100)) {
    std::ostringstream message;
    message << "detail must be from 0.001 to 100, but is " << detail << ".";
    throw std::invalid_argument(message.str());
  }
  std::vector<geometry::TriangleMesh> parts{motor_can(13'000 * detail), gearbox(13'000 * detail), drum(8'000 * detail),
                                            bracket(11'000 * detail)};
  add_ribs(2'400 * detail, parts);
  add_spacers(1'500 * detail, parts);
  Eigen::Isometry3d X_VPlug = Eigen::Isometry3d::Identity();
  X_VPlug.translation() << -0.02, -0.004, 0.038;  // the connector sits on top of the can
  parts.push_back(geometry::transformed(
      geometry::make_box({0.03, 0.02, 0.016}, std::llround(std::max(12.0, 1'100 * detail))), X_VPlug));
  return geometry::merge(parts);
}

}  // namespace glissade::shapes
