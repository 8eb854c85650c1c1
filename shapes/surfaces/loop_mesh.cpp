#include "surfaces/loop_mesh.h"

#include <cmath>
#include <numbers>

namespace glissade::shapes {

Loop round_loop(double facet_radius, int points) {
  const double corner_radius = facet_radius / std::cos(std::numbers::pi / points);
  Loop loop;
  for (int i = 0; i < points; ++i) {
    const double angle = 2 * std::numbers::pi * i / points;
    loop.emplace_back(corner_radius * std::cos(angle), corner_radius * std::sin(angle));
  }
  return loop;
}

Loop polygon_loop(int sides, double facet_radius, int points) {
  const double facet_angle = 2 * std::numbers::pi / sides;
  Loop loop;
  for (int i = 0; i < points; ++i) {
    const double angle = 2 * std::numbers::pi * i / points;
    const double from_facet = std::remainder(angle, facet_angle);
    const double radius = facet_radius / std::cos(from_facet);
    loop.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return loop;
}

std::int32_t LoopMesh::vertex(Point point) const {
  const Range& range = loops_[static_cast<std::size_t>(point.loop)];
  return range.first + point.index % range.count;
}

int LoopMesh::add_loop(const Loop& loop, double z) {
  loops_.push_back({static_cast<std::int32_t>(mesh_.vertices.size()), static_cast<std::int32_t>(loop.size())});
  for (const Eigen::Vector2d& point : loop)
    mesh_.vertices.emplace_back(point.x(), point.y(), z);
  return static_cast<int>(loops_.size()) - 1;
}

void LoopMesh::add_quad(const std::array<Point, 4>& corners) {
  mesh_.triangles.push_back({vertex(corners[0]), vertex(corners[1]), vertex(corners[2])});
  mesh_.triangles.push_back({vertex(corners[0]), vertex(corners[2]), vertex(corners[3])});
}

void LoopMesh::add_band(int lower, int upper) {
  for (int i = 0; i < loops_[static_cast<std::size_t>(lower)].count; ++i)
    add_quad({{{lower, i}, {lower, i + 1}, {upper, i + 1}, {upper, i}}});
}

int LoopMesh::add_wall(int from, const Loop& loop, double z_from, double z_to, int rows) {
  int last = from;
  for (int row = 1; row <= rows; ++row) {
    const double t = static_cast<double>(row) / rows;
    const int next = add_loop(loop, row == rows ? z_to : z_from + t * (z_to - z_from));
    add_band(last, next);
    last = next;
  }
  return last;
}

void LoopMesh::add_cap(int loop, bool faces_up) {
  const auto middle = static_cast<std::int32_t>(mesh_.vertices.size());
  const double z = mesh_.vertices[static_cast<std::size_t>(vertex({loop, 0}))].z();
  mesh_.vertices.emplace_back(0.0, 0.0, z);
  for (int i = 0; i < loops_[static_cast<std::size_t>(loop)].count; ++i) {
    const std::int32_t here = vertex({loop, i});
    const std::int32_t next = vertex({loop, i + 1});
    mesh_.triangles.push_back({faces_up ? here : next, faces_up ? next : here, middle});
  }
}

}  // namespace glissade::shapes
