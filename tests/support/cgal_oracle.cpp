#include "cgal_oracle.h"

#include <cmath>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/intersections.h>
#include <CGAL/squared_distance_3.h>

namespace glissade::test_support {
namespace {

using collision::TrianglePoints;

template <typename Kernel>
typename Kernel::Point_3 to_cgal(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

template <typename Kernel>
typename Kernel::Triangle_3 to_cgal(const TrianglePoints& t) {
  return {to_cgal<Kernel>(t[0]), to_cgal<Kernel>(t[1]), to_cgal<Kernel>(t[2])};
}

}  // namespace

bool cgal_intersect(const TrianglePoints& a, const TrianglePoints& b) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  return CGAL::do_intersect(to_cgal<Kernel>(a), to_cgal<Kernel>(b));
}

bool cgal_is_degenerate(const TrianglePoints& triangle) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  return to_cgal<Kernel>(triangle).is_degenerate();
}

double cgal_distance(const TrianglePoints& a, const TrianglePoints& b) {
  using Kernel = CGAL::Simple_cartesian<CGAL::Exact_rational>;
  return std::sqrt(CGAL::to_double(CGAL::squared_distance(to_cgal<Kernel>(a), to_cgal<Kernel>(b))));
}

double cgal_distance(const Eigen::Vector3d& point, const TrianglePoints& triangle) {
  using Kernel = CGAL::Simple_cartesian<CGAL::Exact_rational>;
  return std::sqrt(CGAL::to_double(CGAL::squared_distance(to_cgal<Kernel>(point), to_cgal<Kernel>(triangle))));
}

}  // namespace glissade::test_support
