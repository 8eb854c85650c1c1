#include "car/car_interior.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "surfaces/patch_solids.h"

namespace glissade::shapes {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

/// A cushion about the origin, flat below.
PatchWork cushion(const Vector3d& size, bool is_complete) {
  PatchWork work;
  const double h = size.z() / 2;
  const PlaneCurve plain = rounded_path({{0, -h}, {0.92, -h}, {1, 0.2 * h}, {0.86, h}, {0, h}}, false);
  const PlaneCurve rounded = rounded_path(
      {{0, -h}, {0.94, -h, 0.02}, {1, -0.2 * h, 0.02}, {1, 0.4 * h, 0.02}, {0.85, h, 0.05}, {0, h}}, false);
  add_turned(work, rectangle(size.head<2>(), std::min(size.x(), size.y()) * 0.2), is_complete ? rounded : plain);
  return work;
}

/// Raises the sides of a cushion of this width along y, and lowers its middle a little, as a seat does for hips.
PatchWork::Map bolstered(double width, double rise) {
  return [=](const Vector3d& p) -> Vector3d {
    if (p.z() <= 0) return p;
    const double side = std::abs(p.y()) / (width / 2);
    return p + Vector3d(0, 0, rise * (std::pow(side, 4.0) - 0.3 * (1 - side * side)));
  };
}

/// A backrest made lying is set up: its z forward, its x up, leaning back about its foot.
PatchWork::Map set_up(double lean, const Vector3d& foot) {
  return turned(-pi / 2 - lean, Vector3d::UnitY(), foot);
}

void add_headrest(PatchWork& seat, double y, const Vector3d& foot, double height, double lean, bool is_complete) {
  const auto place = [&](const PatchWork& part, double x, double y_part) {
    // Along the leaning back: x of the part is up.
    PatchWork shifted_part;
    shifted_part.add(part, shifted(x, y_part, 0));
    seat.add(shifted_part, set_up(lean, foot), 1.5);
  };
  place(cushion({0.18, 0.27, 0.1}, is_complete), height + 0.13, y);
  if (!is_complete) return;
  PatchWork post;
  add_revolution(post, rounded_path({{0, 0}, {0.007, 0}, {0.007, 0.2}, {0, 0.2}}, false), 8);
  PatchWork lying_post;
  lying_post.add(post, turned(pi / 2, Vector3d::UnitY(), Vector3d::Zero()));
  place(lying_post, height - 0.1, y - 0.07);
  place(lying_post, height - 0.1, y + 0.07);
}

/// Origin on the floor below the middle of the cushion, x forward.
PatchWork front_seat(bool is_complete) {
  constexpr double kLean = 0.32;
  PatchWork seat;
  PatchWork base;
  base.add(cushion({0.52, 0.5, 0.14}, is_complete), bolstered(0.5, 0.05));
  seat.add(base, turned(-0.12, Vector3d::UnitY(), {0, 0, 0.27}));
  PatchWork back;
  back.add(cushion({0.6, 0.5, 0.13}, is_complete), bolstered(0.5, 0.06));
  PatchWork lifted;
  lifted.add(back, shifted(0.3, 0, 0));
  const Vector3d foot(-0.24, 0, 0.3);
  seat.add(lifted, set_up(kLean, foot));
  add_headrest(seat, 0, foot, 0.6, kLean, is_complete);
  if (!is_complete) return seat;
  PatchWork rail;
  add_box(rail, {0.6, 0.03, 0.04});
  PatchWork leg;
  add_box(leg, {0.04, 0.012, 0.16});
  for (const double y : {-0.19, 0.19}) {
    seat.add(rail, shifted(0, y, 0.03));
    for (const double x : {-0.2, 0.0, 0.2}) {
      seat.add(leg, shifted(x, y, 0.12), 2);
    }
  }
  PatchWork knob;
  add_prism(knob, gear_outline(0.036, 0.04, 20), 0, 0.025);
  seat.add(knob, turned(-pi / 2, Vector3d::UnitX(), {-0.22, 0.26, 0.3}), 2);
  return seat;
}

PatchWork bench(bool is_complete) {
  constexpr double kLean = 0.32;
  PatchWork seat;
  // Three seats side by side: shallow hollows along one long cushion.
  const auto hollowed = [](const Vector3d& p) -> Vector3d {
    return p + Vector3d(0, 0, p.z() > 0 ? 0.02 * std::cos(2 * pi * p.y() / 0.44) : 0);
  };
  PatchWork base;
  base.add(cushion({0.5, 1.32, 0.14}, is_complete), hollowed);
  seat.add(base, turned(-0.15, Vector3d::UnitY(), {0, 0, 0.27}));
  PatchWork back;
  back.add(cushion({0.56, 1.28, 0.12}, is_complete), hollowed);
  PatchWork lifted;
  lifted.add(back, shifted(0.28, 0, 0));
  const Vector3d foot(-0.2, 0, 0.3);
  seat.add(lifted, set_up(kLean, foot));
  if (!is_complete) return seat;
  for (const double y : {-0.42, 0.0, 0.42}) {
    add_headrest(seat, y, foot, 0.48, kLean, is_complete);
  }
  return seat;
}

/// A sheet that follows `profile` (x, z) from y = -width/2 to width/2.
void add_dashboard(PatchWork& work) {
  const PlaneCurve profile = rounded_path(
      {{0.98, 0.86}, {0.66, 0.92, 0.05}, {0.56, 0.84, 0.03}, {0.6, 0.72}, {0.58, 0.62, 0.03}, {0.72, 0.5}}, false);
  work.add(profile.axis, {{{0.3}, {0.6, 2}, {0.4}}}, [point = profile.point](double u, double v) {
    const Vector2d p = point(u);
    const double y = v < 1 ? -0.66 + 0.3 * v : v < 2 ? -0.36 + 0.5 * (v - 1) : 0.14 + 0.52 * (v - 2);
    // The instruments' hood in front of the driver.
    const double hood = std::exp(-std::pow((y - 0.35) / 0.14, 4.0)) * std::exp(-std::pow((p.x() - 0.62) / 0.08, 2.0));
    return Vector3d(p.x(), y, p.y() + 0.05 * hood);
  });
}

void add_steering(PatchWork& work, bool is_complete) {
  PatchWork wheel;
  PlaneCurve ring = circle(0.014, is_complete ? 8 : 3);
  ring.point = [point = ring.point](double s) -> Vector2d { return point(s) + Vector2d(0.18, 0); };
  add_revolution(wheel, ring, is_complete ? 24 : 10);
  if (is_complete) {
    wheel.add(cushion({0.14, 0.12, 0.05}, true), shifted(0, 0, -0.02));
    PatchWork spoke;
    add_box(spoke, {0.14, 0.03, 0.012});
    for (const double angle : {-0.3, pi / 2, pi + 0.3}) {
      const Vector3d p(0.11 * std::cos(angle), 0.11 * std::sin(angle), -0.015);
      wheel.add(spoke, turned(angle, Vector3d::UnitZ(), p));
    }
    PatchWork column;
    add_revolution(column, rounded_path({{0, -0.5}, {0.02, -0.5}, {0.03, -0.04}, {0, -0.04}}, false), 10);
    wheel.add(column, shifted(0, 0, 0));
  }
  work.add(wheel, turned(-pi / 2 + 0.45, Vector3d::UnitY(), {0.42, 0.35, 0.78}), 1.5);
}

/// Gear and brake levers, pedals, and the mirror at the windscreen.
void add_controls(PatchWork& work) {
  PatchWork lever;
  add_revolution(
      lever,
      rounded_path(
          {{0, 0}, {0.06, 0}, {0.012, 0.09}, {0.008, 0.2}, {0.024, 0.23, 0.01}, {0.02, 0.27, 0.008}, {0, 0.27}}, false),
      10);
  work.add(lever, turned(-0.15, Vector3d::UnitY(), {0.25, 0, 0.34}), 2);
  PatchWork brake;
  add_box(brake, {0.3, 0.025, 0.03});
  work.add(brake, turned(-0.25, Vector3d::UnitY(), {-0.1, 0.02, 0.45}), 2);
  PatchWork pedal;
  add_box(pedal, {0.015, 0.06, 0.08});
  PatchWork arm;
  add_box(arm, {0.012, 0.012, 0.25});
  pedal.add(arm, turned(0.2, Vector3d::UnitY(), {0.03, 0, 0.13}));
  for (const double y : {0.25, 0.36, 0.47}) {
    work.add(pedal, shifted(0.78, y, 0.35), 2);
  }
  work.add(cushion({0.07, 0.24, 0.03}, true), turned(-pi / 2, Vector3d::UnitY(), {0.38, 0, 1.2}), 2);
}

}  // namespace

void add_car_interior(PatchWork& work, bool is_complete) {
  const PatchWork seat = front_seat(is_complete);
  work.add(seat, shifted(0.05, 0.37, 0.22), 1.3);
  work.add(seat, shifted(0.0, -0.37, 0.22), 1.2);
  work.add(bench(is_complete), shifted(-0.7, 0, 0.25), 1.2);
  add_dashboard(work);
  add_steering(work, is_complete);
  if (is_complete) add_controls(work);
}

}  // namespace glissade::shapes
