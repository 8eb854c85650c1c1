#pragma once

/// The table of an assembly check, which is on the disk as far as the check has come.

#include <string>

#include <glissade/apps/commands/slide_check.h>
#include <glissade/apps/text.h>
#include <glissade/files/csv.h>

namespace glissade::apps {

/// Not thread-safe.
class SlideSummary {
 public:
  /// Writes the header row; `path` and errors as for `CsvWriter`.
  explicit SlideSummary(const std::string& path);

  /// Writes the row of a check and flushes it; no row if the check was impossible. Throws std::runtime_error when not
  /// everything could be written.
  void add(const SlideCheck& check);

 private:
  CsvWriter out_;
};

}  // namespace glissade::apps
