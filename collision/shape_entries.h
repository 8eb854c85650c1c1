#pragma once

// What the shape catalogue is put together from. Private to it.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include <glissade/collision/shape_catalog.h>

namespace glissade::collision {

// The parameters of one call, complete with defaults.
using ShapeValues = std::map<std::string, double>;

struct ShapeEntry {
  Shape shape;
  std::function<TriangleMesh(const ShapeValues&)> make;
};

// Pegs, threads, gears and slide-in units.
std::vector<ShapeEntry> machine_element_entries();

}  // namespace glissade::collision
