#include "mesh_files.h"

namespace glissade::python {

namespace py = pybind11;

std::string path_from(const py::object& argument) {
  return py::module_::import("os").attr("fsencode")(argument).cast<py::bytes>();
}

void warn_of(const simulation::SceneMesh& mesh) {
  const py::object warn = py::module_::import("warnings").attr("warn");
  for (const std::string& warning : mesh.warnings())
    warn(warning, py::arg("stacklevel") = 1);  // a function of C++ has no frame of its own
}

}  // namespace glissade::python
