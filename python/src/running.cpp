#include "running.h"

#include <stdexcept>
#include <vector>

#include "module.h"

namespace glissade::python {

namespace py = pybind11;

namespace {

/// What the interpreter lock guards.
struct All {
  std::vector<std::weak_ptr<Running>> objects;  ///< in the order of their making
  bool has_ended = false;
};

All& all() {
  static auto& only = *new All;  // never destroyed: objects may die later
  return only;
}

/// The last first: a server ends before its gloves.
void end_all() {
  all().has_ended = true;
  while (!all().objects.empty()) {
    const std::shared_ptr<Running> last = all().objects.back().lock();
    all().objects.pop_back();
    if (last) last->end();
  }
}

void abandon_all() {
  for (const std::weak_ptr<Running>& object : all().objects) {
    if (const std::shared_ptr<Running> running = object.lock()) running->abandon();
  }
  all().objects.clear();
}

}  // namespace

void end_with_program(const std::shared_ptr<Running>& running) {
  if (all().has_ended) throw std::runtime_error("the program ends");
  std::erase_if(all().objects, [](const std::weak_ptr<Running>& object) { return object.expired(); });
  all().objects.push_back(running);
}

void add_running() {
  py::module_::import("atexit").attr("register")(py::cpp_function(&end_all));
  py::module_::import("os").attr("register_at_fork")(py::arg("after_in_child") = py::cpp_function(&abandon_all));
}

}  // namespace glissade::python
