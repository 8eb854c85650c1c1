#pragma once

/// Objects as a patchwork of curved quadrilaterals, tessellated one by one at any resolution, as CAD programs
/// tessellate the faces of a model.

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::shapes {

/// Smallest triangle count at which objects have their small details.
inline constexpr std::int64_t kDetailsFrom = 8'000;

/// A piece of a patch along one direction. Its ends are always lines of the tessellation, so sharp edges lie there. Its
/// `length` in metres determines its number of cells, at least `least`.
struct Span {
  double length;
  int least = 1;
};

/// One direction of a patch. The parameter runs from 0 to spans.size(), from i to i + 1 in the span i. A closed
/// direction ends where it began.
struct Axis {
  std::vector<Span> spans;
  bool is_closed = false;
};

class PatchWork {
 public:
  using Surface = std::function<Eigen::Vector3d(double u, double v)>;
  using Map = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;

  // Whether the first and the last row v shrink to a point and become a fan.
  struct Poles {
    bool is_first = false;
    bool is_last = false;
  };

  void add(Axis u, Axis v, Surface surface, Poles poles);
  void add(Axis u, Axis v, Surface surface) { add(std::move(u), std::move(v), std::move(surface), Poles{}); }

  // Adds the patches of `part`, moved by `map`, with edges shortened by the factor `fineness`.
  void add(const PatchWork& part, const Map& map, double fineness = 1);

  // A mesh of about `triangle_count` triangles: one edge length for all patches that yields this count, but no fewer
  // cells than the spans require. Every patch has vertices of its own. Throws std::invalid_argument for a count out of
  // range.
  geometry::TriangleMesh tessellated(std::int64_t triangle_count) const;

 private:
  struct Patch {
    Axis u;
    Axis v;
    Surface surface;
    Poles poles;
    double fineness;
  };
  static std::vector<double> lines(const Axis& axis, double edge);
  static void append(const Patch& patch, double edge, geometry::TriangleMesh& mesh);
  std::int64_t count(double edge) const;

  std::vector<Patch> patches_;
};

}  // namespace glissade::shapes
