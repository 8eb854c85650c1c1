#pragma once

/// A shape of the catalogue: its name and its parameters.

#include <string>
#include <vector>

namespace glissade::shapes {

/// One parameter of a shape: its name with its unit (`radius_m`, `segments`), its meaning, and its default.
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

}  // namespace glissade::shapes
