#include "surfaces/planar_triangulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>

namespace glissade::shapes {
namespace {

// A vertex nearer than this to a curve counts as on it.
constexpr double kOnCurve = 1e-7;
// A vertex nearer to a curve than this fraction of its shortest edge is moved onto the curve.
constexpr double kSnapPart = 0.3;

using Edge = std::pair<std::int32_t, std::int32_t>;

Edge edge_between(std::int32_t a, std::int32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

std::size_t index(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

PlanarTriangulation::PlanarTriangulation(const Eigen::Vector2d& size, double cell) {
  const int cells_x = std::max(1, static_cast<int>(std::lround(size.x() / cell)));
  const int cells_y = std::max(1, static_cast<int>(std::lround(size.y() / cell)));
  for (int j = 0; j <= cells_y; ++j) {
    for (int i = 0; i <= cells_x; ++i) {
      const bool is_border = i == 0 || j == 0 || i == cells_x || j == cells_y;
      add_vertex({size.x() * (static_cast<double>(2 * i - cells_x) / (2.0 * cells_x)),
                  size.y() * (static_cast<double>(2 * j - cells_y) / (2.0 * cells_y))},
                 is_border);
    }
  }
  for (int j = 0; j < cells_y; ++j) {
    for (int i = 0; i < cells_x; ++i) {
      const std::int32_t p00 = j * (cells_x + 1) + i;
      const std::int32_t p10 = p00 + 1;
      const std::int32_t p01 = p00 + cells_x + 1;
      triangles_.push_back({p10, p01, p00});
      triangles_.push_back({p01, p10, p01 + 1});
    }
  }
}

void PlanarTriangulation::refine(const std::function<double(const Eigen::Vector2d&, double)>& allowed_edge) {
  std::map<Edge, std::int32_t> midpoints;
  const auto bisect = [&](const geometry::Triangle& triangle, std::vector<geometry::Triangle>& children) {
    const auto [a, b, c] = triangle;
    const auto [entry, is_new] = midpoints.try_emplace(edge_between(a, b), 0);
    if (is_new) {
      const Eigen::Vector2d middle = (vertices_[index(a)] + vertices_[index(b)]) / 2;
      // Neighbors across an edge of the rectangle's border do not exist, but its vertices must stay on the border.
      const Eigen::Vector2d border = vertices_.front().cwiseAbs();
      const bool is_border = std::abs(middle.x()) == border.x() || std::abs(middle.y()) == border.y();
      entry->second = add_vertex(middle, is_border);
    }
    children.push_back({c, a, entry->second});
    children.push_back({b, c, entry->second});
  };
  const auto has_split_edge = [&](const geometry::Triangle& triangle) {
    const auto [a, b, c] = triangle;
    return midpoints.contains(edge_between(a, b)) || midpoints.contains(edge_between(b, c)) ||
           midpoints.contains(edge_between(c, a));
  };
  bool changed = true;
  while (changed) {
    changed = false;
    std::vector<geometry::Triangle> next;
    next.reserve(triangles_.size());
    for (const geometry::Triangle& triangle : triangles_) {
      const double longest = (vertices_[index(triangle[0])] - vertices_[index(triangle[1])]).norm();
      if (longest > allowed_edge(centroid(triangle), longest) || has_split_edge(triangle)) {
        bisect(triangle, next);
        changed = true;
      } else {
        next.push_back(triangle);
      }
    }
    triangles_ = std::move(next);
  }
}

void PlanarTriangulation::cut(const std::function<double(const Eigen::Vector2d&)>& level) {
  std::vector<double> phi = snap(level);
  std::map<Edge, std::int32_t> crossings;
  const auto crosses = [&](std::int32_t a, std::int32_t b) { return phi[index(a)] * phi[index(b)] < 0; };
  const auto crossing_on = [&](std::int32_t a, std::int32_t b) {
    const auto [entry, is_new] = crossings.try_emplace(edge_between(a, b), 0);
    if (is_new) {
      entry->second = phi[index(a)] < 0 ? crossing(level, a, b) : crossing(level, b, a);
      phi.push_back(0);
    }
    return entry->second;
  };

  std::vector<geometry::Triangle> pieces;
  pieces.reserve(triangles_.size());
  for (const geometry::Triangle& triangle : triangles_) {
    // Turn the triangle so that its last two edges (b, c) and (c, a) hold all crossings.
    auto [a, b, c] = triangle;
    for (int turn = 0; turn < 2 && (crosses(a, b) || (!crosses(b, c) && crosses(c, a))); ++turn) {
      const std::int32_t first = a;
      a = b;
      b = c;
      c = first;
    }
    if (!crosses(b, c)) {
      pieces.push_back(triangle);
      continue;
    }
    const std::int32_t on_bc = crossing_on(b, c);
    if (!crosses(c, a)) {
      pieces.push_back({a, b, on_bc});
      pieces.push_back({a, on_bc, c});
      continue;
    }
    const std::int32_t on_ca = crossing_on(c, a);
    pieces.push_back({on_ca, on_bc, c});
    const double diagonal_a = (vertices_[index(a)] - vertices_[index(on_bc)]).norm();
    const double diagonal_b = (vertices_[index(b)] - vertices_[index(on_ca)]).norm();
    if (diagonal_a < diagonal_b) {
      pieces.push_back({a, b, on_bc});
      pieces.push_back({a, on_bc, on_ca});
    } else {
      pieces.push_back({a, b, on_ca});
      pieces.push_back({b, on_bc, on_ca});
    }
  }
  triangles_ = std::move(pieces);
}

void PlanarTriangulation::discard_beyond(const std::function<double(const Eigen::Vector2d&)>& level) {
  std::erase_if(triangles_, [&](const geometry::Triangle& triangle) {
    // The corner farthest from the curve decides the side: the centroid of a thin triangle may lie beyond a curved
    // chord.
    double farthest = 0;
    for (const std::int32_t corner : triangle) {
      const double phi = level(vertices_[index(corner)]);
      if (std::abs(phi) > std::abs(farthest)) farthest = phi;
    }
    return (std::abs(farthest) < kOnCurve ? level(centroid(triangle)) : farthest) > 0;
  });
}

Eigen::Vector2d PlanarTriangulation::centroid(const geometry::Triangle& triangle) const {
  return (vertices_[index(triangle[0])] + vertices_[index(triangle[1])] + vertices_[index(triangle[2])]) / 3;
}

double PlanarTriangulation::doubled_area(const geometry::Triangle& triangle) const {
  const Eigen::Vector2d ab = vertices_[index(triangle[1])] - vertices_[index(triangle[0])];
  const Eigen::Vector2d ac = vertices_[index(triangle[2])] - vertices_[index(triangle[0])];
  return ab.x() * ac.y() - ab.y() * ac.x();
}

std::int32_t PlanarTriangulation::add_vertex(const Eigen::Vector2d& position, bool is_fixed) {
  vertices_.push_back(position);
  is_fixed_.push_back(is_fixed);
  return static_cast<std::int32_t>(vertices_.size()) - 1;
}

/// Moves vertices near the curve onto it. Returns the level at each vertex, exactly 0 on the curve.
std::vector<double> PlanarTriangulation::snap(const std::function<double(const Eigen::Vector2d&)>& level) {
  std::vector<std::vector<std::int32_t>> triangles_at(vertices_.size());
  std::vector<double> shortest_edge(vertices_.size(), std::numeric_limits<double>::infinity());
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::size_t a = index(triangles_[t][corner]);
      const std::size_t b = index(triangles_[t][(corner + 1) % 3]);
      triangles_at[a].push_back(static_cast<std::int32_t>(t));
      const double length = (vertices_[a] - vertices_[b]).norm();
      shortest_edge[a] = std::min(shortest_edge[a], length);
      shortest_edge[b] = std::min(shortest_edge[b], length);
    }
  }
  std::vector<double> phi(vertices_.size());
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    phi[v] = level(vertices_[v]);
    if (!is_fixed_[v] && std::abs(phi[v]) < kSnapPart * shortest_edge[v]) {
      const Eigen::Vector2d before = vertices_[v];
      std::vector<double> area_before;
      for (const std::int32_t t : triangles_at[v]) {
        area_before.push_back(doubled_area(triangles_[index(t)]));
      }
      constexpr double kStep = 1e-6;
      const Eigen::Vector2d gradient(
          (level(before + Eigen::Vector2d(kStep, 0)) - level(before - Eigen::Vector2d(kStep, 0))) / (2 * kStep),
          (level(before + Eigen::Vector2d(0, kStep)) - level(before - Eigen::Vector2d(0, kStep))) / (2 * kStep));
      vertices_[v] = before - phi[v] * gradient;
      bool is_good = std::abs(level(vertices_[v])) < kOnCurve;
      for (std::size_t i = 0; i < triangles_at[v].size(); ++i) {
        is_good = is_good && doubled_area(triangles_[index(triangles_at[v][i])]) > 0.3 * area_before[i];
      }
      if (is_good) {
        is_fixed_[v] = true;
        phi[v] = 0;
      } else {
        vertices_[v] = before;
      }
    }
    if (std::abs(phi[v]) < kOnCurve) phi[v] = 0;
  }
  return phi;
}

std::int32_t PlanarTriangulation::crossing(const std::function<double(const Eigen::Vector2d&)>& level,
                                           std::int32_t inside, std::int32_t outside) {
  Eigen::Vector2d low = vertices_[index(inside)];
  Eigen::Vector2d high = vertices_[index(outside)];
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector2d middle = (low + high) / 2;
    (level(middle) < 0 ? low : high) = middle;
  }
  return add_vertex((low + high) / 2, true);
}

}  // namespace glissade::shapes
