#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <glissade/shapes/benchmark_shapes.h>

#include "car/car_interior.h"
#include "surfaces/patch_solids.h"

namespace glissade::shapes {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

constexpr double kBeltHeight = 0.92;
constexpr double kAxleX = 1.3;  // of either axle from the middle
constexpr double kAxleHeight = 0.30;
constexpr double kArchRadius = 0.34;
constexpr double kNose = 1.93;  // x of the front ends of the sides
constexpr double kTail = -1.95;

/// y of the car's side: narrower at both ends and at the sills, leaning inwards above the belt.
double half_width(double x, double z) {
  const double plan = 0.85 - 0.16 * std::pow(std::abs(x) / 2, 6.0);
  const double low = std::min(z, kBeltHeight) - 0.62;
  return plan - 0.3 * low * low - 0.5 * std::max(0.0, z - kBeltHeight);
}

double belt_z(double x) {
  const double ahead = std::max(0.0, x - 0.9);
  return kBeltHeight - 0.2 * ahead * ahead;
}

double roof_z(double x) {
  const double along = (x + 0.325) / 0.575;
  return 1.36 + 0.025 * (1 - along * along);
}

Vector3d on_side(const Vector2d& xz, double side) {
  return {xz.x(), side * half_width(xz.x(), xz.y()), xz.y()};
}

/// Panel of the side between `lower` (x, z) and the belt line, which it meets from `x_first` to `x_last`.
void add_side_panel(PatchWork& work, const PlaneCurve& lower, double x_first, double x_last, double side,
                    int least_up) {
  const auto spans = static_cast<double>(lower.axis.spans.size());
  work.add(lower.axis, {{{0.3, least_up}}}, [=, lower = lower.point](double u, double v) {
    const Vector2d low = lower(u);
    // Mostly straight above, but evenly spread where the lower edge runs upright at an arch.
    const double x = 0.7 * low.x() + 0.3 * (x_first + (x_last - x_first) * u / spans);
    const double x_belt = std::clamp(x, std::min(x_first, x_last), std::max(x_first, x_last));
    const Vector2d high(x_belt, belt_z(x_belt));
    return on_side(low + v * (high - low), side);
  });
}

/// The lower edge of a panel around the wheel at `x_axle`; half an octagon rounded to a half circle.
PlaneCurve arch_edge(double x_first, double x_last, double z_last, double x_axle) {
  const double ahead = x_last > x_first ? 1 : -1;
  const double r = kArchRadius;
  const double k = r * std::tan(pi / 8);
  const double z = kAxleHeight;
  return rounded_path({{x_first, 0.25},
                       {x_axle - ahead * r, 0.25},
                       {x_axle - ahead * r, z + k, r},
                       {x_axle - ahead * k, z + r, r},
                       {x_axle + ahead * k, z + r, r},
                       {x_axle + ahead * r, z + k, r},
                       {x_axle + ahead * r, 0.25},
                       {x_last, z_last}},
                      false);
}

PlaneCurve sill(double x_first, double x_last) {
  return rounded_path({{x_first, 0.25}, {x_last, 0.25}}, false);
}

/// Strip of the side between the lines a-b and c-d in x, z.
void add_strip(PatchWork& work, const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d, double side,
               double inwards) {
  // Few lines along: sheet metal profiles become long thin triangles.
  work.add({{{(b - a).norm() / 2}}}, {{{(c - a).norm()}}}, [=](double u, double v) -> Vector3d {
    const Vector2d low = a + u * (b - a);
    const Vector2d high = c + u * (d - c);
    return on_side(low + v * (high - low), side) - Vector3d(0, side * inwards, 0);
  });
}

/// Pillars and roof rail, once as outer and once as inner sheet: the frames of the open windows.
void add_pillars(PatchWork& work, double side, double inwards) {
  const auto strip = [&](const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
    add_strip(work, a, b, c, d, side, inwards);
  };
  strip({0.95, kBeltHeight}, {0.27, 1.36}, {0.84, kBeltHeight}, {0.2, 1.32});      // A
  strip({-0.12, kBeltHeight}, {-0.16, 1.33}, {-0.2, kBeltHeight}, {-0.22, 1.33});  // B
  strip({-0.92, kBeltHeight}, {-0.74, 1.32}, {-1.5, kBeltHeight}, {-0.9, 1.36});   // C
  work.add({{{1.1, 2}}}, {{{0.05}}}, [=](double u, double v) -> Vector3d {
    const double x = 0.26 + u * (-0.9 - 0.26);
    return on_side({x, roof_z(x) - 0.045 * v}, side) - Vector3d(0, side * inwards, 0);
  });
}

/// The inner panel of a door: away from the outer one, with an armrest and a pocket.
void add_door_inner(PatchWork& work, double x_first, double x_last, double side) {
  work.add({{{x_last - x_first, 2}}}, {{{0.6, 2}}}, [=](double u, double v) {
    const double x = x_first + u * (x_last - x_first);
    const double z = 0.28 + v * 0.62;
    const double across = std::pow(std::abs(2 * u - 1), 6.0);
    const double armrest = std::exp(-std::pow((z - 0.68) / 0.05, 4.0)) * (1 - across);
    const double pocket = std::exp(-std::pow((z - 0.38) / 0.07, 4.0)) * (1 - across);
    return Vector3d(x, side * (half_width(x, z) - 0.06 - 0.05 * armrest - 0.025 * pocket), z);
  });
}

/// Wheel housing: the arch's edge drawn inwards, and its inner wall.
void add_wheel_house(PatchWork& work, double x_axle, double side) {
  const auto on_arch = [=](double u, double depth) {
    const double angle = pi * u;
    const double x = x_axle + kArchRadius * std::cos(angle);
    const double z = kAxleHeight + kArchRadius * std::sin(angle);
    return Vector3d(x, side * (half_width(x, z) - depth), z);
  };
  work.add({{{pi * kArchRadius, 5}}}, {{{0.25}}}, [=](double u, double v) { return on_arch(u, 0.27 * v); });
  work.add({{{pi * kArchRadius, 5}}}, {{{kArchRadius}}},
           [=](double u, double v) -> Vector3d {
             const Vector3d middle(x_axle, side * (half_width(x_axle, kAxleHeight) - 0.3), kAxleHeight);
             return middle + v * (on_arch(u, 0.27) - middle);
           },
           {true, false});
}

void add_side(PatchWork& work, double side, bool is_complete) {
  add_side_panel(work, arch_edge(0.83, kNose, 0.3, kAxleX), 0.83, kNose, side, 1);
  add_side_panel(work, sill(-0.17, 0.82), -0.17, 0.82, side, 2);
  add_side_panel(work, sill(-0.95, -0.18), -0.95, -0.18, side, 2);
  add_side_panel(work, arch_edge(-0.955, kTail, 0.3, -kAxleX), -0.955, kTail, side, 1);
  add_pillars(work, side, 0);
  add_wheel_house(work, kAxleX, side);
  add_wheel_house(work, -kAxleX, side);
  if (!is_complete) return;
  add_pillars(work, side, 0.035);
  add_door_inner(work, -0.16, 0.81, side);
  add_door_inner(work, -0.94, -0.19, side);
  PatchWork handle;
  add_box(handle, {0.18, 0.03, 0.03});
  for (const double x : {-0.05, -0.82}) {
    work.add(handle, shifted(x, side * (half_width(x, 0.82) + 0.012), 0.82), 2);
  }
  PatchWork mirror;
  add_turned(
      mirror, rectangle({0.11, 0.18}, 0.03),
      rounded_path({{0, -0.03}, {0.8, -0.03}, {1, 0.0}, {1, 0.05}, {0.93, 0.05}, {0.9, 0.04}, {0, 0.04}}, false));
  work.add(mirror, turned(-pi / 2, Vector3d::UnitY(), {0.72, side * 0.93, 1.0}), 2);
}

/// A sheet across the car from x_first to x_last, as high as `z` at its sides and `crown` higher in the middle.
void add_lid(PatchWork& work, double x_first, double x_last, double (*z)(double), double crown) {
  work.add({{{std::abs(x_last - x_first) / 2, 2}}}, {{{1.3, 4}}}, [=](double u, double v) {
    const double x = x_first + u * (x_last - x_first);
    const double s = 2 * v - 1;
    return Vector3d(x, s * half_width(x, z(x)), z(x) + crown * (1 - s * s));
  });
}

/// A band across the front (`end` = 1) or rear (-1): from z = low to high, higher by `crown` in the middle, `bulge` in
/// front of the sides' ends.
void add_end_band(PatchWork& work, double end, double low, double high, double bulge, double s_first, double s_last,
                  double crown = 0) {
  const double x_side = end > 0 ? kNose : kTail;
  work.add({{{0.7 * (s_last - s_first), 3}}}, {{{high - low, 1}}}, [=](double u, double v) {
    const double s = s_first + u * (s_last - s_first);
    const double z = low + v * (high + crown * (1 - s * s) - low);
    const double round = 1 - s * s * s * s;
    const double x = x_side + end * (0.06 * round + bulge * (0.3 + 0.7 * round) * std::sin(pi * (0.15 + 0.7 * v)));
    return Vector3d(x, s * half_width(x_side, std::min(z, high)), z);
  });
}

void add_ends(PatchWork& work, bool is_complete) {
  add_end_band(work, 1, 0.28, 0.52, 0.07, -1, 1);
  add_end_band(work, -1, 0.28, 0.58, 0.07, -1, 1);
  add_end_band(work, -1, 0.58, belt_z(kTail), 0, -1, 1, 0.04);
  add_end_band(work, 1, 0.66, belt_z(kNose), 0, -1, 1, 0.06);  // above the openings for headlights and grille
  if (!is_complete) return;
  for (int i = 0; i < 6; ++i) {
    add_end_band(work, 1, 0.53 + 0.022 * i, 0.54 + 0.022 * i, 0.015, -0.4, 0.4);
  }
  for (const double s : {-1.0, -0.42, 0.4, 0.98}) {
    add_end_band(work, 1, 0.52, 0.66, 0, s, s + 0.02);
  }
  // Beams behind the bumpers.
  PatchWork beam;
  add_box(beam, {0.06, 1.1, 0.1});
  work.add(beam, shifted(1.93, 0, 0.42));
  work.add(beam, shifted(-1.93, 0, 0.45));
}

/// Floor with its tunnel and beads, and the sheet that rises under the bench and falls to the boot's floor.
void add_floor(PatchWork& work) {
  work.add({{{1.5, 2}}}, {{{1.4, 6}}}, [](double u, double v) {
    const double x = 0.95 - 1.45 * u;
    const double y = 0.76 * (2 * v - 1);
    const double tunnel = 0.15 * std::exp(-std::pow(y / 0.14, 4.0));
    const double beads = 0.008 * std::sin(2 * pi * x / 0.12) * std::pow(std::sin(2 * pi * v), 2.0);
    return Vector3d(x, y, 0.2 + tunnel + beads);
  });
  const PlaneCurve rear = rounded_path(
      {{-0.5, 0.2}, {-0.52, 0.36, 0.03}, {-1.05, 0.34, 0.03}, {-1.3, 0.88, 0.03}, {-1.38, 0.36, 0.02}, {-1.93, 0.36}},
      false);
  work.add(rear.axis, {{{0.6}}}, [point = rear.point](double u, double v) {
    const Vector2d p = point(u);
    return Vector3d(p.x(), (2 * v - 1) * (p.x() < -0.95 ? 0.54 : 0.76), p.y());
  });
  // Firewall, leaning, and the shelf behind the bench.
  work.add({{{1.0, 2}}}, {{{0.6}}}, [](double u, double v) {
    return Vector3d(0.95 + 0.05 * std::sin(pi * u), (2 * u - 1) * (v < 0.5 ? 0.54 + 0.4 * v : 0.74), 0.2 + 0.68 * v);
  });
  work.add({{{0.5}}}, {{{0.2}}},
           [](double u, double v) { return Vector3d(-1.2 - 0.35 * v, (2 * u - 1) * 0.74, 0.89); });
}

}  // namespace

geometry::TriangleMesh make_car_body(std::int64_t triangle_count) {
  const bool is_complete = triangle_count >= kDetailsFrom;
  PatchWork work;
  for (const double side : {-1.0, 1.0}) {
    add_side(work, side, is_complete);
  }
  add_lid(work, 0.26, -0.9, &roof_z, 0.05);
  add_lid(work, 0.98, kNose, &belt_z, 0.06);
  add_lid(work, 0.9, 0.97, &belt_z, 0.06);
  add_lid(work, -1.52, kTail, &belt_z, 0.04);
  if (is_complete) {
    add_lid(
        work, 0.2, -0.85, [](double x) { return roof_z(x) - 0.03; }, 0.045);  // headliner
    add_lid(
        work, 1.0, 1.9, [](double x) { return belt_z(x) - 0.03; }, 0.05);  // inner sheet of the bonnet
  }
  add_ends(work, is_complete);
  add_floor(work);
  add_car_interior(work, is_complete);
  return work.tessellated(triangle_count);
}

}  // namespace glissade::shapes
