#pragma once

/// The parts of the module, in the order in which their types need each other.

#include <pybind11/pybind11.h>

namespace glissade::python {

void add_meshes(pybind11::module_& module);
void add_queries(pybind11::module_& module);
void add_pipeline(pybind11::module_& module);
void add_hands(pybind11::module_& module);
void add_scene(pybind11::module_& module);
void add_simulation(pybind11::module_& module);

}  // namespace glissade::python
