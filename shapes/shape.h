#pragma once

/// A shape of the catalogue, with its parameters.

#include <string>
#include <vector>

namespace glissade::shapes {

/// One parameter of a shape, with name and unit (`radius_m`, `segments`), meaning and default.
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
