#pragma once

/// Solids and sheets for a patchwork: revolutions, prisms, plates with holes, walls and wires.

#include <functional>
#include <memory>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "surfaces/patch_work.h"

namespace glissade::shapes {

/// A curve in a plane over the parameters of `axis`.
struct PlaneCurve {
  Axis axis;
  std::function<Eigen::Vector2d(double)> point;
};

/// A corner of a path, rounded by an arc of this radius.
struct Corner {
  double x;
  double y;
  double radius = 0;
};

/// Open or closed polygon with rounded corners; the ends of an open one stay sharp. Each straight piece gets at least
/// `least` cells, each arc one per started right angle or more. Arcs must fit between their neighbors.
PlaneCurve rounded_path(const std::vector<Corner>& corners, bool is_closed, int least = 1);

PlaneCurve rectangle(const Eigen::Vector2d& size, double corner_radius, int least = 1);
PlaneCurve circle(double radius, int least);

/// Closed outline of a spur gear with `teeth` trapezoidal teeth.
PlaneCurve gear_outline(double root_radius, double tip_radius, int teeth);

/// `outline` (closed) scaled about the origin by x and lifted by y of each point of `profile`; ends of the profile at
/// x = 0 close it with a fan. With the circle of radius 1: the surface of revolution of `profile` (r, z).
void add_turned(PatchWork& work, const PlaneCurve& outline, const PlaneCurve& profile);
void add_revolution(PatchWork& work, const PlaneCurve& profile, int least_around);

/// The solid between z = low and z = high within `outline`, which must be star-shaped about the origin.
void add_prism(PatchWork& work, const PlaneCurve& outline, double low, double high);

/// The same with a round hole about the origin. The hole is as fine as the outline.
void add_pierced_prism(PatchWork& work, const PlaneCurve& outline, double hole_radius, double low, double high);

/// Solid box about the origin, one component.
void add_box(PatchWork& work, const Eigen::Vector3d& size);

/// Rectangle of a plate, with a round hole where hole_radius > 0.
struct Tile {
  Eigen::Vector2d low;
  Eigen::Vector2d high;
  Eigen::Vector2d hole = Eigen::Vector2d::Zero();
  double hole_radius = 0;
};

/// One face of a plate at the height z: long triangles in tiles without a hole, rings around holes.
void add_tiles(PatchWork& work, const std::vector<Tile>& tiles, double z);

/// Both faces of a plate and the walls of its holes. Its outer border is left open.
void add_tiled_plate(PatchWork& work, const std::vector<Tile>& tiles, double low, double high);

/// A wall along a curve from z = low to z = high.
void add_wall(PatchWork& work, const PlaneCurve& curve, double low, double high);

/// A curve in space with a frame that follows it without twist. Sampled once; queries are cheap.
class Spine {
 public:
  Spine(const std::function<Eigen::Vector3d(double)>& curve, int samples);

  // The point at the fraction t (0 ... 1) of the length, offset by `across` in the plane normal to the curve.
  Eigen::Vector3d point(double t, const Eigen::Vector2d& across) const;
  double length() const { return arc_.back(); }

 private:
  std::vector<Eigen::Vector3d> positions_;
  std::vector<Eigen::Vector3d> first_;
  std::vector<Eigen::Vector3d> second_;
  std::vector<double> arc_;
};

/// Round wire along the spine, its ends closed.
void add_wire(PatchWork& work, const std::shared_ptr<const Spine>& spine, double radius, int least_around,
              int least_along);

/// Motions as maps.
PatchWork::Map moved(const Eigen::Isometry3d& X_AB);
PatchWork::Map shifted(double x, double y, double z);
/// Turned by `angle` in radians about `axis`, then shifted by `p`.
PatchWork::Map turned(double angle, const Eigen::Vector3d& axis, const Eigen::Vector3d& p);

}  // namespace glissade::shapes
