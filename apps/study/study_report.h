#pragma once

/// The pages of a study: one with all slides, and one with the replay of a single slide.

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glissade/apps/report/html_report.h>
#include <glissade/study/slide_runner.h>
#include <glissade/study/study.h>
#include <glissade/study/study_results.h>
#include <glissade/viewer/page_server.h>

namespace glissade::apps {

/// Runs a slide again, and makes its page: the values of its row, and its replay. Thread-safe.
Report slide_report(const study::Study& study, const study::SlideRunner& runner, std::int64_t slide);

/// The pages of the study in a folder. Thread-safe, if all others lock `rows_mutex` to use `results`.
class StudyReport {
 public:
  struct Source {
    const study::Study& study;
    const study::SlideRunner& runner;
    study::StudyResults& results;
    std::mutex& rows_mutex;
    std::string folder;
    std::string command;  ///< that runs the study
  };
  explicit StudyReport(Source source) : source_(std::move(source)) {}

  /// Writes index.html, and the pages of the slides that one wants to see first: slides/N/index.html. `should_stop` may
  /// end it before all of these are there. Throws what `write_html_report` throws.
  void write(bool (*should_stop)()) const;

  /// What a browser asks for: the page with the rows that are there, its data, the page of any slide, and the files of
  /// the folder.
  std::optional<viewer::ServedFile> find(std::string_view path) const;

 private:
  std::string data(const std::vector<std::int64_t>& replays) const;
  Report page(const std::vector<std::int64_t>& replays) const;

  Source source_;
};

}  // namespace glissade::apps
