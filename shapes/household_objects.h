#pragma once

/// Household objects for tests and pictures of grasping. They are tools, tableware and small objects of real size, with
/// rounded edges.

#include <string>
#include <vector>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::shapes {

/// A kind of object. `make` returns its mesh in metres. `edge` (metres) is the longest edge of cells on round surfaces;
/// flat faces have larger triangles. The shape hardly depends on `edge`. Every object except the sheet of paper
/// consists of closed components with triangles that face outward. Joined components, such as a mug and its handle, may
/// overlap. The sheet of paper is an open sheet without thickness. `make` throws std::invalid_argument for an edge
/// outside 0.5 ... 20 mm. The cost is linear in the number of triangles.
struct HouseholdObject {
  std::string name;
  std::string description;
  geometry::TriangleMesh (*make)(double edge);
};

/// All objects, in alphabetical order. `shape_catalog.h` finds them by name.
const std::vector<HouseholdObject>& household_objects();

}  // namespace glissade::shapes
