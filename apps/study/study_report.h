#pragma once

/// The pages of a study: one with all slides, and one with the replay of a single slide.

#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glissade/apps/study/study_workers.h>
#include <glissade/study/slide_runner.h>
#include <glissade/study/study.h>
#include <glissade/study/study_results.h>
#include <glissade/viewer/page_server.h>

namespace glissade::apps {

/// The folder with the page of a slide.
std::string page_folder(const std::string& study_folder, std::int64_t slide);

/// Runs a slide, writes its page with the values of its row and its replay, and returns the row as `study::json_of`
/// makes it. Throws what `write_html_report` throws. Thread-safe for different folders.
std::string write_slide_page(const study::Study& study, const study::SlideRunner& runner, std::int64_t slide,
                             const std::string& folder);

/// The pages of the study in a folder. The page of a slide is made by a worker process, once. Thread-safe, if all
/// others lock `rows_mutex` to use `results`.
class StudyReport {
 public:
  struct Source {
    const study::Study& study;
    const study::SlideRunner& runner;
    study::StudyResults& results;
    std::mutex& rows_mutex;
    std::string folder;
    std::string command;  ///< that runs the study
    StudyWork work;       ///< without `pages`, `next` and `take`
  };
  explicit StudyReport(Source source) : source_(std::move(source)) {}

  /// Writes index.html, and the pages of the slides that one wants to see first: slides/N/index.html. Returns false if
  /// `should_stop` became true before all of these were there. A slide that takes too long or crashes has no page.
  /// Throws what `write_html_report` and `run_slides` throw.
  bool write();

  /// What a browser asks for: the page with the rows that are there, its data, the page of any slide, and the files of
  /// the folder. Throws std::runtime_error, with the reason, if a slide has no page.
  std::optional<viewer::ServedFile> find(std::string_view path);

 private:
  std::string served_data() const;
  std::string page_path(std::int64_t slide) const;
  bool has_page(std::int64_t slide) const;
  void make_pages(const std::vector<std::int64_t>& slides,
                  const std::function<void(std::int64_t slide, const std::string& row)>& see);
  void make_page(std::int64_t slide);

  Source source_;
  std::mutex pages_mutex_{};  // one writer of a page
};

}  // namespace glissade::apps
