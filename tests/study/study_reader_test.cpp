/// Study files: what is read, and how deviations are told.

#include <filesystem>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/study/study.h>

#include "study_folder.h"

namespace glissade::study {
namespace {

using testing::HasSubstr;

TEST(StudyReader, ReadsEveryKey) {
  const StudyFolder folder;
  const Study study = folder.read(
      "parameters:\n"
      "  - {name: play, vary: [peg.size_x_m, peg.size_y_m], triangular: [0.0079, 0.008, 0.0081]}\n"
      "  - {vary: path.x_m, normal: [0, 0.001], within: [-0.002, 0.001]}\n"
      "  - {vary: metaphor, one_of: [incremental, rubber-band]}\n"
      "  - {vary: friction, one_of: [0, 0.25]}\n"
      "sampling: latin-hypercube\n"
      "slides: 50\n"
      "seed: 7\n"
      "success: {distance_m: 0.001, angle_deg: 3, force_N: 20, torque_Nm: 2, clearance_m: 0}\n"
      "sliding: {metaphor: rubber-band, stiffness_N_per_m: 2000, friction: 0.1, spiral_search: true, depenetrate: "
      "true}\n"
      "record: [forces, jam]\n");
  EXPECT_EQ(study.part, "peg");
  EXPECT_EQ(study.slides, 50);
  EXPECT_EQ(study.seed, 7U);
  EXPECT_EQ(study.sampling, Sampling::kLatinHypercube);
  ASSERT_EQ(study.parameters.size(), 4U);
  EXPECT_EQ(study.parameters[0].name, "play");
  EXPECT_EQ(study.parameters[0].targets.size(), 2U);
  EXPECT_EQ(study.parameters[0].targets[1].shape_parameter, "size_y_m");
  EXPECT_EQ(study.parameters[1].name, "path.x_m");
  EXPECT_EQ(study.parameters[1].distribution.bounds().least, -0.002);
  EXPECT_TRUE(study.parameters[2].distribution.as_one_of()->numbers.empty());
  EXPECT_THAT(study.parameters[3].distribution.as_one_of()->numbers, testing::ElementsAre(0.0, 0.25));
  EXPECT_EQ(study.success.force_N, 20.0);
  EXPECT_EQ(study.metaphor, contact::Metaphor::kRubberBand);
  EXPECT_EQ(study.rules.friction.at_rest, 0.1);
  EXPECT_TRUE(study.rules.spiral_search);
  EXPECT_TRUE(study.has(Record::kJam));
  EXPECT_FALSE(study.has(Record::kClearance));
}

TEST(StudyReader, DefaultsAreThoseOfTheAssemblyCheck) {
  const StudyFolder folder;
  const Study study = folder.read("parameters: [{vary: path.x_m, uniform: [0, 1]}]\nslides: 3\n");
  EXPECT_EQ(study.sampling, Sampling::kSobol);
  EXPECT_EQ(study.success.distance_m, 0.3e-3);
  EXPECT_EQ(study.success.angle_deg, 0.5);
  EXPECT_TRUE(study.has(Record::kClearance));
}

TEST(StudyReader, SlidesOfAGridAreTheProductOfItsSteps) {
  const StudyFolder folder;
  const Study study = folder.read(
      "parameters: [{vary: path.x_m, uniform: [0, 1], steps: 5}, {vary: metaphor, one_of: [incremental, "
      "rubber-band]}]\n"
      "sampling: grid\n");
  EXPECT_EQ(study.slides, 10);
}

struct Wrong {
  const char* lines;
  int line;  // the first three lines are scene, part and trajectory
  const char* message;
};

TEST(StudyReader, DeviationsAreToldWithTheirLine) {
  const StudyFolder folder;
  const std::vector<Wrong> cases{
      {"parameters: [{vary: path.x_m, uniform: [0, 1]}]\nslide: 3\n", 5, "slide"},
      {"parameters: [{vary: path.x, uniform: [0, 1]}]\nslides: 3\n", 4, "x_m"},
      {"parameters: [{vary: pegg.x_m, uniform: [0, 1]}]\nslides: 3\n", 4, "peg"},
      {"parameters: [{vary: peg.size_q_m, uniform: [0, 1]}]\nslides: 3\n", 4, "size_x_m"},
      {"parameters: [{vary: peg.x_m, uniform: [0, 1]}]\nslides: 3\n", 4, "no 'x_m'"},
      {"parameters:\n  - {vary: path.x_m, uniform: [1, 0]}\nslides: 3\n", 5, "below"},
      {"parameters:\n  - {vary: path.x_m}\nslides: 3\n", 5, "exactly one"},
      {"parameters:\n  - {vary: path.x_m, uniform: [0, 1], normal: [0, 1]}\nslides: 3\n", 5, "exactly one"},
      {"parameters:\n  - {vary: path.x_m, uniform: [0, 1], within: [0, 1]}\nslides: 3\n", 5, "'normal'"},
      {"parameters:\n  - {vary: path.x_m, normal: [0, 1], within: [50, 60]}\nslides: 3\n", 5, "hardly any"},
      {"parameters:\n  - {vary: friction, normal: [0.2, 0.1]}\nslides: 3\n", 5, "negative"},
      {"parameters:\n  - {vary: peg.scale, uniform: [0, 1]}\nslides: 3\n", 5, "positive"},
      {"parameters:\n  - {vary: metaphor, uniform: [0, 1]}\nslides: 3\n", 5, "one_of"},
      {"parameters:\n  - {vary: metaphor, one_of: [rubber]}\nslides: 3\n", 5, "rubber-band"},
      {"parameters:\n  - {vary: path.x_m, one_of: [a]}\nslides: 3\n", 5, "numbers"},
      {"parameters:\n  - {vary: trajectory, one_of: [path.csv]}\nslides: 3\n", 3, "values name the files"},
      {"parameters:\n  - {vary: path.x_m, uniform: [0, 1]}\n  - {vary: path.x_m, one_of: [1]}\nslides: 3\n", 6,
       "twice"},
      {"parameters:\n  - {vary: path.x_m, uniform: [-1e308, 1e308]}\nslides: 3\n", 5, "1e9"},
      {"parameters:\n  - {name: outcome, vary: path.x_m, uniform: [0, 1]}\nslides: 3\n", 5, "another column"},
      {"parameters:\n  - {vary: path.x_m, uniform: [0, 1]}\nslides: 2.5\n", 6, "whole number"},
      {"parameters:\n  - {vary: path.x_m, uniform: [0, 1]}\nsampling: grid\n", 5, "steps"},
      {"parameters:\n  - {vary: path.x_m, uniform: [0, 1], steps: 3}\nslides: 3\n", 5, "grid"},
      {"parameters:\n  - {vary: path.x_m, uniform: [0, 1], steps: 3}\nsampling: grid\nslides: 3\n", 7, "as many"},
      {"parameters:\n  - {vary: path.x_m, uniform: [0, 1]}\nsampling: sobel\nslides: 3\n", 6, "did you mean 'sobol'"},
      {"parameters:\n  - {vary: path.x_m, uniform: [0, 1]}\nslides: 3\nsuccess: {force: 3}\n", 7, "force"},
      {"parameters:\n  - {vary: path.x_m, uniform: [0, 1]}\nslides: 3\nsuccess: {clearance_m: 1}\nrecord: [jam]\n", 8,
       "clearance"},
  };
  for (const Wrong& wrong : cases) {
    const std::string path = folder.write(wrong.lines);
    try {
      read_study(path);
      ADD_FAILURE() << wrong.lines;
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), testing::StartsWith(path + ":" + std::to_string(wrong.line) + ": ")) << wrong.lines;
      EXPECT_THAT(error.what(), HasSubstr(wrong.message)) << wrong.lines;
    }
  }
}

TEST(StudyReader, APilotGivesTheStrata) {
  const StudyFolder folder;
  std::string rows;
  for (int i = 0; i < 40; ++i) {
    rows += "{\"slide\":" + std::to_string(i) + ",\"path.x_m\":" + std::to_string(0.0001 * i) +
            ",\"metaphor\":\"rubber-band\",\"success\":" + (i < 10 ? "1" : "0") + ",\"outcome\":\"" +
            (i == 39 ? "not run" : "success") + "\"}\n";
  }
  std::filesystem::create_directories(folder.folder().path("pilot"));
  folder.folder().write("pilot/slides.jsonl", rows);
  const std::string parameters =
      "sampling: stratified\npilot: pilot\nparameters:\n"
      "  - {vary: path.x_m, uniform: [0, 0.004]}\n"
      "  - {vary: metaphor, one_of: [incremental, rubber-band]}\n";
  const Study study = folder.read(parameters + "slides: 100\n");
  ASSERT_EQ(study.strata->all().size(), 3U) << "a quarter with success, a quarter and a half without";
  EXPECT_DOUBLE_EQ(study.strata->all()[0].upper[0], 0.25);
  EXPECT_EQ(study.slides, 100);
  const double wide = static_cast<double>(folder.read(parameters + "half_width: 0.02\n").slides);
  EXPECT_GT(static_cast<double>(folder.read(parameters + "half_width: 0.005\n").slides), 2.0 * wide);

  const auto refusal = [&](const std::string& lines) -> std::string {
    try {
      folder.read(lines);
      return "";
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  };
  EXPECT_THAT(refusal(parameters), HasSubstr("either 'slides' or 'half_width'"));
  EXPECT_EQ(folder.read(parameters + "slides: 12\n").strata->all().size(), 1U) << "few slides, few strata";
  EXPECT_THAT(refusal(parameters + "slides: 1\n"), HasSubstr("from 2 to"));
  EXPECT_THAT(refusal(parameters + "half_width: 0.7\n"), HasSubstr("not '0.7'"));
  const std::string friction = "slides: 9\nparameters: [{vary: friction, uniform: [0, 1]}]\n";
  EXPECT_THAT(refusal("sampling: stratified\n" + friction), HasSubstr("'pilot'"));
  EXPECT_THAT(refusal("pilot: pilot\n" + friction), HasSubstr("study.yaml:4: pilot: is for 'sampling: stratified'"));
  EXPECT_THAT(refusal("sampling: stratified\npilot: pilot\n" + friction),
              HasSubstr("slides.jsonl:1: has no value of the parameter 'friction'"));
  const std::string narrow =
      "sampling: stratified\npilot: pilot\nslides: 9\nparameters: [{vary: path.x_m, uniform: [0, 0.001]}]\n";
  EXPECT_THAT(refusal(narrow), HasSubstr("slides.jsonl:12: 'path.x_m': 0.0011 cannot occur in this study"));
  folder.folder().write("pilot/slides.jsonl", "{\"path.x_m\":0,\"outcome\":\"success\",\"success\":true}\n");
  EXPECT_THAT(refusal(narrow), HasSubstr("slides.jsonl:1: 'success' must be 0 or 1"));
  EXPECT_THAT(refusal("sampling: stratified\npilot: none\n" + friction),
              HasSubstr("none/slides.jsonl: cannot be read"));
}

TEST(StudyReader, MissingFilesAndPartsAreTold) {
  const StudyFolder folder;
  const auto refusal = [&](const std::string& text) {
    try {
      read_study(folder.folder().write("wrong.yaml", text));
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("read");
  };
  const std::string rest = "parameters: [{vary: path.x_m, uniform: [0, 1]}]\nslides: 3\n";
  EXPECT_THAT(refusal("scene: none.yaml\npart: peg\ntrajectory: path.csv\n" + rest), HasSubstr("none.yaml"));
  EXPECT_THAT(refusal("scene: scene.yaml\npart: pog\ntrajectory: path.csv\n" + rest), HasSubstr("wrong.yaml:2"));
  EXPECT_THAT(refusal("scene: scene.yaml\npart: left\ntrajectory: path.csv\n" + rest), HasSubstr("not movable"));
  EXPECT_THAT(refusal("scene: scene.yaml\npart: peg\ntrajectory: none.csv\n" + rest), HasSubstr("none.csv"));
  EXPECT_THAT(refusal("scene: scene.yaml\npart: peg\n" + rest), HasSubstr("trajectory"));
}

}  // namespace
}  // namespace glissade::study
