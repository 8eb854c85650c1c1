#include "cgal_oracle.h"

#include <cmath>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/intersections.h>
#include <CGAL/squared_distance_3.h>

namespace glissade::test_support {
namespace {

using geometry::TrianglePoints;

template <typename Kernel>
typename Kernel::Point_3 to_cgal(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

template <typename Kernel>
typename Kernel::Triangle_3 to_cgal(const geometry::TrianglePoints& t) {
  return {to_cgal<Kernel>(t[0]), to_cgal<Kernel>(t[1]), to_cgal<Kernel>(t[2])};
}

// The triangle `flat` without an area stands for its edges.
template <typename Kernel>
bool meets_flat(const typename Kernel::Triangle_3& triangle, const typename Kernel::Triangle_3& flat) {
  if (flat[0] == flat[1] && flat[1] == flat[2]) return triangle.has_on(flat[0]);
  for (int i = 0; i < 3; ++i) {
    const typename Kernel::Segment_3 edge(flat[i], flat[i + 1]);
    if (!edge.is_degenerate() && CGAL::do_intersect(triangle, edge)) return true;
  }
  return false;
}

}  // namespace

bool cgal_intersect(const geometry::TrianglePoints& a, const geometry::TrianglePoints& b) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  const Kernel::Triangle_3 triangle_a = to_cgal<Kernel>(a);
  const Kernel::Triangle_3 triangle_b = to_cgal<Kernel>(b);
  return triangle_b.is_degenerate() ? meets_flat<Kernel>(triangle_a, triangle_b)
                                    : CGAL::do_intersect(triangle_a, triangle_b);
}

bool cgal_is_degenerate(const geometry::TrianglePoints& triangle) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  return to_cgal<Kernel>(triangle).is_degenerate();
}

double cgal_distance(const geometry::TrianglePoints& a, const geometry::TrianglePoints& b) {
  using Kernel = CGAL::Simple_cartesian<CGAL::Exact_rational>;
  return std::sqrt(CGAL::to_double(CGAL::squared_distance(to_cgal<Kernel>(a), to_cgal<Kernel>(b))));
}

double cgal_distance(const Eigen::Vector3d& point, const geometry::TrianglePoints& triangle) {
  using Kernel = CGAL::Simple_cartesian<CGAL::Exact_rational>;
  return std::sqrt(CGAL::to_double(CGAL::squared_distance(to_cgal<Kernel>(point), to_cgal<Kernel>(triangle))));
}

}  // namespace glissade::test_support
