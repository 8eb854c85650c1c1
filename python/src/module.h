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
void add_running();
void add_gloves(pybind11::module_& module);
void add_relay_glove(pybind11::module_& module);
void add_frame(pybind11::module_& module);
void add_server(pybind11::module_& module);
void add_recording(pybind11::module_& module);
void add_study(pybind11::module_& module);
void add_view(pybind11::module_& module);

}  // namespace glissade::python
