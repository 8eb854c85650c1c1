#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <pybind11/stl.h>

#include <glissade/study/slide_row.h>
#include <glissade/study/slide_runner.h>
#include <glissade/study/study.h>

#include "mesh_files.h"
#include "module.h"
#include "unlocked.h"

namespace glissade::python {

namespace {

/// A study that can run. The runner refers to the study, so both stay where they are.
class RunnableStudy {
 public:
  explicit RunnableStudy(const std::string& file) : study_(study::read_study(file)), runner_(study_) {}

  const study::Study& study() const { return study_; }
  const study::SlideRunner& runner() const { return runner_; }

  std::string row(std::int64_t slide) const { return study::json_of(study_, runner_.run(slide)); }
  std::string problem_row(std::int64_t slide, const std::string& problem) const {
    check(slide);
    return study::json_of(study_, runner_.problem_row(slide, problem));
  }
  std::uint64_t hash(std::int64_t slide) const {
    check(slide);
    return runner_.hash(slide);
  }

 private:
  void check(std::int64_t slide) const {
    if (slide < 0 || slide >= study_.slides)
      throw std::out_of_range("slide " + std::to_string(slide) + ": the study has " + std::to_string(study_.slides));
  }

  study::Study study_;
  study::SlideRunner runner_;
};

std::unique_ptr<RunnableStudy> open_study(const py::object& path) {
  const std::string file = path_from(path);
  const Unlocked unlocked;
  return std::make_unique<RunnableStudy>(file);
}

std::string run_slide(const RunnableStudy& study, std::int64_t slide) {
  const Unlocked unlocked;
  return study.row(slide);
}

}  // namespace

void add_study(py::module_& module) {
  py::class_<RunnableStudy>(module, "Study", R"(A study: a part slides many times through a scene.

In each slide, the parameters have other values. docs/studies.md has the file and the columns. Threads may share a study.)")
      .def(py::init(&open_study), py::arg("path"), R"(Reads a study file, its scene and all files that they name.

Builds the trees of the meshes. Raises ValueError, naming file, line and key, for every deviation from the format.)")
      .def("__len__", [](const RunnableStudy& study) { return study.study().slides; })
      .def_property_readonly(
          "columns", [](const RunnableStudy& study) { return study::columns_of(study.study()); },
          "The names of the columns of the table.")
      .def_property_readonly(
          "parameters",
          [](const RunnableStudy& study) {
            std::vector<std::string> names;
            for (const study::Parameter& parameter : study.study().parameters)
              names.push_back(parameter.name);
            return names;
          },
          "The names of the parameters.")
      .def("run", &run_slide, py::arg("slide"), R"(The row of a slide, counted from 0, as a JSON object on one line.

The row depends on the study and on the number of the slide only. A slide that is impossible has a 'problem'. Other
threads run meanwhile. Raises IndexError if the study has no such slide.)")
      .def("problem_row", &RunnableStudy::problem_row, py::arg("slide"), py::arg("problem"),
           "The row of a slide that could not be run, as `run` gives it. `problem` is a sentence.")
      .def("input_hash", &RunnableStudy::hash, py::arg("slide"),
           "The hash in the column 'input_hash' of the row, as a number.");
}

}  // namespace glissade::python
