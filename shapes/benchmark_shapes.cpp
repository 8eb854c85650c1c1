#include <cmath>
#include <numbers>
#include <stdexcept>

#include <glissade/base/require.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/shapes/benchmark_shapes.h>

namespace glissade::shapes {

geometry::TriangleMesh make_bumpy_plate(const Eigen::Vector2d& size, double bump_height, int wave_count,
                                        std::int64_t triangle_count) {
  base::require_positive("bump_height", bump_height);
  if (wave_count < 1 || wave_count > 10'000) {
    throw std::invalid_argument("wave_count must be from 1 to 10000, but is " + std::to_string(wave_count) + ".");
  }
  geometry::TriangleMesh plate = geometry::make_plate(size, triangle_count);
  const Eigen::Vector2d phase_per_metre = 2 * std::numbers::pi * wave_count * size.cwiseInverse();
  for (Eigen::Vector3d& point : plate.vertices) {
    const Eigen::Vector2d phase = phase_per_metre.cwiseProduct(point.head<2>());
    point.z() = bump_height / 2 * std::sin(phase.x()) * std::cos(phase.y());
  }
  return plate;
}

const std::vector<BenchmarkShape>& benchmark_shapes() {
  static const std::vector<BenchmarkShape> kShapes{
      {"headlight", &make_headlight},
      {"door-lock", &make_door_lock},
      {"car-body", &make_car_body},
      {"hose", &make_engine_hose},
      {"sphere", [](std::int64_t triangle_count) { return geometry::make_sphere(0.5, triangle_count); }},
      {"hyperboloid",
       [](std::int64_t triangle_count) { return geometry::make_hyperboloid(0.2, 0.5, 1.0, triangle_count); }},
      {"torus", [](std::int64_t triangle_count) { return geometry::make_torus(0.35, 0.15, triangle_count); }}};
  return kShapes;
}

}  // namespace glissade::shapes
