#include "random_triangles.h"

#include <cmath>
#include <limits>

#include "cgal_oracle.h"

namespace glissade::test_support {
namespace {

using Eigen::Vector3d;
using geometry::TrianglePoints;

bool has_area(const TrianglePair& pair) {
  return !cgal_is_degenerate(pair.a) && !cgal_is_degenerate(pair.b);
}

TrianglePair scaled(const TrianglePair& pair, double scale, const Vector3d& offset) {
  TrianglePair result = pair;
  for (geometry::TrianglePoints* triangle : {&result.a, &result.b}) {
    for (Vector3d& corner : *triangle) {
      corner = scale * corner + offset;
    }
  }
  return result;
}

}  // namespace

double RandomTriangles::uniform(double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random_);
}

int RandomTriangles::integer(int low, int high) {
  return std::uniform_int_distribution<int>(low, high)(random_);
}

Vector3d RandomTriangles::point_in_cube(double half_edge) {
  const double x = uniform(-half_edge, half_edge);
  const double y = uniform(-half_edge, half_edge);
  return {x, y, uniform(-half_edge, half_edge)};
}

TrianglePair RandomTriangles::anywhere() {
  TrianglePair pair;
  do {
    for (geometry::TrianglePoints* triangle : {&pair.a, &pair.b}) {
      for (Vector3d& corner : *triangle) {
        corner = point_in_cube(1.0);
      }
    }
  } while (!has_area(pair));
  return pair;
}

TrianglePair RandomTriangles::on_lattice(int side) {
  TrianglePair pair;
  do {
    for (geometry::TrianglePoints* triangle : {&pair.a, &pair.b}) {
      for (Vector3d& corner : *triangle) {
        for (double& coordinate : corner) {
          coordinate = integer(0, side);
        }
      }
    }
  } while (!has_area(pair));
  return pair;
}

Vector3d RandomTriangles::point_of(const geometry::TrianglePoints& triangle) {
  switch (integer(0, 3)) {
    case 0:
      return triangle[0];
    case 1: {
      const double t = uniform(0.0, 1.0);
      return (1.0 - t) * triangle[0] + t * triangle[1];
    }
    case 2: {
      double u = uniform(0.0, 1.0);
      double v = uniform(0.0, 1.0);
      if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
      }
      return (1.0 - u - v) * triangle[0] + u * triangle[1] + v * triangle[2];
    }
    default: {
      const double u = uniform(-1.0, 1.0);
      return (1.0 - 2.0 * u) * triangle[0] + u * triangle[1] + u * triangle[2];
    }
  }
}

Vector3d RandomTriangles::moved_by_ulps(const Vector3d& p) {
  Vector3d result = p;
  for (double& coordinate : result) {
    const double target =
        integer(0, 1) == 0 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
    for (int steps = integer(0, 2); steps > 0; --steps) {
      coordinate = std::nextafter(coordinate, target);
    }
  }
  return result;
}

TrianglePair RandomTriangles::nearly_touching() {
  TrianglePair pair;
  do {
    const double scale = std::pow(10.0, integer(-6, 3));
    const Vector3d offset = integer(0, 3) == 0 ? point_in_cube(1e6) : Vector3d::Zero().eval();
    pair = scaled(anywhere(), scale, offset);
    const Vector3d target = point_of(pair.a);
    pair.b[0] = moved_by_ulps(target);
    if (integer(0, 1) == 0) {
      // The edge 0 1 of b passes through the target.
      const Vector3d direction = pair.b[1] - target;
      pair.b[0] = moved_by_ulps(target - uniform(0.1, 1.0) * direction);
    }
  } while (!has_area(pair));
  return pair;
}

TrianglePair RandomTriangles::nearly_coplanar() {
  TrianglePair pair;
  do {
    pair.a = anywhere().a;
    for (Vector3d& corner : pair.b) {
      const double u = uniform(-1.5, 1.5);
      const double v = uniform(-1.5, 1.5);
      corner = moved_by_ulps((1.0 - u - v) * pair.a[0] + u * pair.a[1] + v * pair.a[2]);
    }
    if (integer(0, 2) == 0) {
      pair.b[0] = pair.a[1];
    }
    if (integer(0, 2) == 0) {
      pair.b[1] = pair.a[2];
    }
  } while (!has_area(pair));
  return pair;
}

}  // namespace glissade::test_support
