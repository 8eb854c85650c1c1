#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <vector>

#include "household/household_shapes.h"
#include "household/solids.h"

namespace glissade::shapes {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::TriangleMesh;

/// From one point to another, in millimetres.
std::function<Vector3d(double)> line_mm(const Vector3d& from, const Vector3d& to) {
  return [from, to](double t) -> Vector3d { return 1e-3 * (from + t * (to - from)); };
}

/// Half sizes in millimetres that change from one to another.
std::function<Vector2d(double)> taper_mm(const Vector2d& from, const Vector2d& to) {
  return [from, to](double t) -> Vector2d { return 1e-3 * (from + t * (to - from)); };
}

/// A ring for the fingers, in the plane z = 0.
TriangleMesh finger_ring(const Vector2d& center_mm, double edge) {
  return swept_solid({.path = [center_mm](double t) -> Vector3d {
                        const double angle = 2 * std::numbers::pi * t;
                        return 1e-3 *
                               Vector3d(center_mm.x() + 20 * std::cos(angle), center_mm.y() + 15 * std::sin(angle), 0);
                      },
                      .half_size = [](double) { return Vector2d(3.5e-3, 4e-3); },
                      .up = Vector3d::UnitZ(),
                      .is_ring = true},
                     edge);
}

}  // namespace

TriangleMesh make_door_handle(double edge) {
  TriangleMesh handle = turned_solid(in_mm({{0, 0}, {26, 0}, {26, 8, 3}, {0, 8}}), edge);
  add(handle, swept_solid({.path = bezier_mm({{0, 0, 4}, {0, 0, 75}, {20, 0, 50}, {120, 0, 52}}),
                           .half_size = taper_mm({8, 8}, {6, 10}),
                           .up = Vector3d::UnitY(),
                           .dome = 0.7},
                          edge));
  return handle;
}

TriangleMesh make_garden_hose(double edge) {
  const auto path = bezier_mm({{-130, 0, 0}, {-20, 0, 0}, {60, 0, -5}, {110, 0, -110}});
  const auto half_size = [](double) { return Vector2d(11e-3, 11e-3); };
  std::vector<SpaceLoop> loops = swept_loops({.path = path, .half_size = half_size, .up = Vector3d::UnitY()}, edge);
  // Back along the inner wall.
  for (std::size_t i = loops.size(); i > 0; --i) {
    const SpaceLoop outer = loops[i - 1];
    Vector3d middle = Vector3d::Zero();
    for (const Vector3d& p : outer)
      middle += p / static_cast<double>(outer.size());
    SpaceLoop& inner = loops.emplace_back();
    for (const Vector3d& p : outer)
      inner.push_back(middle + 7.5 / 11 * (p - middle));
  }
  return loft(loops, true);
}

TriangleMesh make_hammer(double edge) {
  TriangleMesh hammer = swept_solid({.path = line_mm({0, 0, -90}, {0, 0, 190}),
                                     .half_size =
                                         [](double t) {
                                           const double waist = std::exp(-std::pow((t - 0.65) / 0.25, 2));
                                           return Vector2d(9e-3 - 2e-3 * waist, 14e-3 - 5e-3 * waist);
                                         },
                                     .up = Vector3d::UnitX(),
                                     .power = 2.5,
                                     .dome = 0.5},
                                    edge);
  add(hammer, swept_solid({.path = line_mm({50, 0, 180}, {-55, 0, 180}),
                           .half_size =
                               [](double t) {
                                 const double peen = std::clamp((t - 0.6) / 0.4, 0.0, 1.0);
                                 return Vector2d(12e-3, 12e-3 - 10e-3 * peen);
                               },
                           .up = Vector3d::UnitZ(),
                           .power = 5},
                          edge));
  return hammer;
}

TriangleMesh make_key(double edge) {
  return plate_solid(rounded_path(in_mm({{25, -4, 0.4},
                                         {29, -3.4, 0.4},
                                         {33, -3.6, 0.4},
                                         {37, -2.8, 0.4},
                                         {41, -3, 0.4},
                                         {46, 0, 1},
                                         {43, 4, 2},
                                         {12, 4, 0.5},
                                         {8, 12, 5},
                                         {-8, 13, 6},
                                         {-14, 0, 7},
                                         {-8, -13, 6},
                                         {8, -12, 5},
                                         {12, -4, 0.5}}),
                                  true),
                     2.4e-3, 0.3e-3, edge);
}

TriangleMesh make_pen(double edge) {
  return turned_solid(in_mm({{0, 0}, {0.8, 0, 0.2}, {4.5, 22, 30}, {4.5, 140, 2}, {0, 142}}), edge);
}

TriangleMesh make_scissors(double edge) {
  TriangleMesh scissors = turned_solid(in_mm({{0, -4.2}, {5, -4.2, 1}, {5, 4.2, 1}, {0, 4.2}}), edge);
  for (const double side : {-1.0, 1.0}) {
    add(scissors, finger_ring({-66, side * 22}, edge));
    add(scissors, swept_solid({.path = bezier_mm({{-49, side * 15, 0},
                                                  {-25, side * 8, side * 1.6},
                                                  {0, side * -3, side * 1.6},
                                                  {95, side * -2, side * 1.6}}),
                               .half_size =
                                   [](double t) {
                                     const double wide = std::sin(std::numbers::pi * std::sqrt(t));
                                     return Vector2d(1.2e-3 + 5.5e-3 * wide + 1.5e-3 * (1 - t), 1.4e-3);
                                   },
                               .up = Vector3d::UnitZ(),
                               .power = 5},
                              edge));
  }
  return scissors;
}

TriangleMesh make_screwdriver(double edge) {
  TriangleMesh screwdriver = turned_solid(in_mm({{0, 0},
                                                 {13, 0, 7},
                                                 {16.5, 40, 60},
                                                 {11, 82, 20},
                                                 {13, 98, 5},
                                                 {5, 106, 3},
                                                 {3, 107, 0.5},
                                                 {3, 200, 1},
                                                 {0, 200}}),
                                          edge);
  add(screwdriver, swept_solid({.path = line_mm({0, 0, 185}, {0, 0, 212}),
                                .half_size = taper_mm({2.8, 2.8}, {4, 0.5}),
                                .up = Vector3d::UnitY(),
                                .power = 4},
                               edge));
  return screwdriver;
}

}  // namespace glissade::shapes
