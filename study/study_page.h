#pragma once

/// What the report of a study shows.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <glissade/study/study.h>

namespace glissade::study {

/// What a page knows beside the rows.
struct StudyPageContext {
  std::vector<std::int64_t> replays{};  ///< slides that have a page of their own beside the page
  std::string command;                  ///< that has run the study
  bool is_served = false;               ///< a server makes the page of each slide on request
  bool is_complete = false;             ///< the tables have been written
};

/// Collects the rows of a study for its page. Memory: some 200 bytes for each of the rows on the page, and what a
/// summary needs for the others.
class StudyPage {
 public:
  /// A page has a row for each slide. Of more than `most_rows` slides, it has each second one, each third one, and so
  /// on.
  explicit StudyPage(const Study& study, std::int64_t most_rows = 100'000);
  ~StudyPage();

  /// Adds a row, as `json_of` made it. Rows come in the order of the slides; some may be missing.
  void add(const std::string& json);

  /// The slides that one wants to see first: those with the greatest forces, one for each of the places where most
  /// slides jam, and the first failure with each outcome.
  std::vector<std::int64_t> notable_slides() const;

  /// The data of the page, as JSON.
  std::string to_json(const StudyPageContext& context) const;

 private:
  struct Table;

  const Study& study_;
  std::unique_ptr<Table> table_;
};

}  // namespace glissade::study
