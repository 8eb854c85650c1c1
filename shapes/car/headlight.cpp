#include <algorithm>
#include <cmath>
#include <numbers>

#include <glissade/shapes/benchmark_shapes.h>

#include "surfaces/patch_solids.h"

namespace glissade::shapes {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

constexpr double kHalfWidth = 0.23;
constexpr double kBack = -0.11;  // y of the housing's back

/// 0 at the inner end of the headlight, 1 at the outer end, where it tapers and sweeps back with the car's corner.
double outwards(double x) {
  return (x + kHalfWidth) / (2 * kHalfWidth);
}

double lower_edge(double x) {
  return -0.085 + 0.03 * outwards(x) * outwards(x);
}

double upper_edge(double x) {
  return 0.095 - 0.05 * outwards(x) * outwards(x);
}

double lens_y(double x, double z) {
  return 0.10 - 0.12 * outwards(x) * outwards(x) - 0.8 * z * z;
}

/// x and z of the front's outline between `left` and `right`, shrunk by the factor `scale` about its middle line.
PlaneCurve front_outline(double left, double right, double scale, int least) {
  PlaneCurve outline;
  outline.axis = {{{right - left, least}, {0.12, 1}, {right - left, least}, {0.12, 1}}, true};
  outline.point = [left, right, scale](double u) {
    const auto side = static_cast<int>(u);
    const double t = u - side;
    const double x = side == 0   ? left + t * (right - left)
                     : side == 1 ? right
                     : side == 2 ? right + t * (left - right)
                                 : left;
    const double up = side == 0 ? 0 : side == 1 ? t : side == 2 ? 1 : 1 - t;
    const double z = lower_edge(x) + up * (upper_edge(x) - lower_edge(x));
    return Vector2d(x * scale, z * scale);
  };
  return outline;
}

Vector3d on_lens(const Vector2d& xz, double behind) {
  return {xz.x(), lens_y(xz.x(), xz.y()) - behind, xz.y()};
}

void add_lens(PatchWork& work) {
  const auto point = [](double u, double v) {
    const double x = -kHalfWidth + u * 2 * kHalfWidth;
    return Vector2d(x, lower_edge(x) + v * (upper_edge(x) - lower_edge(x)));
  };
  work.add({{{0.5, 5}}}, {{{0.17, 2}}}, [point](double u, double v) { return on_lens(point(u, v), 0); });
  // The back of the lens is fluted: cylinders side by side that spread the light.
  constexpr int kFlutes = 12;
  const Axis flutes{std::vector<Span>(kFlutes, Span{0.06, 2})};
  work.add(flutes, {{{0.17, 2}}}, [point](double u, double v) {
    return on_lens(point(u / kFlutes, v), 0.004 + 0.003 * std::abs(std::sin(pi * u)));
  });
  const PlaneCurve rim = front_outline(-kHalfWidth, kHalfWidth, 1, 5);
  work.add(rim.axis, {{{0.03}, {0.008}}}, [rim = rim.point](double u, double v) {
    const double wider = 1 + 0.03 * std::max(0.0, v - 1);
    return on_lens(rim(u) * wider, 0.015 * v);
  });
}

/// One wall of the housing, from the lip around the lens to the back. `scale` < 1 makes the inner wall.
void add_housing_wall(PatchWork& work, double scale, double back) {
  const PlaneCurve rim = front_outline(-kHalfWidth, kHalfWidth, scale, 4);
  const auto surface = [rim = rim.point, back](double u, double v) -> Vector3d {
    const Vector2d front = rim(u);
    const Vector3d lip = on_lens(front * 1.03, 0.03);
    if (v < 1) return lip + v * Vector3d(0, -0.02, 0);
    // The body narrows in a curve to the back, which is closed.
    const double deep = std::min(v - 1, 1.0);
    const double narrow = 1.0 - 0.26 * deep * deep * (3 - 2 * deep);
    const double middle_scale = v > 2 ? 3 - v : 1;
    const double y = (1 - deep) * (lip.y() - 0.02) + deep * back;
    return {front.x() * narrow * middle_scale, y, front.y() * narrow * middle_scale};
  };
  work.add(rim.axis, {{{0.02}, {0.13, 2}, {0.1}}}, surface, {false, true});
}

/// A bowl with a hole at its vertex for the bulb, 2.5 mm thick, with a lip around the front; it opens towards z.
void add_reflector(PatchWork& work, double radius, double focus) {
  const auto height = [focus](double r) { return r * r / (4 * focus); };
  constexpr double kHole = 0.012;
  PlaneCurve profile;
  profile.axis = {{{radius, 2}, {0.006}, {radius, 2}, {0.003}}, true};
  profile.point = [=](double s) {
    const double r_inner = kHole + std::min(s, 1.0) * (radius - kHole);
    if (s <= 1) return Vector2d(r_inner, height(r_inner));
    if (s <= 2) return Vector2d(radius + (s - 1) * 0.004, height(radius));
    const double t = std::min(s - 2, 1.0);
    const double r = radius + 0.004 + t * (kHole - radius - 0.004);
    const Vector2d outer(r, height(r) - 0.0025 - 0.001 * (1 - t));
    return s <= 3 ? outer : Vector2d(outer + (s - 3) * (Vector2d(kHole, height(kHole)) - outer));
  };
  add_revolution(work, profile, 8);
}

/// A bulb along z: glass with its filament, base, flange (at z = -0.012) and socket.
void add_bulb(PatchWork& work, bool is_complete) {
  if (!is_complete) {
    add_revolution(work, rounded_path({{0, 0.034}, {0.007, 0.034}, {0.008, 0}, {0.02, -0.012}, {0, -0.034}}, false), 6);
    return;
  }
  add_revolution(work, rounded_path({{0, 0.034}, {0.007, 0.034, 0.006}, {0.007, 0.004, 0.001}, {0.004, 0}}, false), 8);
  add_revolution(work,
                 rounded_path({{0, 0.003},
                               {0.0105, 0.003},
                               {0.0105, -0.011},
                               {0.02, -0.011},
                               {0.02, -0.015},
                               {0.013, -0.015},
                               {0.013, -0.034, 0.002},
                               {0, -0.034}},
                              false),
                 10);
  const auto filament = std::make_shared<const Spine>(
      [](double t) {
        const double angle = 2 * pi * 5 * t;
        return Vector3d(0.0012 * std::cos(angle), 0.0012 * std::sin(angle), 0.016 + 0.008 * t);
      },
      200);
  add_wire(work, filament, 0.0002, 4, 30);
  PatchWork post;
  add_box(post, {0.0006, 0.0006, 0.018});
  PatchWork terminal;
  add_box(terminal, {0.006, 0.0008, 0.012});
  for (int i = 0; i < 3; ++i) {
    const double angle = 2 * pi * i / 3;
    work.add(post, turned(angle, Vector3d::UnitZ(), {0.003 * std::cos(angle), 0.003 * std::sin(angle), 0.011}), 2);
    const Vector3d p(0.007 * std::cos(angle), 0.007 * std::sin(angle), -0.039);
    work.add(terminal, turned(angle + pi / 2, Vector3d::UnitZ(), p), 2);
  }
}

/// A lamp is a reflector with its bulb and the bezel around it, from `left` to `right` of the front.
struct Lamp {
  double x;
  double radius;
  double focus;
  double left;
  double right;
};

constexpr Lamp kLamps[] = {
    {-0.137, 0.074, 0.022, -0.226, -0.052}, {0.025, 0.060, 0.020, -0.052, 0.100}, {0.157, 0.038, 0.014, 0.100, 0.226}};

void add_lamp(PatchWork& work, const Lamp& lamp, bool is_complete) {
  const double front = lens_y(lamp.x, 0) - 0.036;
  const double vertex = front - lamp.radius * lamp.radius / (4 * lamp.focus);
  const auto to_vertex = turned(-pi / 2, Vector3d::UnitX(), {lamp.x, vertex, 0});
  PatchWork reflector;
  add_reflector(reflector, lamp.radius, lamp.focus);
  work.add(reflector, to_vertex, 1.3);
  PatchWork bulb;
  add_bulb(bulb, is_complete);
  work.add(bulb, to_vertex, 3);

  // The bezel falls from behind the lens to the reflector's rim.
  const PlaneCurve outer = front_outline(lamp.left, lamp.right, 0.97, 2);
  const auto ring = [outer = outer.point, lamp, front](double u, double v) -> Vector3d {
    const Vector2d border = outer(u);
    const Vector2d center(lamp.x, 0);
    const Vector2d inner = center + (lamp.radius + 0.004) * (border - center).normalized();
    const Vector3d rim(inner.x(), front + 0.002, inner.y());
    if (v < 1) return rim + (1 - v) * Vector3d(0, -0.012, 0);
    return rim + (v - 1) * (on_lens(border, 0.02) - rim);
  };
  work.add(outer.axis, {{{0.012}, {0.03}}}, ring);
}

void add_tabs(PatchWork& work) {
  PatchWork tab;
  add_pierced_prism(tab,
                    rounded_path({{-0.03, -0.014}, {0.014, -0.014, 0.01}, {0.014, 0.014, 0.01}, {-0.03, 0.014}}, true),
                    0.0045, -0.002, 0.002);
  const auto place = [&](double x, double y, double z, double angle) {
    work.add(tab, turned(angle, Vector3d::UnitY(), {x, y, z}), 1.5);
  };
  place(-0.235, 0.02, 0.03, pi);
  place(0.252, -0.075, 0.01, 0);
  place(-0.12, 0.03, 0.105, -pi / 2);
  place(0.05, 0.0, -0.09, pi / 2);
}

/// Cooling ribs along the top and across the back.
void add_cooling_ribs(PatchWork& work) {
  PatchWork top_rib;
  add_box(top_rib, {0.002, 0.07, 0.02});
  for (int i = 0; i < 16; ++i) {
    const double x = -0.17 + 0.018 * i;
    work.add(top_rib, shifted(x, -0.045 - 0.02 * outwards(x), 0.93 * upper_edge(x)), 2);
  }
  PatchWork back_rib;
  add_box(back_rib, {0.0025, 0.024, 0.085});
  for (int i = 0; i < 9; ++i) {
    work.add(back_rib, shifted(-0.03 + 0.007 * i, kBack - 0.008, 0), 2);
  }
}

/// Round covers behind the bulbs with grips around, the connector with its pins, and the adjusting screws.
void add_back(PatchWork& work) {
  PatchWork cover;
  add_revolution(
      cover,
      rounded_path(
          {{0, -0.012}, {0.028, -0.012}, {0.034, -0.022, 0.003}, {0.038, 0.004}, {0.042, 0.004}, {0.042, 0.012}},
          false),
      16);
  PatchWork grip;
  add_box(grip, {0.006, 0.004, 0.014});
  for (int i = 0; i < 18; ++i) {
    const double angle = 2 * pi * i / 18;
    cover.add(grip, turned(angle, Vector3d::UnitZ(), {0.04 * std::cos(angle), 0.04 * std::sin(angle), -0.002}));
  }
  work.add(cover, turned(-pi / 2, Vector3d::UnitX(), {-0.11, kBack, 0.005}), 1.5);
  work.add(cover, turned(-pi / 2, Vector3d::UnitX(), {0.1, kBack, 0}), 1.2);

  PatchWork connector;
  add_turned(connector, rectangle({0.034, 0.018}, 0.003),
             rounded_path({{0, 0}, {0.85, 0}, {0.85, 0.018}, {1, 0.018}, {1, -0.008}, {0, -0.008}}, false));
  PatchWork pin;
  add_prism(pin, rectangle({0.0015, 0.0015}, 0), 0, 0.014);
  for (int i = 0; i < 8; ++i) {
    connector.add(pin, shifted(-0.012 + 0.008 * (i % 4), i < 4 ? -0.004 : 0.004, 0));
  }
  work.add(connector, turned(pi / 2, Vector3d::UnitX(), {0.01, kBack - 0.008, -0.052}), 2);

  PatchWork screw;
  add_revolution(
      screw, rounded_path({{0, -0.006}, {0.003, -0.006}, {0.003, 0.12}, {0.005, 0.122, 0.001}, {0, 0.128}}, false), 8);
  PatchWork wheel;
  add_pierced_prism(wheel, gear_outline(0.009, 0.011, 16), 0.003, -0.006, 0);
  screw.add(wheel, shifted(0, 0, 0));
  work.add(screw, turned(-pi / 2, Vector3d::UnitX(), {-0.05, kBack - 0.02, 0.055}), 2);
  work.add(screw, turned(-pi / 2, Vector3d::UnitX(), {-0.16, kBack - 0.02, -0.05}), 2);
}

}  // namespace

geometry::TriangleMesh make_headlight(std::int64_t triangle_count) {
  const bool is_complete = triangle_count >= kDetailsFrom;
  PatchWork work;
  add_lens(work);
  add_housing_wall(work, 1.0, kBack);
  if (is_complete) add_housing_wall(work, 0.975, kBack + 0.003);
  for (const Lamp& lamp : kLamps) {
    add_lamp(work, lamp, is_complete);
  }
  add_tabs(work);
  if (is_complete) {
    add_cooling_ribs(work);
    add_back(work);
  }
  return work.tessellated(triangle_count);
}

}  // namespace glissade::shapes
