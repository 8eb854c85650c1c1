#pragma once

/// Shapes by name, for scene files and command lines. The shapes are those of `mesh_generators.h`,
/// `benchmark_shapes.h`, `car_door_parts.h`, `household_objects.h`, `peg_and_hole.h`, `screw_thread.h`,
/// `slide_in_unit.h` and `spur_gear.h`.

#include <map>
#include <string>
#include <vector>

#include <glissade/geometry/triangle_mesh.h>
#include <glissade/shapes/shape.h>

namespace glissade::shapes {

/// Every shape, in alphabetical order.
const std::vector<Shape>& shape_catalog();

/// The mesh of the shape `name`. Parameters that are not given have their defaults. Throws std::invalid_argument for an
/// unknown shape or parameter (the message lists the known names), and for a value out of range.
geometry::TriangleMesh make_shape(const std::string& name, const std::map<std::string, double>& parameters);

}  // namespace glissade::shapes
