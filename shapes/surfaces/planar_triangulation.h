#pragma once

/// A conforming triangulation of a rectangle that can be refined locally and cut along curves.

#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::shapes {

class PlanarTriangulation {
 public:
  // The rectangle of `size` about the origin in about square cells with edges of about `cell`, each of two triangles.
  PlanarTriangulation(const Eigen::Vector2d& size, double cell);

  // Bisects triangles (newest-vertex bisection, which keeps the angles of the first cells) until every triangle has
  // `longest_edge` <= allowed_edge(centroid, longest_edge). Call it before the first cut.
  void refine(const std::function<double(const Eigen::Vector2d&, double)>& allowed_edge);

  // Makes the zero set of `level`, a signed distance in metres, a chain of edges: moves near vertices onto it where no
  // triangle becomes too small, and splits the edges that still cross it.
  void cut(const std::function<double(const Eigen::Vector2d&)>& level);

  // Drops the triangles on the positive side of a curve along which the mesh has been cut.
  void discard_beyond(const std::function<double(const Eigen::Vector2d&)>& level);

  const std::vector<Eigen::Vector2d>& vertices() const { return vertices_; }
  const std::vector<geometry::Triangle>& triangles() const { return triangles_; }

 private:
  Eigen::Vector2d centroid(const geometry::Triangle& triangle) const;
  double doubled_area(const geometry::Triangle& triangle) const;
  std::int32_t add_vertex(const Eigen::Vector2d& position, bool is_fixed);
  std::vector<double> snap(const std::function<double(const Eigen::Vector2d&)>& level);
  std::int32_t crossing(const std::function<double(const Eigen::Vector2d&)>& level, std::int32_t inside,
                        std::int32_t outside);

  std::vector<Eigen::Vector2d> vertices_;
  // Vertices that must stay: those of the border and of earlier cuts.
  std::vector<bool> is_fixed_;
  // The first two corners span the edge to bisect next; the third is the newest vertex.
  std::vector<geometry::Triangle> triangles_;
};

}  // namespace glissade::shapes
