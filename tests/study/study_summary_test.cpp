/// What rows say together, of rows that are made up.

#include "summary/study_summary.h"

#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study_folder.h"

namespace glissade::study {
namespace {

using nlohmann::json;

class Summary : public testing::Test {
 protected:
  json row(double x, const std::string& metaphor, bool success) {
    return {{"slide", next_slide_++},
            {"path.x_m", x},
            {"metaphor", metaphor},
            {"success", success ? 1 : 0},
            {"outcome", success ? "success" : "jammed"},
            {"problem", nullptr},
            {"force_max_N", 1.0}};
  }
  json jam(double x, double y, const std::string& objects) {
    json jammed = row(0.0, "incremental", false);
    jammed.update({{"jam_objects", objects}, {"jam_x_m", x}, {"jam_y_m", y}, {"jam_z_m", 0.0}});
    return jammed;
  }

  const StudyFolder folder;
  const Study study = folder.read(
      "parameters:\n"
      "  - {vary: path.x_m, uniform: [0, 1]}\n"
      "  - {vary: metaphor, one_of: [incremental, rubber-band]}\n"
      "slides: 100\n");
  StudySummary summary{study};

 private:
  int next_slide_ = 0;
};

/// Success is x < 0.4, whatever the metaphor.
TEST_F(Summary, TheParameterThatDecidesComesFirst) {
  for (int i = 0; i < 100; ++i)
    summary.add(row(0.01 * i, i % 2 == 0 ? "incremental" : "rubber-band", i < 40));
  const auto parameters = summary.to_json()["parameters"];
  EXPECT_EQ(parameters[0]["name"], "path.x_m");
  EXPECT_DOUBLE_EQ(parameters[0]["share_of_variance"], 1.0);
  EXPECT_EQ(parameters[0]["bins"].size(), 5U);
  EXPECT_EQ(parameters[0]["bins"][1]["success_rate"], 1.0);
  EXPECT_EQ(parameters[0]["bins"][2]["success_rate"], 0.0);
  EXPECT_EQ(parameters[0]["bins"][2]["values"], "0.4 to 0.59");
  EXPECT_EQ(parameters[1]["name"], "metaphor");
  EXPECT_NEAR(parameters[1]["share_of_variance"], 0.0, 1e-12);
  EXPECT_EQ(parameters[1]["bins"][0]["values"], "incremental");
  EXPECT_EQ(parameters[1]["bins"][1]["slides"], 50);
}

TEST_F(Summary, EqualValuesAreInOneBin) {
  for (int i = 0; i < 100; ++i)
    summary.add(row(i < 90 ? 0.0 : 1.0, "incremental", i < 90));
  const auto parameters = summary.to_json()["parameters"];
  ASSERT_EQ(parameters[0]["bins"].size(), 2U);
  EXPECT_EQ(parameters[0]["bins"][0]["slides"], 90);
  EXPECT_EQ(parameters[0]["bins"][1]["success_rate"], 0.0);
}

TEST_F(Summary, WithoutFailureNothingIsExplained) {
  summary.add(row(0.0, "incremental", true));
  summary.add(row(1.0, "incremental", true));
  EXPECT_EQ(summary.to_json()["parameters"][0]["share_of_variance"], 0.0);
  EXPECT_EQ(summary.to_json()["success_rate"], 1.0);
}

TEST_F(Summary, JamsAtOnePlaceAreCountedTogether) {
  for (int i = 0; i < 5; ++i)
    summary.add(jam(0.001 * i, 0.0, "left"));
  summary.add(jam(0.0, 0.0, "left, front"));
  summary.add(jam(0.0, 0.05, "left"));
  const auto jams = summary.to_json()["jams"];
  ASSERT_EQ(jams.size(), 3U) << "the peg is 0.2 m long, so places are 10 mm wide";
  EXPECT_EQ(jams[0]["objects"], "left");
  EXPECT_EQ(jams[0]["slides"], 5);
  EXPECT_NEAR(jams[0]["mean_m"][0], 0.002, 1e-12);
  EXPECT_EQ(jams[1]["first_slide"], 5);
}

TEST_F(Summary, EachKindOfFailureHasAFirstSlide) {
  const auto add = [&](const std::string& outcome, const json& problem) {
    json one = row(0.0, "incremental", outcome == "success");
    one.update({{"outcome", outcome}, {"problem", problem}});
    summary.add(one);
  };
  for (const char* outcome : {"success", "jammed", "too near", "jammed", "success"})
    add(outcome, nullptr);
  add("not run", "its process was killed");
  EXPECT_THAT(summary.first_failures(), testing::UnorderedElementsAre(1, 2));
}

TEST_F(Summary, TheGreatestForcesComeFirst) {
  for (int i = 0; i < 15; ++i) {
    json one = row(0.0, "incremental", true);
    one["force_max_N"] = i == 3 ? json() : json(i % 7);
    summary.add(one);
  }
  const auto worst = summary.to_json()["greatest_forces"];
  ASSERT_EQ(worst.size(), 10U);
  EXPECT_EQ(worst[0], 6);
  EXPECT_EQ(worst[1], 13);
  EXPECT_EQ(worst[2], 5);
}

TEST_F(Summary, SlidesMayBeMissing) {
  EXPECT_TRUE(summary.to_json()["success_rate"].is_null()) << "no slide is there yet";
  json first = row(0.0, "incremental", true);
  first["slide"] = 40;
  summary.add(first);
  json second = row(1.0, "incremental", false);
  second.update({{"slide", 70}, {"force_max_N", 9.0}});
  summary.add(second);
  EXPECT_EQ(summary.to_json()["greatest_forces"], nlohmann::ordered_json({70, 40}));
  EXPECT_EQ(summary.to_json()["success_rate"], 0.5);
}

/// Two strata, of which the smaller one has most slides.
TEST_F(Summary, SlidesOfStrataHaveTheirWeights) {
  std::vector<Stratum> two(2, {{0.0, 0.0}, {1.0, 1.0}, 0.2, 10, 5});
  two[1].weight = 0.8;
  two[1].pilot_successes = 0;
  Study stratified = study;
  stratified.strata = std::make_shared<const Strata>(two, 100, 1);
  StudySummary of_strata(stratified);
  EXPECT_FALSE(of_strata.rate().has_value());
  int in_first = 0;
  for (int i = 0; i < 100; ++i) {
    const bool is_first = stratified.strata->index_of(i) == 0;
    in_first += is_first ? 1 : 0;
    of_strata.add(row(is_first ? 0.0 : 1.0, "incremental", is_first));
  }
  EXPECT_GT(in_first, 28);
  const auto numbers = of_strata.to_json();
  EXPECT_DOUBLE_EQ(numbers["success_rate"], 0.2);
  EXPECT_EQ(numbers["successes"], in_first);
  EXPECT_EQ(numbers["strata"], 2);
  EXPECT_NEAR(numbers["parameters"][0]["share_of_variance"], 1.0, 1e-9);
}

TEST_F(Summary, CountsOutcomesAndProblems) {
  json problem = row(0.0, "incremental", false);
  problem["outcome"] = "problem";
  problem["problem"] = "it starts in a wall";
  summary.add(problem);
  summary.add(row(0.0, "incremental", true));
  const auto numbers = summary.to_json();
  EXPECT_EQ(numbers["problems"], 1);
  EXPECT_EQ(numbers["outcomes"]["problem"], 1);
  EXPECT_EQ(numbers["outcomes"]["success"], 1);
  EXPECT_EQ(summary.successes(), 1);
}

}  // namespace
}  // namespace glissade::study
