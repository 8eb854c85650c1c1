#include <chrono>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <pybind11/stl.h>

#include <glissade/study/slide_row.h>
#include <glissade/study/slide_runner.h>
#include <glissade/study/study.h>
#include <glissade/study/study_results.h>

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

  std::string row(std::int64_t slide, const study::SlideWatch& watch) const {
    return study::json_of(study_, runner_.run(slide, watch));
  }
  std::string not_run(std::int64_t slide, const std::string& problem) const {
    check(slide);
    return study::json_of(study_, runner_.not_run(slide, problem));
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

struct TooLong {};

std::string run_slide(const RunnableStudy& study, std::int64_t slide, double longest_s) {
  using Clock = std::chrono::steady_clock;
  const Unlocked unlocked;
  const Clock::time_point start = Clock::now();
  const auto check_time = [&](std::chrono::nanoseconds, const contact::Sliding&) {
    if (std::chrono::duration<double>(Clock::now() - start).count() > longest_s) throw TooLong();
  };
  try {
    return study.row(slide, check_time);
  } catch (const TooLong&) {
    return study.not_run(slide, study::too_long(longest_s));
  }
}

/// The results of a study, which outlives them.
std::unique_ptr<study::StudyResults> open_results(const py::object& folder, const RunnableStudy& study) {
  return std::make_unique<study::StudyResults>(path_from(folder), study.study(), study.runner(), study::Shard{});
}

std::vector<std::int64_t> missing(const study::StudyResults& results, std::int64_t first, std::size_t count) {
  std::vector<std::int64_t> slides;
  for (std::int64_t slide = first; slide < results.slides() && slides.size() < count; ++slide) {
    if (!results.has(slide)) slides.push_back(slide);
  }
  return slides;
}

py::dict finish(study::StudyResults& results) {
  const study::StudyCounts counts = results.finish();
  return py::dict(py::arg("slides") = counts.rows, py::arg("successes") = counts.successes,
                  py::arg("problems") = counts.problems);
}

void add_results(py::module_& module) {
  using study::StudyResults;
  py::class_<StudyResults>(module, "StudyResults", R"(The folder with the rows of a study.

Each row is on its way to the disk when it has been added, so a study that is interrupted loses nothing. Not for several
threads at once.)")
      .def(py::init(&open_results), py::arg("folder"), py::arg("study"), py::keep_alive<1, 3>(),
           R"(Creates the folder if necessary, and finds all rows in it that belong to the study.

Raises ValueError, naming the file, if a file cannot be read, or if another process writes to it.)")
      .def("__len__", &StudyResults::count)
      .def_property_readonly("outdated", &StudyResults::outdated,
                             "The number of rows in the folder whose inputs differ from those of the study.")
      .def("missing", &missing, py::arg("first"), py::arg("count"),
           "The next slides without a row, from the slide `first` on, and at most `count`.")
      .def("add", &StudyResults::add, py::arg("slide"), py::arg("row"),
           "Adds a row of `Study.run`. Raises RuntimeError if it could not be written, for example on a full disk.")
      .def("finish", &finish, R"(Writes the tables, and returns the numbers of slides, successes and problems.

All rows must be there. Raises RuntimeError if a table could not be written.)");
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
      .def("run", &run_slide, py::arg("slide"), py::arg("longest_s") = std::numeric_limits<double>::infinity(),
           R"(The row of a slide, counted from 0, as a JSON object on one line.

The row depends on the study and on the number of the slide only. A slide that is impossible has a 'problem'. A slide
that takes more than `longest_s` seconds is given up, and has a problem too. Other threads run meanwhile. Raises IndexError if the study has no such slide.)")
      .def("not_run", &RunnableStudy::not_run, py::arg("slide"), py::arg("problem"),
           "The row of a slide that was given up because of the machine. `problem` is a sentence.")
      .def("input_hash", &RunnableStudy::hash, py::arg("slide"),
           "The hash in the column 'input_hash' of the row, as a number.");
  add_results(module);
}

}  // namespace glissade::python
