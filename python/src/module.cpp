#include "module.h"

PYBIND11_MODULE(_glissade, module) {
  module.doc() = "The compiled part of glissade.";
  module.attr("__version__") = GLISSADE_VERSION;
  pybind11::options options;
  options.disable_enum_members_docstring();
  glissade::python::add_meshes(module);
  glissade::python::add_queries(module);
  glissade::python::add_pipeline(module);
  glissade::python::add_hands(module);
  glissade::python::add_scene(module);
  glissade::python::add_simulation(module);
}
