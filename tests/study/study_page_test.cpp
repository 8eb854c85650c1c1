/// The data of the page of a study.

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <glissade/study/slide_runner.h>
#include <glissade/study/study_page.h>

#include "study_folder.h"

namespace glissade::study {
namespace {

using nlohmann::json;
using testing::ElementsAre;

/// Offsets of up to 0.4 mm in a hole with a play of 0.1 mm on each side.
const Study& offsets() {
  static const StudyFolder folder;
  static const Study study = folder.read(
      "parameters:\n"
      "  - {vary: path.x_m, uniform: [-0.0004, 0.0004]}\n"
      "  - {vary: metaphor, one_of: [force-feedback, rubber-band]}\n"
      "slides: 20\n");
  return study;
}

/// The page of all slides but the last `missing` ones.
json page_of(std::int64_t most_rows, int missing = 0) {
  const SlideRunner runner(offsets());
  StudyPage page(offsets(), most_rows);
  for (int slide = 0; slide < 20 - missing; ++slide)
    page.add(json_of(offsets(), runner.run(slide)));
  return json::parse(page.to_json({3}, "glissade study offsets.yaml"));
}

json column(const json& page, const std::string& name) {
  const auto& columns = page["table"]["columns"];
  const auto place = std::find(columns.begin(), columns.end(), name) - columns.begin();
  return page["table"]["data"][static_cast<std::size_t>(place)];
}

TEST(StudyPage, HasTheRowsByColumn) {
  const json page = page_of(100);
  EXPECT_EQ(page["slides"], 20);
  EXPECT_TRUE(page["is_complete"]);
  EXPECT_EQ(page["summary"]["slides"], 20);
  EXPECT_EQ(page["replays"], json({3}));
  const SlideRow row = SlideRunner(offsets()).run(7);
  EXPECT_NEAR(column(page, "path.x_m")[7].get<double>(), row.values[0], 1e-6 * std::abs(row.values[0]));
  EXPECT_EQ(page["table"]["words"]["outcome"][column(page, "outcome")[7].get<std::size_t>()], row.outcome);
  EXPECT_EQ(page["table"]["words"]["metaphor"].size(), 2U);
}

TEST(StudyPage, OfManySlidesItHasSomeThatAreEvenlyChosen) {
  const json page = page_of(7);
  EXPECT_THAT(column(page, "slide"), ElementsAre(0, 3, 6, 9, 12, 15, 18));
  EXPECT_EQ(page["summary"]["slides"], 20) << "the summary counts all of them";
}

TEST(StudyPage, TellsThatSlidesAreMissing) {
  const json page = page_of(100, 5);
  EXPECT_FALSE(page["is_complete"]);
  EXPECT_EQ(column(page, "slide").size(), 15U);
}

TEST(StudyPage, NotableSlidesHaveTheGreatestForcesAndTheJams) {
  const SlideRunner runner(offsets());
  StudyPage page(offsets());
  for (int slide = 0; slide < 20; ++slide)
    page.add(json_of(offsets(), runner.run(slide)));
  const std::vector<std::int64_t> notable = page.notable_slides();
  const json summary = json::parse(page.to_json({}, ""))["summary"];
  for (const auto& slide : summary["greatest_forces"])
    EXPECT_THAT(notable, testing::Contains(slide.get<std::int64_t>()));
  ASSERT_FALSE(summary["jams"].empty());
  EXPECT_THAT(notable, testing::Contains(summary["jams"][0]["first_slide"].get<std::int64_t>()));
}

}  // namespace
}  // namespace glissade::study
