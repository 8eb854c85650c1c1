/// docs/studies.md names every key, column and target that there is.

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/files/text_file.h>
#include <glissade/study/slide_row.h>
#include <glissade/study/study.h>

#include "file/study_keys.h"

namespace glissade::study {
namespace {

using testing::HasSubstr;

class StudiesPage : public testing::Test {
 protected:
  /// The part of the page from this heading to the next one.
  std::string below(const std::string& heading) const {
    const std::size_t begin = page.find("\n" + heading + "\n");
    return page.substr(begin, page.find("\n## ", begin + 1) - begin);
  }

  template <typename Names>
  void expect_rows(const std::string& heading, const Names& names) const {
    for (const auto& name : names)
      EXPECT_THAT(below(heading), HasSubstr("| `" + std::string(name) + "` |")) << heading;
  }

  const std::string page = files::read_text_file(GLISSADE_DOCS "/studies.md");
};

TEST_F(StudiesPage, HasARowForEachKey) {
  expect_rows("## Keys", kStudyKeys);
  expect_rows("## Keys", kParameterKeys);
  expect_rows("## Keys", kSuccessKeys);
  expect_rows("## Keys", kSlidingKeys);
  expect_rows("## Sampling", kSamplingNames);
}

TEST_F(StudiesPage, NamesEachColumn) {
  Study study;
  study.records.fill(true);
  for (const std::string& column : columns_of(study)) {
    if (column.starts_with("last_") && column != "last_x_m" && column != "last_qz") continue;
    EXPECT_THAT(below("## Results"), HasSubstr("`" + column + "`"));
  }
  for (const std::string_view name : kRecordNames)
    EXPECT_THAT(page, HasSubstr("`" + std::string(name) + "`"));
}

TEST_F(StudiesPage, NamesEachAxis) {
  for (const std::string_view axis : kAxisNames)
    EXPECT_THAT(below("## Keys"), HasSubstr("`" + std::string(axis) + "`"));
}

}  // namespace
}  // namespace glissade::study
