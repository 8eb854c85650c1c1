#include <cmath>
#include <numbers>

#include <glissade/geometry/mesh_generators.h>

#include "household/household_shapes.h"
#include "household/solids.h"

namespace glissade::shapes {

using geometry::TriangleMesh;

TriangleMesh make_ball(double edge) {
  constexpr double kRadius = 33e-3;
  const double cells = 4 * std::numbers::pi * std::pow(kRadius / edge, 2);
  return geometry::make_sphere(kRadius, 400 + 2 * std::llround(cells));
}

TriangleMesh make_book(double edge) {
  return plate_solid(rectangle({0.15, 0.215}, 2e-3), 0.022, 1e-3, edge);
}

TriangleMesh make_card(double edge) {
  return plate_solid(rectangle({85.6e-3, 54e-3}, 3.2e-3), 0.8e-3, 0.3e-3, edge);
}

TriangleMesh make_carton(double edge) {
  return plate_solid(rectangle({0.062, 0.095}, 2e-3), 0.04, 1.5e-3, edge);
}

TriangleMesh make_coin(double edge) {
  return turned_solid(in_mm({{0, -1.1}, {12.5, -1.1, 0.4}, {12.5, 1.1, 0.4}, {0, 1.1}}), edge);
}

TriangleMesh make_die(double edge) {
  return plate_solid(rectangle({16e-3, 16e-3}, 2.5e-3), 16e-3, 2e-3, edge);
}

TriangleMesh make_paper(double edge) {
  constexpr double kBend = 0.12;  // metres, the radius at the middle
  const double size_x = 0.148;
  const double size_y = 0.105;
  TriangleMesh paper = geometry::make_plate({size_x, size_y}, 200 + 2 * std::llround(size_x * size_y / (edge * edge)));
  for (Eigen::Vector3d& p : paper.vertices)
    p.z() = p.x() * p.x() / (2 * kBend);
  return paper;
}

}  // namespace glissade::shapes
