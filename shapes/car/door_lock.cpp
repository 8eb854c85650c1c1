#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <glissade/shapes/benchmark_shapes.h>

#include "surfaces/patch_solids.h"

namespace glissade::shapes {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

// Axes of latch, pawl and gear.
constexpr double kLatchX = -0.02, kLatchY = 0.016;
constexpr double kPawlX = 0.022, kPawlY = 0.014;
constexpr double kGearX = 0.032, kGearY = -0.016;

/// The base plate with the mouth that the striker enters from the left, its rivet holes, and a flange at the right.
void add_base_plate(PatchWork& work, bool is_complete) {
  constexpr double kThickness = 0.002;
  std::vector<Tile> tiles{{{-0.012, -0.012}, {0.06, 0.004}}};
  for (int i = 0; i < 3; ++i) {
    const double x = -0.06 + 0.04 * i;
    tiles.push_back({{x, -0.05}, {x + 0.04, -0.012}, {x + 0.022, -0.034}, 0.0045});
    tiles.push_back({{x, 0.004}, {x + 0.04, 0.048}, {x + 0.02, 0.034}, 0.0045});
  }
  add_tiled_plate(work, tiles, 0, kThickness);
  add_wall(work,
           rounded_path({{-0.06, -0.05},
                         {0.06, -0.05},
                         {0.06, 0.048},
                         {-0.06, 0.048},
                         {-0.06, 0.004},
                         {-0.012, 0.004},
                         {-0.012, -0.012},
                         {-0.06, -0.012}},
                        true),
           0, kThickness);
  if (!is_complete) return;
  PatchWork flange;
  std::vector<Tile> flange_tiles;
  for (int i = 0; i < 3; ++i) {
    const double y = -0.045 + 0.03 * i;
    flange_tiles.push_back({{0, y}, {0.028, y + 0.03}, {0.015, y + 0.015}, 0.004});
  }
  add_tiled_plate(flange, flange_tiles, 0, kThickness);
  work.add(flange, turned(-pi / 2, Vector3d::UnitY(), {0.06, 0, kThickness}));
}

/// The plate that bears the other ends of the pins.
void add_cover_plate(PatchWork& work) {
  std::vector<Tile> tiles;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 2; ++j) {
      const double x = -0.045 + 0.032 * i;
      const double y = -0.006 + 0.024 * j;
      tiles.push_back({{x, y}, {x + 0.032, y + 0.024}, {x + 0.016, y + 0.012}, j == 0 ? 0.007 : 0.003});
    }
  }
  add_tiled_plate(work, tiles, 0.021, 0.0225);
}

/// The fork that turns about its pin and holds the striker in its notch, with catches for the pawl.
void add_latch(PatchWork& work, bool is_complete) {
  struct Polar {
    double degrees;
    double radius;
    double rounding = 0;
  };
  const std::vector<Polar> outline{
      {10, 0.020, 0.003},    {50, 0.022, 0.004},    {100, 0.021, 0.004}, {150, 0.022, 0.002}, {176, 0.022, 0.001},
      {188, 0.0095, 0.0015}, {222, 0.0095, 0.0015}, {226, 0.022, 0.001}, {262, 0.022, 0.001}, {264, 0.016},
      {300, 0.021, 0.001},   {303, 0.015},          {340, 0.021, 0.001}, {344, 0.016}};
  std::vector<Corner> corners;
  for (const Polar& p : outline) {
    const double angle = p.degrees * pi / 180;
    corners.push_back({p.radius * std::cos(angle), p.radius * std::sin(angle), is_complete ? p.rounding : 0});
  }
  PatchWork latch;
  add_pierced_prism(latch, rounded_path(corners, true), 0.0045, 0.003, 0.009);
  work.add(latch, shifted(kLatchX, kLatchY, 0), 1.5);
}

void add_levers(PatchWork& work, bool is_complete) {
  PatchWork pawl;
  add_pierced_prism(pawl,
                    rounded_path({{-0.021, 0.004, 0.001},
                                  {-0.023, -0.004},
                                  {-0.012, -0.007},
                                  {0, -0.009, 0.003},
                                  {0.012, -0.006},
                                  {0.018, 0.003, 0.002},
                                  {0.004, 0.009, 0.003},
                                  {-0.008, 0.007}},
                                 true),
                    0.0035, 0.003, 0.009);
  work.add(pawl, shifted(kPawlX, kPawlY, 0), 1.5);

  PatchWork lever;
  add_pierced_prism(
      lever,
      rounded_path({{-0.009, -0.008, 0.006}, {0.052, -0.004, 0.003}, {0.052, 0.004, 0.003}, {-0.009, 0.008, 0.006}},
                   true),
      0.003, 0, 0.0018);
  const int count = is_complete ? 4 : 2;
  for (int i = 0; i < count; ++i) {
    const bool is_at_pawl = i % 2 == 0;
    const double x = is_at_pawl ? kPawlX : kLatchX;
    const double y = is_at_pawl ? kPawlY : kLatchY;
    const double angle = is_at_pawl ? pi + 0.35 * (i - 1) : -0.25 * i;
    work.add(lever, turned(angle, Vector3d::UnitZ(), {x, y, 0.0105 + 0.0024 * i}), 1.5);
  }
}

/// Pins through both plates with a head at either end.
void add_rivets(PatchWork& work, bool is_complete) {
  PatchWork rivet;
  const PlaneCurve plain = rounded_path({{0, -0.0015}, {0.003, -0.0015}, {0.003, 0.024}, {0, 0.024}}, false);
  const PlaneCurve headed = rounded_path({{0, -0.002},
                                          {0.0045, -0.002, 0.0015},
                                          {0.0055, 0},
                                          {0.0028, 0},
                                          {0.0028, 0.0225},
                                          {0.005, 0.0225},
                                          {0.005, 0.0245, 0.0015},
                                          {0, 0.0245}},
                                         false);
  add_revolution(rivet, is_complete ? headed : plain, is_complete ? 10 : 6);
  const std::vector<Eigen::Vector2d> places{{kLatchX, kLatchY}, {kPawlX, kPawlY}, {kGearX, kGearY}, {-0.038, -0.034},
                                            {0, 0.034},         {0.04, 0.034},    {-0.04, 0.034}};
  for (std::size_t i = 0; i < (is_complete ? places.size() : 3); ++i) {
    work.add(rivet, shifted(places[i].x(), places[i].y(), 0), 2);
  }
}

/// Torsion springs about the pins of latch and pawl with straight legs, and a compression spring.
void add_springs(PatchWork& work, bool is_complete) {
  const auto torsion = std::make_shared<const Spine>(
      [](double t) {
        constexpr double kRadius = 0.0085;
        const double angle = 2 * pi * 4 * std::min(std::max((t - 0.15) / 0.7, 0.0), 1.0);
        const double leg = t < 0.15 ? t - 0.15 : t > 0.85 ? t - 0.85 : 0.0;
        const Vector3d tangent(-std::sin(angle), std::cos(angle), 0);
        const Vector3d on_coil(kRadius * std::cos(angle), kRadius * std::sin(angle), 0.0105 + 0.008 * t);
        return Vector3d(on_coil + 0.1 * leg * tangent);
      },
      800);
  PatchWork spring;
  add_wire(spring, torsion, 0.0006, is_complete ? 6 : 3, is_complete ? 48 : 16);
  work.add(spring, shifted(kLatchX, kLatchY, 0), 2);
  if (!is_complete) return;
  work.add(spring, turned(2, Vector3d::UnitZ(), {kPawlX, kPawlY, 0}), 2);
  const auto coil = std::make_shared<const Spine>(
      [](double t) {
        const double angle = 2 * pi * 9 * t;
        return Vector3d(0.0035 * std::cos(angle), 0.03 * t, 0.007 + 0.0035 * std::sin(angle));
      },
      1200);
  PatchWork compression;
  add_wire(compression, coil, 0.0005, 6, 90);
  work.add(compression, shifted(0.052, 0.008, 0.004), 2);
}

/// Worm gear, worm and the motor that turns it.
void add_drive(PatchWork& work, bool is_complete) {
  PatchWork gear;
  const PlaneCurve outline = is_complete ? gear_outline(0.0125, 0.015, 22) : circle(0.0138, 10);
  add_pierced_prism(gear, outline, 0.0028, 0.011, 0.017);
  if (is_complete) {
    add_revolution(gear, rounded_path({{0.0028, 0.017}, {0.006, 0.017}, {0.005, 0.0205}, {0.0028, 0.0205}}, true), 12);
  }
  work.add(gear, shifted(kGearX, kGearY, 0), 1.5);

  const auto along_x = turned(pi / 2, Vector3d::UnitY(), {-0.028, kGearY - 0.0175, 0.0135});
  PatchWork motor;
  if (!is_complete) {
    add_revolution(motor, rounded_path({{0, 0}, {0.0095, 0}, {0.0095, 0.038}, {0, 0.038}}, false), 8);
    work.add(motor, along_x);
    return;
  }
  add_revolution(motor,
                 rounded_path({{0, -0.003},
                               {0.003, -0.003},
                               {0.003, 0},
                               {0.0095, 0, 0.001},
                               {0.0095, 0.036, 0.002},
                               {0.005, 0.036},
                               {0.005, 0.038},
                               {0.001, 0.038},
                               {0.001, 0.078},
                               {0, 0.078}},
                              false),
                 12);
  // A screw thread of five turns, its depth a smooth function of the angle against the pitch.
  constexpr double kPitch = 0.0042;
  work.add(motor, along_x);
  PatchWork worm;
  worm.add({{{0.016, 10}}, true}, {{{0.0025}, {0.03, 30}, {0.0025}}}, [](double u, double v) {
    const double z = std::min(std::max(v - 1, 0.0), 1.0) * 0.026;
    const double narrow = v < 1 ? v : v > 2 ? 3 - v : 1;
    const double r = narrow * (0.003 + 0.0009 * std::cos(2 * pi * (u - z / kPitch))) + (1 - narrow) * 0.001;
    return Vector3d(r * std::cos(2 * pi * u), r * std::sin(2 * pi * u), 0.046 + z);
  });
  work.add(worm, along_x, 2);
}

/// Lid with double walls around the mechanism, with ribs and screw bosses on its inner side, and the plug.
void add_housing(PatchWork& work, bool is_complete) {
  add_turned(work, rectangle({0.128, 0.104}, 0.008),
             rounded_path({{0, 0.036}, {1, 0.036}, {1, 0.001}, {0.97, 0.001}, {0.97, 0.034}, {0, 0.034}}, false));
  if (!is_complete) return;
  PatchWork rib;
  add_box(rib, {0.0012, 0.09, 0.01});
  for (int i = 0; i < 9; ++i) {
    work.add(rib, shifted(-0.048 + 0.012 * i, 0, 0.0295), 2);
  }
  PatchWork cross_rib;
  add_box(cross_rib, {0.11, 0.0012, 0.008});
  for (int i = 0; i < 6; ++i) {
    work.add(cross_rib, shifted(0, -0.036 + 0.0144 * i, 0.0305), 2);
  }
  PatchWork boss;
  add_pierced_prism(boss, circle(0.0042, 10), 0.002, 0.003, 0.035);
  for (const double x : {-0.055, 0.054}) {
    for (const double y : {-0.044, 0.042}) {
      work.add(boss, shifted(x, y, 0), 2);
    }
  }
  PatchWork plug;
  add_turned(plug, rectangle({0.026, 0.012}, 0.002),
             rounded_path({{0, 0.002}, {0.88, 0.002}, {0.88, 0.012}, {1, 0.012}, {1, 0}, {0, 0}}, false));
  PatchWork pin;
  add_prism(pin, rectangle({0.0008, 0.0008}, 0), 0.002, 0.011);
  for (int i = 0; i < 10; ++i) {
    plug.add(pin, shifted(-0.009 + 0.0045 * (i % 5), i < 5 ? -0.0022 : 0.0022, 0), 2);
  }
  work.add(plug, shifted(-0.03, -0.034, 0.035), 2);
}

/// Rods and a Bowden cable inside the housing.
void add_cables(PatchWork& work) {
  const auto add_cable = [&](double radius, const std::vector<Vector3d>& p) {
    const auto spine = std::make_shared<const Spine>(
        [p](double t) -> Vector3d {
          const double s = 1 - t;
          return s * s * s * p[0] + 3 * s * s * t * p[1] + 3 * s * t * t * p[2] + t * t * t * p[3];
        },
        300);
    add_wire(work, spine, radius, 6, 12);
  };
  add_cable(0.0015, {{-0.03, -0.04, 0.03}, {-0.07, 0, 0.022}, {-0.045, 0.05, 0.027}, {0.0, 0.04, 0.012}});
  add_cable(0.0015, {{-0.02, -0.03, 0.03}, {0.01, -0.01, 0.023}, {0.05, -0.06, 0.028}, {0.05, 0.03, 0.025}});
  add_cable(0.001, {{-0.026, -0.028, 0.025}, {-0.03, -0.02, 0.026}, {-0.028, -0.018, 0.028}, {-0.028, -0.024, 0.034}});
}

}  // namespace

geometry::TriangleMesh make_door_lock(std::int64_t triangle_count) {
  const bool is_complete = triangle_count >= kDetailsFrom;
  PatchWork work;
  add_base_plate(work, is_complete);
  add_latch(work, is_complete);
  add_levers(work, is_complete);
  add_rivets(work, is_complete);
  add_springs(work, is_complete);
  add_drive(work, is_complete);
  add_housing(work, is_complete);
  if (is_complete) {
    add_cover_plate(work);
    add_cables(work);
  }
  return work.tessellated(triangle_count);
}

}  // namespace glissade::shapes
