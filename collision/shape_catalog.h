#pragma once

/// The generators of `mesh_generators.h`, `benchmark_shapes.h`, `car_door_parts.h` and of the machine elements
/// (`peg_and_hole.h`, `screw_thread.h`, `slide_in_unit.h`, `spur_gear.h`) by name, for scene files and command lines.

#include <map>
#include <string>
#include <vector>

#include <glissade/collision/triangle_mesh.h>

namespace glissade::collision {

/// One parameter of a shape: its name with its unit (`radius_m`, `segments`), what it is, and its default.
struct ShapeParameter {
  std::string name;
  std::string description;
  double default_value;
};

/// One entry of the catalogue.
struct Shape {
  std::string name;
  std::string description;
  std::vector<ShapeParameter> parameters;
};

/// Every shape, in alphabetical order.
const std::vector<Shape>& shape_catalog();

/// The mesh of shape `name`; parameters not given take their defaults.
/// Throws std::invalid_argument, naming what is known, for an unknown shape or parameter, and for a value out of range.
TriangleMesh make_shape(const std::string& name, const std::map<std::string, double>& parameters);

}  // namespace glissade::collision
