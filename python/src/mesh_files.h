#pragma once

/// Files that an argument of Python names.

#include <string>

#include <pybind11/pybind11.h>

#include <glissade/simulation/scene.h>

namespace glissade::python {

/// The name of a file as the system has it. Throws pybind11::error_already_set for something that is no path.
std::string path_from(const pybind11::object& argument);

/// Makes what was skipped in the file of the mesh a Python warning at the line of the caller.
void warn_of(const simulation::SceneMesh& mesh);

}  // namespace glissade::python
