#include "module.h"

#include <cstddef>
#include <exception>
#include <stdexcept>
#include <string_view>

namespace {

/// Wrong arguments are ValueErrors. Their sentences may have names of files, which need not be UTF-8.
void translate(std::exception_ptr exception) {
  try {
    std::rethrow_exception(exception);
  } catch (const std::invalid_argument& error) {
    const std::string_view text = error.what();
    PyObject* const sentence =
        PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "backslashreplace");
    if (sentence == nullptr) return;
    PyErr_SetObject(PyExc_ValueError, sentence);
    Py_DECREF(sentence);
  }
}

/// pybind11 would make memory without a value for an object whose class has only been asked for `__new__`.
void* refuse_without_init(std::size_t /*size*/) {
  throw pybind11::type_error("__init__() of this object was never called");
}

void refuse_objects_without_init(const pybind11::module_& module) {
  for (const auto& [name, object] : pybind11::dict(module.attr("__dict__"))) {
    if (PyType_Check(object.ptr()) == 0) continue;
    pybind11::detail::get_type_info(reinterpret_cast<PyTypeObject*>(object.ptr()))->operator_new = &refuse_without_init;
  }
}

}  // namespace

PYBIND11_MODULE(_glissade, module) {
  module.doc() = "The compiled part of glissade.";
  module.attr("__module__") = "glissade";  // of all that is defined from here on, in messages and in help()
  module.attr("__version__") = GLISSADE_VERSION;
  pybind11::register_local_exception_translator(&translate);
  pybind11::options options;
  options.disable_enum_members_docstring();
  glissade::python::add_meshes(module);
  glissade::python::add_queries(module);
  glissade::python::add_pipeline(module);
  glissade::python::add_hands(module);
  glissade::python::add_scene(module);
  glissade::python::add_simulation(module);
  glissade::python::add_running();
  glissade::python::add_gloves(module);
  glissade::python::add_frame(module);
  glissade::python::add_server(module);
  glissade::python::add_recording(module);
  glissade::python::add_study(module);
  glissade::python::add_view(module);
  refuse_objects_without_init(module);
  pybind11::delattr(module, "__module__");
}
