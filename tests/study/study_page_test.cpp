/// The data of the page of a study.

#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <glissade/study/sampler.h>
#include <glissade/study/slide_runner.h>
#include <glissade/study/study_page.h>

#include "study_folder.h"

namespace glissade::study {
namespace {

using nlohmann::json;

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
  return json::parse(page.to_json({.replays = {3}, .command = "glissade study offsets.yaml"}));
}

json column(const json& page, const std::string& name) {
  const auto& columns = page["table"]["columns"];
  const auto place = std::find(columns.begin(), columns.end(), name) - columns.begin();
  return page["table"]["data"][static_cast<std::size_t>(place)];
}

TEST(StudyPage, HasTheRowsByColumn) {
  const json page = page_of(100);
  EXPECT_EQ(page["slides"], 20);
  EXPECT_EQ(page["summary"]["slides"], 20);
  EXPECT_EQ(page["replays"], json({3}));
  const SlideRow row = SlideRunner(offsets()).run(7);
  EXPECT_NEAR(column(page, "path.x_m")[7].get<double>(), row.values[0], 1e-6 * std::abs(row.values[0]));
  EXPECT_EQ(page["table"]["words"]["outcome"][column(page, "outcome")[7].get<std::size_t>()], row.outcome);
  EXPECT_EQ(page["table"]["words"]["metaphor"].size(), 2U);
}

/// Every fourth point of a Sobol sequence lies in one quarter of a plane.
TEST(StudyPage, OfManySlidesItHasSomeFromEverywhere) {
  Study study = offsets();
  study.parameters.resize(1);
  study.slides = 4096;
  const Sampler sampler(study);
  StudyPage page(study, 1024);
  for (std::int64_t slide = 0; slide < study.slides; ++slide)
    page.add(json_of(study, {.slide = slide, .values = sampler.values(slide), .outcome = "jammed", .problem = "none"}));
  const json data = json::parse(page.to_json({}));
  const json x = column(data, "path.x_m");
  EXPECT_NEAR(static_cast<double>(x.size()), 1024.0, 100.0);
  const auto above = std::count_if(x.begin(), x.end(), [](const json& value) { return value.get<double>() > 0.0; });
  EXPECT_NEAR(static_cast<double>(above) / static_cast<double>(x.size()), 0.5, 0.06);
  EXPECT_EQ(data["summary"]["slides"], 4096) << "the summary counts all of them";
}

TEST(StudyPage, SlidesMayBeMissing) {
  const json page = page_of(100, 5);
  EXPECT_EQ(column(page, "slide").size(), 15U);
}

TEST(StudyPage, NotableSlidesHaveTheGreatestForcesTheJamsAndTheFirstFailure) {
  const SlideRunner runner(offsets());
  StudyPage page(offsets());
  for (int slide = 0; slide < 20; ++slide)
    page.add(json_of(offsets(), runner.run(slide)));
  const std::vector<std::int64_t> notable = page.notable_slides();
  const json summary = json::parse(page.to_json({}))["summary"];
  for (const auto& slide : summary["greatest_forces"])
    EXPECT_THAT(notable, testing::Contains(slide.get<std::int64_t>()));
  std::int64_t first_failure = 0;
  while (runner.run(first_failure).outcome == "success")
    ++first_failure;
  EXPECT_THAT(notable, testing::Contains(first_failure));
  ASSERT_FALSE(summary["jams"].empty());
  EXPECT_THAT(notable, testing::Contains(summary["jams"][0]["first_slide"].get<std::int64_t>()));
}

}  // namespace
}  // namespace glissade::study
