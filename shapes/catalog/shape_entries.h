#pragma once

/// The entries of the shape catalogue, with the functions that make their meshes.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include <glissade/geometry/triangle_mesh.h>
#include <glissade/shapes/shape.h>

namespace glissade::shapes {

/// The parameters of one call, complete with defaults.
using ShapeValues = std::map<std::string, double>;

struct ShapeEntry {
  Shape shape;
  std::function<geometry::TriangleMesh(const ShapeValues&)> make;
};

/// Pegs, threads, gears and slide-in units.
std::vector<ShapeEntry> machine_element_entries();

}  // namespace glissade::shapes
