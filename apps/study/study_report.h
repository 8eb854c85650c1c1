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

/// A slide that has been run again.
struct SlidePage {
  Report report;    ///< the values of its row, and its replay
  std::string row;  ///< as `study::json_of` made it
};

/// Makes the page of a slide. Throws std::runtime_error if it takes longer than `longest_s` seconds, or if
/// `should_stop` becomes true. Thread-safe.
SlidePage slide_page(const study::Study& study, const study::SlideRunner& runner, std::int64_t slide, double longest_s,
                     bool (*should_stop)());

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
    double longest_s;     ///< for the replay of a slide
    bool (*should_stop)();
  };
  explicit StudyReport(Source source) : source_(std::move(source)) {}

  /// Writes index.html, and the pages of the slides that one wants to see first: slides/N/index.html. Returns false if
  /// `should_stop` became true before all of these were there. A slide whose replay takes too long has no page. Throws
  /// what `write_html_report` throws.
  bool write() const;

  /// What a browser asks for: the page with the rows that are there, its data, the page of any slide, and the files of
  /// the folder. Throws what `slide_page` throws.
  std::optional<viewer::ServedFile> find(std::string_view path) const;

 private:
  std::string served_data() const;
  SlidePage page_of(std::int64_t slide) const;

  Source source_;
};

}  // namespace glissade::apps
