#include <cmath>
#include <numbers>
#include <vector>

#include <glissade/geometry/mesh_generators.h>

#include "household/household_shapes.h"
#include "household/solids.h"

namespace glissade::shapes {

using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::TriangleMesh;

TriangleMesh make_bottle(double edge) {
  return turned_solid(in_mm({{0, 0}, {35, 0, 6}, {35, 140, 30}, {13, 185, 12}, {13, 230, 1.2}, {0, 230}}), edge);
}

TriangleMesh make_bowl(double edge) {
  return turned_solid(
      in_mm({{0, 0}, {40, 0, 12}, {66, 25, 25}, {72, 60, 1.3}, {69, 60, 1.3}, {63, 27, 25}, {39, 4, 12}, {0, 4}}),
      edge);
}

TriangleMesh make_dinner_plate(double edge) {
  return turned_solid(in_mm({{0, 0}, {80, 0, 12}, {130, 18, 1.8}, {128, 21.5, 1.8}, {80, 4.5, 12}, {0, 4.5}}), edge);
}

TriangleMesh make_egg(double edge) {
  constexpr double kHalfLength = 28e-3;
  constexpr double kRadius = 21e-3;
  std::vector<Vector2d> profile;
  const int rows = 6 + static_cast<int>(std::numbers::pi * kHalfLength / edge);
  for (int row = 0; row <= rows; ++row) {
    const double angle = std::numbers::pi * row / rows;
    const bool is_end = row == 0 || row == rows;
    const double radius = is_end ? 0.0 : kRadius * std::sin(angle) * (1 + 0.15 * std::cos(angle));
    profile.emplace_back(radius, -kHalfLength * std::cos(angle));
  }
  return geometry::make_revolution(profile, false, 20 + static_cast<int>(2 * std::numbers::pi * kRadius / edge));
}

TriangleMesh make_jar_lid(double edge) {
  return turned_solid(in_mm({{0, 0}, {30, 0, 1.5}, {30, 12, 2.5}, {0, 12}}), edge);
}

TriangleMesh make_mug(double edge) {
  TriangleMesh mug =
      turned_solid(in_mm({{0, 0}, {40, 0, 4}, {41, 95, 1.6}, {37.5, 95, 1.6}, {36.5, 5, 4}, {0, 5}}), edge);
  // The ends of the handle lie within the wall.
  add(mug, swept_solid({.path = bezier_mm({{39, 0, 25}, {85, 0, 10}, {85, 0, 95}, {39.3, 0, 75}}),
                        .half_size = [](double) { return Vector2d(3.5e-3, 6e-3); },
                        .up = Vector3d::UnitY()},
                       edge));
  return mug;
}

TriangleMesh make_wine_glass(double edge) {
  return turned_solid(in_mm({{0, 0},
                             {35, 0, 0.8},
                             {34.5, 2.2, 0.8},
                             {6, 5, 6},
                             {4, 14, 10},
                             {4, 75, 10},
                             {20, 92, 15},
                             {38, 130, 40},
                             {33, 185, 0.6},
                             {31.4, 185, 0.6},
                             {36.2, 131, 38},
                             {19, 95, 14},
                             {0, 92}}),
                      edge);
}

}  // namespace glissade::shapes
