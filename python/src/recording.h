#pragma once

#include <cstdint>
#include <string>

#include <pybind11/numpy.h>

namespace glissade::python {

/// An event log as tables: structured arrays, with units in the names of their fields.
struct Recording {
  std::string path;
  pybind11::array ticks;
  pybind11::array parts;
  pybind11::array hands;
  pybind11::array contacts;
  pybind11::array gloves;
  std::int32_t hand_count = 0;
  std::int32_t part_count = 0;
};

}  // namespace glissade::python
