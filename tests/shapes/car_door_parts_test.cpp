#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/geometry/mesh_topology.h>
#include <glissade/geometry/triangle_mesh.h>
#include <glissade/shapes/car_door_parts.h>

namespace glissade::shapes {
namespace {

std::vector<geometry::TriangleMesh> door(double detail) {
  return {make_door_inner_panel(detail), make_door_outer_panel(detail), make_door_impact_tube(detail),
          make_door_hose(detail)};
}

TEST(CarDoorParts, FiftyThousandTrianglesASideAtFullDetail) {
  EXPECT_NEAR(static_cast<double>(geometry::merge(door(1)).triangles.size()), 50'000, 2'500);
  EXPECT_NEAR(static_cast<double>(make_window_motor(1).triangles.size()), 50'000, 2'500);
}

TEST(CarDoorParts, DimensionsDoNotDependOnDetail) {
  for (const double detail : {0.02, 0.1, 0.5}) {
    SCOPED_TRACE(detail);
    const geometry::MeshReport motor = geometry::report(make_window_motor(detail));
    const Eigen::Vector3d half(kMotorHalfWidth, kMotorHalfDepth, kMotorHalfHeight);
    EXPECT_TRUE(motor.bounds.min().isApprox(-half, 1e-12)) << motor.bounds.min().transpose();
    EXPECT_TRUE(motor.bounds.max().isApprox(half, 1e-12)) << motor.bounds.max().transpose();
    const geometry::MeshReport panel = geometry::report(make_door_inner_panel(detail));
    EXPECT_DOUBLE_EQ(panel.bounds.sizes().x(), kInnerPanelWidth);
    EXPECT_DOUBLE_EQ(panel.bounds.sizes().z(), kInnerPanelHeight);
    EXPECT_DOUBLE_EQ(panel.bounds.max().y(), 0.006) << "the stop bead";
    EXPECT_DOUBLE_EQ(panel.bounds.min().y(), -0.006) << "the stiffening beads";
  }
}

TEST(CarDoorParts, MotorPassesTheAccessHoleWithClearanceAllRound) {
  const double clearance_x = kAccessHoleWidth / 2 - kMotorHalfWidth;
  const double clearance_z = kAccessHoleHeight / 2 - kMotorHalfHeight;
  EXPECT_GE(clearance_x, 0.012);
  EXPECT_GE(clearance_z, 0.012);
  // Nothing of the panel is where the motor's outline, widened by the clearance, passes through.
  for (const Eigen::Vector3d& p : make_door_inner_panel(0.3).vertices) {
    const bool is_within = std::abs(p.x() - kAccessHoleX) < kMotorHalfWidth + 0.012 &&
                           std::abs(p.z() - kAccessHoleZ) < kMotorHalfHeight + 0.012;
    if (is_within) {
      const RoundedRectangle hole = inner_panel_layout().holes.front();
      EXPECT_GT(signed_distance(hole, {p.x(), -p.z()}), -2e-7);
    }
  }
}

TEST(CarDoorParts, MotorPassesTheImpactTubeCloseToThePanel) {
  const double passage = kImpactTubeY - kImpactTubeRadius - 2 * kMotorHalfDepth;
  EXPECT_GE(passage, 0.010) << "5 mm on either side";
  EXPECT_LE(passage, 0.020);
}

TEST(CarDoorParts, SeatIsFlushWithThePanelAndTheStopBead) {
  const geometry::TriangleMesh motor_W = geometry::transformed(make_window_motor(0.1), seat_pose_WV());
  const geometry::TriangleMesh panel_W = make_door_inner_panel(0.1);
  double lowest = 1;
  double bracket_top = -1;
  for (const Eigen::Vector3d& p : motor_W.vertices) {
    lowest = std::min(lowest, p.y());
    if (p.y() < 1e-9) bracket_top = std::max(bracket_top, p.z());
  }
  EXPECT_NEAR(lowest, 0, 1e-15);
  EXPECT_NEAR(bracket_top, kStopBeadZ, 1e-15);
  const Eigen::AlignedBox3d motor_bounds = geometry::report(motor_W).bounds;
  double foot = 1;
  for (const Eigen::Vector3d& p : panel_W.vertices) {
    const bool is_behind_motor = p.x() > motor_bounds.min().x() && p.x() < motor_bounds.max().x() &&
                                 p.z() > motor_bounds.min().z() && p.z() < motor_bounds.max().z() - 1e-6;
    if (is_behind_motor) {
      EXPECT_EQ(p.y(), 0) << p.transpose();
    }
    const bool is_stop_bead = p.y() > 0;
    if (is_stop_bead) foot = std::min(foot, p.z());
  }
  EXPECT_GE(foot, kStopBeadZ);
}

TEST(CarDoorParts, MotorStartsInTheCabin) {
  const geometry::MeshReport motor = geometry::report(geometry::transformed(make_window_motor(0.05), start_pose_WV()));
  EXPECT_LT(motor.bounds.max().y(), -0.1);
}

TEST(CarDoorParts, PartsAreSoundAndSheetMetalIsOpen) {
  for (const geometry::TriangleMesh& part : door(0.1)) {
    const geometry::MeshReport r = geometry::report(part);
    EXPECT_EQ(r.nonmanifold_edges, 0);
    EXPECT_EQ(r.inconsistent_edges, 0);
    EXPECT_EQ(r.duplicates, 0);
    EXPECT_EQ(r.components, 1);
    EXPECT_GT(r.open_edges, 0);
  }
}

TEST(CarDoorParts, RejectsADetailOutOfRange) {
  EXPECT_THROW(make_window_motor(0), std::invalid_argument);
  EXPECT_THROW(make_window_motor(-1), std::invalid_argument);
  EXPECT_THROW(make_door_inner_panel(1000), std::invalid_argument);
  EXPECT_THROW(make_door_hose(std::nan("")), std::invalid_argument);
}

}  // namespace
}  // namespace glissade::shapes
