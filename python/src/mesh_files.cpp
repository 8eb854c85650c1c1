#include "mesh_files.h"

#include <stdexcept>
#include <string>

namespace glissade::python {

namespace py = pybind11;

std::string path_from(const py::object& argument) {
  std::string path = py::module_::import("os").attr("fsencode")(argument).cast<py::bytes>();
  if (path.find('\0') != std::string::npos) throw std::invalid_argument("a path has a null byte");
  return path;
}

void warn_of(const simulation::SceneMesh& mesh) {
  const py::object warn = py::module_::import("warnings").attr("warn");
  for (const std::string& warning : mesh.warnings())
    warn(warning, py::arg("stacklevel") = 1);  // a function of C++ has no frame of its own
}

}  // namespace glissade::python
