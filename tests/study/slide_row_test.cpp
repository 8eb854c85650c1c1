/// Rows of a study as JSON and CSV.

#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <glissade/study/slide_row.h>

namespace glissade::study {
namespace {

Study study_of(std::initializer_list<Record> records) {
  Study study;
  study.parameters = {{.name = "metaphor", .distribution = {OneOf{{"incremental", "rubber-band"}, {}}}},
                      {.name = "offset", .distribution = {Uniform{0.0, 1.0}}}};
  for (const Record record : records)
    study.records[static_cast<std::size_t>(record)] = true;
  return study;
}

TEST(SlideRow, HasItsParametersByNameAndExactNumbers) {
  SlideRow row{.slide = 4, .values = {1.0, 0.1 + 0.2}, .input_hash = 255, .outcome = "success"};
  row.measures.force_max_N = 1.0 / 3.0;
  row.measures.clearance_min_m = std::numeric_limits<double>::infinity();
  const Study study = study_of({Record::kForces, Record::kClearance});
  const nlohmann::json json = nlohmann::json::parse(json_of(study, row));
  EXPECT_EQ(json["slide"], 4);
  EXPECT_EQ(json["metaphor"], "rubber-band");
  EXPECT_EQ(json["offset"], 0.1 + 0.2);
  EXPECT_EQ(json["success"], 1);
  EXPECT_EQ(json["force_max_N"], 1.0 / 3.0);
  EXPECT_TRUE(json["clearance_min_m"].is_null()) << "nothing came near";
  EXPECT_EQ(json["input_hash"], "00000000000000ff");
  EXPECT_FALSE(json.contains("work_J")) << "not recorded";
}

TEST(SlideRow, ColumnsAreThoseOfEveryRow) {
  const Study study = study_of({Record::kForces, Record::kJam, Record::kLastPose});
  const SlideRow row{.slide = 1, .values = {0.0, 0.5}, .outcome = "problem", .problem = "in 'wall', 2 mm deep"};
  const std::string csv = csv_of(json_of(study, row));
  EXPECT_TRUE(csv.starts_with("1,incremental,0.5,0,problem,")) << csv;
  EXPECT_THAT(csv, testing::HasSubstr("\"in 'wall', 2 mm deep\"")) << "a cell with a comma is quoted";
  const auto commas = static_cast<std::size_t>(std::count(csv.begin(), csv.end(), ','));
  EXPECT_EQ(commas - 1, columns_of(study).size() - 1) << "one comma is in the problem";
}

TEST(SlideRow, AJamIsTheMeanOfThePushingContacts) {
  SlideRow row{.values = {0.0, 0.0}, .outcome = "jammed"};
  row.measures.p_Wpushed = Eigen::Vector3d(1.0, 2.0, 3.0);
  row.measures.pushed_by = "left, right";
  row.measures.still_since_s = 0.25;
  const Study study = study_of({Record::kJam});
  nlohmann::json json = nlohmann::json::parse(json_of(study, row));
  EXPECT_EQ(json["jam_at_s"], 0.25);
  EXPECT_EQ(json["jam_y_m"], 2.0);
  EXPECT_EQ(json["jam_objects"], "left, right");
  row.measures.goal_reached = true;
  json = nlohmann::json::parse(json_of(study, row));
  EXPECT_TRUE(json["jam_at_s"].is_null()) << "a part in its goal does not jam";
}

TEST(SlideRow, WhatIsNoRowIsRefused) {
  EXPECT_THROW(csv_of("{\"slide\": 1"), std::invalid_argument);
  EXPECT_THROW(csv_of("[1, 2]"), std::invalid_argument);
}

}  // namespace
}  // namespace glissade::study
