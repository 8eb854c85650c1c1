// Gear and base against closed forms: teeth, involutes, areas, and the gear on its seat.

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <glissade/collision/dop_query.h>
#include <glissade/geometry/mesh_topology.h>
#include <glissade/shapes/spur_gear.h>

#include "enclosed_volume.h"
#include "expect_bad_input.h"

namespace glissade::shapes {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using std::numbers::pi;
using test_support::enclosed_volume;
using test_support::expect_bad_input;

// The points of the gear's outline, in the order of the mesh: counterclockwise.
std::vector<Vector2d> outline_of(const geometry::TriangleMesh& mesh, const GearShape& gear) {
  const double bore_corner = 1.1 * gear.bore_radius;
  std::vector<Vector2d> points;
  for (const Eigen::Vector3d& p : mesh.vertices) {
    if (p.z() == 0.0 && p.head<2>().norm() > bore_corner) points.emplace_back(p.head<2>());
  }
  return points;
}

double area_of(const std::vector<Vector2d>& polygon) {
  double area = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d& p = polygon[i];
    const Vector2d& q = polygon[(i + 1) % polygon.size()];
    area += (p.x() * q.y() - p.y() * q.x()) / 2;
  }
  return area;
}

TEST(SpurGear, ToothCountIsRightAndTeethFillHalfThePitchCircle) {
  for (const int teeth : {8, 24, 45, 100}) {
    const GearShape gear{.teeth = teeth, .bore_radius = 1e-3, .flank_points = 200};
    const std::vector<Vector2d> outline = outline_of(make_spur_gear(gear), gear);
    const double pitch_radius = gear.module * teeth / 2;
    int crossings = 0;
    double inside_teeth = 0.0;  // radians of the pitch circle
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vector2d& p = outline[i];
      const Vector2d& q = outline[(i + 1) % outline.size()];
      if ((p.norm() > pitch_radius) == (q.norm() > pitch_radius)) continue;
      ++crossings;
      const double t = (pitch_radius - p.norm()) / (q.norm() - p.norm());
      const Vector2d crossing = p + t * (q - p);
      // Angle from the middle of the nearest tooth.
      const double angle = std::remainder(std::atan2(crossing.y(), crossing.x()), 2 * pi / teeth);
      inside_teeth += std::abs(angle);
    }
    EXPECT_EQ(crossings, 2 * teeth);
    EXPECT_NEAR(inside_teeth, pi, 1e-4);
  }
}

TEST(SpurGear, NormalsOfItsFlanksTouchTheBaseCircle) {
  const GearShape gear{.teeth = 50, .flank_points = 100};
  const std::vector<Vector2d> outline = outline_of(make_spur_gear(gear), gear);
  const double base_radius = gear.module * gear.teeth / 2 * std::cos(gear.pressure_angle);
  int flanks = 0;
  for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
    const Vector2d chord = outline[i + 1] - outline[i];
    if (std::abs(outline[i].norm() - outline[i + 1].norm()) < 1e-7) continue;  // tip or root
    ++flanks;
    const Vector2d middle = 0.5 * (outline[i] + outline[i + 1]);
    EXPECT_NEAR(std::abs(middle.dot(chord.normalized())), base_radius, 2e-3 * base_radius);
  }
  EXPECT_GE(flanks, 50 * 2 * 99 - 1);
}

TEST(SpurGear, IsClosedAndItsFacesAreNotFolded) {
  for (const GearShape& gear :
       {GearShape{}, GearShape{.teeth = 8, .bore_radius = 1.5e-3}, GearShape{.teeth = 60, .rows = 12}}) {
    const geometry::TriangleMesh mesh = make_spur_gear(gear);
    const geometry::MeshReport r = geometry::report(mesh);
    EXPECT_TRUE(r.is_watertight);
    EXPECT_EQ(r.inconsistent_edges, 0);
    EXPECT_EQ(r.degenerate, 0);
    const std::vector<Vector2d> outline = outline_of(mesh, gear);
    const double facets = 2.0 * gear.teeth;
    const double face = area_of(outline) - facets * std::tan(pi / facets) * std::pow(gear.bore_radius, 2);
    EXPECT_NEAR(enclosed_volume(mesh), gear.width * face, 1e-9 * gear.width * face);
    double flat = 0.0;
    for (const geometry::Triangle& t : mesh.triangles) {
      const auto at = [&](std::size_t i) { return mesh.vertices[static_cast<std::size_t>(t[i])]; };
      flat += std::abs((at(1) - at(0)).cross(at(2) - at(0)).z()) / 2;
    }
    EXPECT_NEAR(flat, 2 * face, 1e-9 * face) << "a folded face has more area";
    EXPECT_EQ(r.triangles, (2 * std::ssize(outline) + 4 * gear.teeth) * (gear.rows + 1));
  }
}

TEST(GearOnItsBase, ComesDownToAFlatSeat) {
  const GearShape gear;
  const GearBaseShape base;
  const collision::DopTree gear_tree(std::make_shared<geometry::TriangleMesh>(make_spur_gear(gear)));
  const collision::DopTree base_tree(std::make_shared<geometry::TriangleMesh>(make_gear_base(base)));
  collision::QueryWorkspace workspace;
  const auto lifted = [](double z) { return Isometry3d(Eigen::Translation3d(0.0, 0.0, z)); };
  EXPECT_TRUE(intersects(base_tree, gear_tree, lifted(0.0), workspace)) << "touches in its seat";
  for (const double lift : {1e-6, 1e-4, 0.3e-3})
    EXPECT_NEAR(collision::distance(base_tree, gear_tree, lifted(lift), workspace).distance, lift, 1e-12);
  // Further up, the post's corners and the bore's facets are nearest.
  const double radial = collision::distance(base_tree, gear_tree, lifted(5e-3), workspace).distance;
  EXPECT_LE(radial, gear.bore_radius - base.post_radius);
  EXPECT_GE(radial, gear.bore_radius - base.post_radius / std::cos(pi / base.segments) - 1e-12);
}

TEST(GearOnItsBase, TheBaseIsClosed) {
  const GearBaseShape base;
  const geometry::TriangleMesh mesh = make_gear_base(base);
  const geometry::MeshReport r = geometry::report(mesh);
  EXPECT_TRUE(r.is_watertight);
  EXPECT_EQ(r.inconsistent_edges, 0);
  EXPECT_EQ(r.triangles, 10 * base.segments);
  const double polygon = base.segments * std::tan(pi / base.segments);
  const double wide = base.post_radius, narrow = base.post_radius - base.chamfer;
  EXPECT_NEAR(enclosed_volume(mesh),
              base.size * base.size * base.thickness +
                  polygon * (wide * wide * (base.post_height - base.chamfer) +
                             base.chamfer * (wide * wide + wide * narrow + narrow * narrow) / 3),
              1e-15);
}

TEST(SpurGear, ErrorsNameTheArgumentAndItsValue) {
  expect_bad_input([] { make_spur_gear({.teeth = 7}); }, {"teeth", "7"});
  expect_bad_input([] { make_spur_gear({.bore_radius = 9e-3}); }, {"bore_radius", "0.009"});
  expect_bad_input([] { make_spur_gear({.pressure_angle = 0.1}); }, {"pressure_angle", "0.1"});
  expect_bad_input([] { make_gear_base({.chamfer = 6e-3}); }, {"chamfer", "0.006"});
  expect_bad_input([] { make_gear_base({.segments = 12}); }, {"segments", "12"});
}

}  // namespace
}  // namespace glissade::shapes
