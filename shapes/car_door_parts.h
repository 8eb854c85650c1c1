#pragma once

/// The parts of the demonstration's assembly. The path of the window motor leads through the access hole of a car
/// door's inner panel, past the side-impact tube, to the motor's seat on the back of the inner panel.
///
/// All parts except the motor are given in the world frame W: x forward along the car, y outwards from the cabin (the
/// hand is at y < 0), z up. The motor is given in its own frame V. The origin of V is near the motor's centre, and its
/// axes are parallel to those of W when the motor is seated. `detail` scales the number of triangles, not the
/// dimensions. A `detail` of 1 gives the motor about 50,000 triangles, and the four door parts together as many.
/// Functions throw std::invalid_argument if `detail` is outside 0.001 ... 100. Sheet metal is open, without thickness.

#include <Eigen/Geometry>

#include <glissade/geometry/triangle_mesh.h>
#include <glissade/shapes/sheet_metal.h>

namespace glissade::shapes {

/// Inner panel in the plane y = 0: 0.9 m × 0.6 m about the origin.
inline constexpr double kInnerPanelWidth = 0.9;
inline constexpr double kInnerPanelHeight = 0.6;

/// Access hole of the inner panel, with size and centre along x and z, and corner radius, in metres.
inline constexpr double kAccessHoleWidth = 0.22;
inline constexpr double kAccessHoleHeight = 0.15;
inline constexpr double kAccessHoleX = 0.0;
inline constexpr double kAccessHoleZ = -0.14;
inline constexpr double kAccessHoleCornerRadius = 0.025;

/// The axis of the side-impact tube is parallel to x at y = kImpactTubeY and z = kImpactTubeZ.
inline constexpr double kImpactTubeY = 0.105;
inline constexpr double kImpactTubeZ = 0.0;
inline constexpr double kImpactTubeRadius = 0.016;
inline constexpr double kImpactTubeLength = 0.86;

/// The bead above the seat stops the bracket. The foot of the bead's lower flank is the line z = kStopBeadZ, y = 0. The
/// bead rises towards y > 0. The panel between bead and access hole is exactly flat except for the bolt holes.
inline constexpr double kStopBeadZ = 0.2;

/// Bounds of the motor: x in [-0.09, 0.09], y in [-0.038, 0.038], z in [-0.055, 0.055] of V.
inline constexpr double kMotorHalfWidth = 0.09;
inline constexpr double kMotorHalfDepth = 0.038;
inline constexpr double kMotorHalfHeight = 0.055;

/// The axis of the motor's drum is the line x = 0.04, z = -0.005 of V. Only the drum reaches beyond y = 0.02 of V.
inline constexpr double kDrumRadius = 0.026;

/// Start pose of the motor: in the cabin in front of the access hole, without contact.
Eigen::Isometry3d start_pose_WV();

/// Seat pose of the motor. The bracket lies flush on the back of the inner panel, and its upper edge meets the foot of
/// the stop bead. Both distances are exactly zero.
Eigen::Isometry3d seat_pose_WV();

/// Inner panel with access hole, stiffening beads and the bolt holes of the motor's bracket.
SheetMetal inner_panel_layout();
geometry::TriangleMesh make_door_inner_panel(double detail);

/// Outer panel, gently curved: y rises from about 0.13 at the corners to 0.165 in the middle.
geometry::TriangleMesh make_door_outer_panel(double detail);

/// Side-impact tube, an open shell.
geometry::TriangleMesh make_door_impact_tube(double detail);

/// A hose of 20 mm diameter that winds from the lower rear past the outer side of the impact tube to the upper front.
geometry::TriangleMesh make_door_hose(double detail);

/// The window motor in its frame V, as one mesh of a motor can, a gearbox with ribs, a cable drum, a connector and a
/// sheet-metal bracket. Some of these components overlap.
geometry::TriangleMesh make_window_motor(double detail);

}  // namespace glissade::shapes
