#pragma once

/// Runs the slides of a study in several processes.

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include <glissade/study/slide_runner.h>

namespace glissade::apps {

struct StudyWork {
  std::string study_file;
  std::string pages{};                 ///< folder for the page of each slide, see `page_folder`; empty: rows only
  int workers = 1;                     ///< processes
  std::chrono::nanoseconds longest{};  ///< time of a slide
  /// The next slide to run; std::nullopt if there is none. Not called by two threads at once.
  std::function<std::optional<std::int64_t>()> next;
  /// Takes the row of a slide as JSON. Not called by two threads at once.
  std::function<void(std::int64_t slide, const std::string& json)> take;
  /// Whether to stop before all slides are done. Thread-safe.
  std::function<bool()> should_stop;
};

/// A slide whose process dies is tried three times, each time in a new process. Then, and if it takes too long, its row
/// tells the problem. Throws std::runtime_error if processes cannot start three times in a row. Also throws what `take`
/// throws, after the slides that are running have been stopped.
void run_slides(const study::Study& study, const study::SlideRunner& runner, const StudyWork& work);

}  // namespace glissade::apps
