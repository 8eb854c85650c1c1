#pragma once

/// The folder with the results of a study. Each run appends its rows to a journal, so that a run that was stopped loses
/// nothing. When all rows are there, they are written in the order of the slides.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include <glissade/study/slide_runner.h>
#include <glissade/study/study.h>
#include <glissade/study/success_rate.h>

namespace glissade::study {

/// The share of a study that one run does: the slides `part`, `part` + `parts`, `part` + 2 `parts` …, from 0.
struct Shard {
  std::int64_t part = 0;
  std::int64_t parts = 1;

  bool is_all() const { return parts == 1; }
};

/// Counts over all rows.
struct StudyCounts {
  std::int64_t rows = 0;
  std::int64_t successes = 0;
  std::int64_t problems = 0;
  Rate rate{};  ///< success rate; its interval is without meaning for a grid
};

/// Not thread-safe. Memory: 16 bytes for each slide.
class StudyResults {
 public:
  /// `study` and `runner` must outlive this object. Creates the folder if necessary, and finds all rows in it that
  /// belong to the study. Throws std::invalid_argument, naming the file, if the folder cannot be created, if a file in
  /// it cannot be read, if another run writes the same journal, and if the folder is that of the pilot.
  StudyResults(std::filesystem::path folder, const Study& study, const SlideRunner& runner, const Shard& shard);
  ~StudyResults();
  StudyResults(const StudyResults&) = delete;
  StudyResults& operator=(const StudyResults&) = delete;

  std::int64_t slides() const { return study_.slides; }
  bool has(std::int64_t slide) const { return places_[static_cast<std::size_t>(slide)].file >= 0; }
  std::int64_t count() const { return count_; }
  /// Rows in the folder whose inputs differ from those of the study, for example because a mesh has changed since.
  std::int64_t outdated() const { return outdated_; }

  /// Appends a row to the journal; it is on its way to the disk when the call returns. Throws std::runtime_error if the
  /// row belongs to other inputs, for example because a worker has read files that have changed since, and if the row
  /// could not be written, for example on a full disk.
  void add(std::int64_t slide, const std::string& json);

  /// Calls `see` with each row that is there, in the order of the slides. Throws what `see` throws, and
  /// std::runtime_error if a file cannot be read any more.
  void for_each_row(const std::function<void(const std::string& json)>& see);

  /// Writes slides.csv, slides.jsonl and study.json, and removes the journals that no other run is writing. Each file
  /// is written under another name and then renamed. Throws std::logic_error if a row is missing, and
  /// std::runtime_error if a file could not be written.
  StudyCounts finish();
  bool is_finished() const { return is_finished_; }

 private:
  struct Place {
    std::int32_t file = -1;
    std::int64_t offset = 0;
  };

  void find_rows(const std::filesystem::path& file);
  void note_row(const std::string& line, const std::string& where, const Place& place);
  void open_journal(const Shard& shard);
  std::string row(std::int64_t slide);

  std::filesystem::path folder_;
  const Study& study_;
  const SlideRunner& runner_;
  std::vector<Place> places_;
  std::vector<std::filesystem::path> paths_{};
  std::ifstream file_{};  // the one with the number `reading_`
  std::int32_t reading_ = -1;
  std::filesystem::path journal_path_{};
  int journal_ = -1;
  std::int64_t count_ = 0;
  std::int64_t outdated_ = 0;
  bool is_finished_ = false;
};

}  // namespace glissade::study
