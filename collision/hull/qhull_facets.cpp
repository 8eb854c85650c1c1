#include "hull/qhull_facets.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <memory>

#include <Eigen/Core>
#include <libqhull_r/qhull_ra.h>

#include <glissade/base/assert.h>

namespace glissade::collision {
namespace {

// Qhull writes its messages to a file; this one discards them.
std::FILE* no_file() {
  static const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen("/dev/null", "w"), std::fclose);
  return file.get();
}

using Corner = Eigen::Vector3d;

// The distance of x from the segment.
double distance_of_segment(const Corner& x, const Corner& a, const Corner& b) {
  const Corner along = b - a;
  const double square = along.squaredNorm();
  const double t = square > 0.0 ? std::clamp((x - a).dot(along) / square, 0.0, 1.0) : 0.0;
  return (x - a - t * along).norm();
}

double least_altitude(const std::array<Corner, 3>& corners, int dimension) {
  if (dimension == 2) return (corners[1] - corners[0]).norm();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i)
    least = std::min(least, distance_of_segment(corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]));
  return least;
}

class Qhull {
 public:
  Qhull() { qh_zero(&qh_, no_file()); }
  ~Qhull() {
    qh_freeqhull(&qh_, !qh_ALL);
    int current = 0;
    int total = 0;
    qh_memfreeshort(&qh_, &current, &total);
  }
  Qhull(const Qhull&) = delete;
  Qhull& operator=(const Qhull&) = delete;

  bool run(std::span<double> coordinates, int dimension) {
    // Qt: cuts facets of more than three corners, which Qhull makes of nearly coplanar ones, into triangles.
    std::array<char, 12> options{"qhull Qt Pp"};
    const auto points = static_cast<int>(coordinates.size()) / dimension;
    return qh_new_qhull(&qh_, dimension, points, coordinates.data(), False, options.data(), nullptr, no_file()) == 0;
  }

  HullFacets facets(int dimension) {
    HullFacets result;
    result.altitude = std::numeric_limits<double>::infinity();
    for (const facetT* facet = qh_.facet_list; facet != nullptr && facet->next != nullptr; facet = facet->next) {
      std::array<std::int32_t, 3> corners{-1, -1, -1};
      std::array<Corner, 3> places{Corner::Zero(), Corner::Zero(), Corner::Zero()};
      for (int i = 0; i < dimension; ++i) {
        const auto* vertex = static_cast<const vertexT*>(facet->vertices->e[i].p);
        corners[static_cast<std::size_t>(i)] = qh_pointid(&qh_, vertex->point);
        for (int k = 0; k < dimension; ++k)
          places[static_cast<std::size_t>(i)][k] = vertex->point[k];
      }
      result.altitude = std::min(result.altitude, least_altitude(places, dimension));
      result.facets.push_back(corners);
    }
    // All points lie below the outer planes of the facets, and all corners above the inner ones.
    result.thickness = qh_maxouter(&qh_) - qh_.min_vertex;
    return result;
  }

 private:
  qhT qh_{};
};

}  // namespace

HullFacets qhull_facets(std::span<double> coordinates, int dimension) {
  GLISSADE_ASSERT((dimension == 2 || dimension == 3) && coordinates.size() % static_cast<std::size_t>(dimension) == 0);
  Qhull qhull;
  if (!qhull.run(coordinates, dimension)) return {};
  return qhull.facets(dimension);
}

}  // namespace glissade::collision
