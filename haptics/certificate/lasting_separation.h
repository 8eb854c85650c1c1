#pragma once

/// A direction that separates two triangles for as long as possible while they slide past each other.

#include <algorithm>

#include <Eigen/Core>

#include <glissade/geometry/triangle_pair.h>

namespace glissade::haptics {

/// Both triangles at one moment of a path.
struct TrianglesAtMoment {
  geometry::TrianglePoints obstacle;
  geometry::TrianglePoints part;
};

/// A direction, from the obstacle to the part, and how far it separates two triangles at both ends of a path; metres.
struct Separation {
  Eigen::Vector3d n;
  double begin;
  double end;

  double least() const { return std::min(begin, end); }
};

/// Of a few directions the one that would keep the triangles apart by `gap` metres for the most paths like this one, or
/// else one that separates them by as much as any at both ends. The directions are the normals of both triangles, one
/// between both, these again but across the motion, and that of the closest points. The last one separates the most,
/// but where triangles slide towards each other it serves for a short way only. n is zero where all fail.
Separation lasting_separation(const TrianglesAtMoment& begin, const TrianglesAtMoment& end, double gap);

}  // namespace glissade::haptics
