/// `glissade study`: the same bytes for any number of processes, also after faults.

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <unistd.h>

#include <glissade/files/text_file.h>

#include "glissade_program.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using files::read_text_file;
using test_support::expect_refused;
using test_support::glissade;
using test_support::ProgramResult;
using testing::HasSubstr;
using testing::Not;

/// Kills one process that has all these arguments; false if there is none.
bool kill_process_with_arguments(const std::vector<std::string>& wanted) {
  for (const auto& process : std::filesystem::directory_iterator("/proc")) {
    std::ifstream file(process.path() / "cmdline", std::ios::binary);
    std::set<std::string> arguments;
    for (std::string argument; std::getline(file, argument, '\0');)
      arguments.insert(argument);
    const auto has = [&](const std::string& argument) { return arguments.contains(argument); };
    if (!std::all_of(wanted.begin(), wanted.end(), has)) continue;
    return kill(std::stoi(process.path().filename().string()), SIGKILL) == 0;
  }
  return false;
}

class StudyCommand : public testing::Test {
 protected:
  StudyCommand() {
    folder.write("scene.yaml",
                 "objects:\n"
                 "  - {name: plate, shape: {type: holed_plate, hole_radius_m: 0.0042}}\n"
                 "  - {name: peg, movable: true, shape: {type: peg}, compliance_point_m: [0, 0, 0]}\n");
    folder.write("path.csv", "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,0.001,1,0,0,0\n0.05,0,0,-0.003,1,0,0,0\n");
    study = write_study("study.yaml", kSlides);
  }

  std::string write_study(const std::string& name, int slides) const {
    return folder.write(name,
                        "scene: scene.yaml\npart: peg\ntrajectory: path.csv\n"
                        "parameters: [{vary: path.x_m, uniform: [-0.002, 0.002]}]\n"
                        "success: {distance_m: 0.003}\nslides: " +
                            std::to_string(slides) + "\n");
  }

  /// Runs the study and gives its table.
  std::string table_of(const std::string& out, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"study", study, "--out", folder.path(out), "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult result = glissade(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.standard_error;
    return std::filesystem::exists(folder.path(out + "/slides.csv")) ? read_text_file(folder.path(out + "/slides.csv"))
                                                                     : "";
  }

  /// Waits until a worker runs a slide, and kills it.
  void kill_a_worker(const std::string& out) const {
    const std::string journal = folder.path(out + "/slides.journal.jsonl");
    while (!std::filesystem::exists(journal) || std::filesystem::file_size(journal) == 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_TRUE(kill_process_with_arguments({"--worker", study}));
  }

  static constexpr int kSlides = 60;
  test_support::TemporaryFolder folder;
  std::string study;
};

TEST_F(StudyCommand, TablesAreTheSameForAnyNumberOfProcessesAndShards) {
  const std::string table = table_of("one", {"--workers", "1"});
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), kSlides + 1);
  EXPECT_EQ(table_of("three", {"--workers", "3"}), table);
  EXPECT_EQ(table_of("shards", {"--shard", "0/2"}), "") << "a shard makes no table";
  EXPECT_EQ(table_of("shards", {"--shard", "1/2"}), "");
  EXPECT_EQ(table_of("shards"), table);
  EXPECT_FALSE(std::filesystem::exists(folder.path("shards/slides.shard-0-of-2.jsonl"))) << "the table has its rows";
}

TEST_F(StudyCommand, ReportsTheShareOfSuccess) {
  const ProgramResult result = glissade({"study", study, "--out", folder.path("out")});
  const nlohmann::json summary = nlohmann::json::parse(read_text_file(folder.path("out/study.json")));
  EXPECT_EQ(summary["slides"], kSlides);
  int successes = 0;
  for (const test_support::CsvRow& row : test_support::rows_of(read_text_file(folder.path("out/slides.csv"))))
    successes += row.at("success") == "1" ? 1 : 0;
  EXPECT_EQ(summary["successes"], successes);
  EXPECT_GT(successes, 0);
  EXPECT_LT(successes, kSlides);
  EXPECT_THAT(result.standard_output, HasSubstr(std::to_string(successes) + " of 60 slides succeed"));
}

TEST_F(StudyCommand, AKilledWorkerChangesNoByte) {
  const std::string table = table_of("whole");
  study = write_study("study.yaml", kSlides);
  std::jthread killer([this] { kill_a_worker("killed"); });
  EXPECT_EQ(table_of("killed", {"--workers", "2"}), table);
}

TEST_F(StudyCommand, AStoppedRunGoesOn) {
  const std::string table = table_of("whole");
  test_support::Process process({GLISSADE_PROGRAM, "study", study, "--out", folder.path("out"), "--workers", "1"});
  const std::string journal = folder.path("out/slides.journal.jsonl");
  while (!std::filesystem::exists(journal) || std::filesystem::file_size(journal) == 0)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  process.signal(SIGKILL);
  process.wait();
  const std::string rows = read_text_file(journal);
  ASSERT_LT(std::count(rows.begin(), rows.end(), '\n'), kSlides);
  // The last row may have been cut off.
  std::ofstream(journal, std::ios::app) << "{\"slide\":59,\"pa";
  const ProgramResult again = glissade({"study", study, "--out", folder.path("out")});
  EXPECT_EQ(again.exit_code, 0) << again.standard_error;
  EXPECT_EQ(read_text_file(folder.path("out/slides.csv")), table);
}

TEST_F(StudyCommand, AFinishedStudyRunsOnlyWhatIsMissing) {
  table_of("out");
  const std::string rows = read_text_file(folder.path("out/slides.jsonl"));
  study = write_study("more.yaml", kSlides + 5);
  // A mark that a new run of slide 0 would not have.
  std::string marked = rows;
  marked.replace(marked.find("\"success\":"), 11, "\"success\":1");
  std::ofstream(folder.path("out/slides.jsonl")) << marked;
  const std::string table = table_of("out");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), kSlides + 6);
  EXPECT_EQ(read_text_file(folder.path("out/slides.jsonl")).substr(0, marked.size()), marked);
}

TEST_F(StudyCommand, FilesOfOthersStay) {
  std::filesystem::create_directory(folder.path("out"));
  folder.write("out/slides_backup.jsonl", "mine");
  // A shard that is being run has locked its journal.
  const std::string shard = folder.write("out/slides.shard-0-of-2.jsonl", "");
  const int other_run = open(shard.c_str(), O_RDONLY);
  ASSERT_EQ(flock(other_run, LOCK_EX), 0);
  table_of("out");
  EXPECT_EQ(read_text_file(folder.path("out/slides_backup.jsonl")), "mine");
  EXPECT_TRUE(std::filesystem::exists(shard));
  expect_refused({"study", study, "--out", folder.path("out"), "--shard", "0/2"}, {"another run is writing"});
  close(other_run);
}

TEST_F(StudyCommand, ALineThatIsNoRowIsToldWithItsPlace) {
  std::filesystem::create_directory(folder.path("out"));
  folder.write("out/slides.jsonl", "{\"slide\": \"x\"}\n");
  expect_refused({"study", study, "--out", folder.path("out")}, {"slides.jsonl:1", "no row"});
}

TEST_F(StudyCommand, APartInMillimetresIsDoubted) {
  folder.write("large.yaml", "objects: [{name: peg, movable: true, shape: {type: box, size_x_m: 16}}]\n");
  folder.write("way.csv", "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,0,1,0,0,0\n0.01,0,0,0,1,0,0,0\n");
  const std::string large = folder.write("large_study.yaml",
                                         "scene: large.yaml\npart: peg\ntrajectory: way.csv\nslides: 1\n"
                                         "parameters: [{vary: path.x_m, one_of: [0]}]\n");
  EXPECT_THAT(glissade({"study", large}).standard_error, HasSubstr("object 'peg' is 16 m across"));
}

TEST_F(StudyCommand, AFileNameMayBeginWithAHyphen) {
  write_study("-study.yaml", 4);
  const ProgramResult result =
      test_support::Process(
          {"sh", "-c", "cd " + folder.path("") + " && exec " GLISSADE_PROGRAM " study --out out -- -study.yaml"})
          .wait();
  EXPECT_THAT(result.standard_output, HasSubstr("of 4 slides succeed"));
  EXPECT_THAT(result.standard_output, Not(HasSubstr("could not be run")));
}

TEST_F(StudyCommand, RowsOfOtherInputsAreRunAgain) {
  const std::string before = table_of("out");
  folder.write("path.csv", "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,0.001,1,0,0,0\n0.05,0,0,-0.002,1,0,0,0\n");
  const ProgramResult result = glissade({"study", study, "--out", folder.path("out")});
  EXPECT_THAT(result.standard_error, HasSubstr("60 rows belong to other inputs"));
  EXPECT_NE(read_text_file(folder.path("out/slides.csv")), before);
  EXPECT_EQ(read_text_file(folder.path("out/slides.csv")), table_of("new"));
}

/// Each worker reads the files of the study again.
TEST_F(StudyCommand, AStudyThatChangesDuringTheRunIsTold) {
  std::jthread changer([this] {
    const std::string journal = folder.path("out/slides.journal.jsonl");
    while (!std::filesystem::exists(journal) || std::filesystem::file_size(journal) == 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    folder.write("path.csv", "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,0.001,1,0,0,0\n0.05,0,0,-0.002,1,0,0,0\n");
    kill_a_worker("out");
  });
  const ProgramResult result = glissade({"study", study, "--out", folder.path("out"), "--quiet", "--workers", "1"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.standard_error, HasSubstr("changed during the run"));
}

TEST_F(StudyCommand, WorkersThatCannotStartEndTheRun) {
  std::jthread changer([this] {
    const std::string journal = folder.path("out/slides.journal.jsonl");
    while (!std::filesystem::exists(journal) || std::filesystem::file_size(journal) == 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    folder.write("path.csv", "no trajectory");
    kill_a_worker("out");
  });
  const ProgramResult result = glissade({"study", study, "--out", folder.path("out"), "--quiet", "--workers", "1"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.standard_error, HasSubstr("cannot start"));
  EXPECT_THAT(result.standard_error, HasSubstr("path.csv:1")) << "the worker says why";
  EXPECT_THAT(read_text_file(folder.path("out/slides.journal.jsonl")), Not(HasSubstr("not run")));
}

TEST_F(StudyCommand, ASlideThatTakesTooLongIsAProblem) {
  folder.write("path.csv", "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,0.001,1,0,0,0\n3600,0,0,-0.003,1,0,0,0\n");
  study = write_study("study.yaml", 2);
  const std::string table = table_of("out", {"--longest-s", "0.5"});
  const std::vector<test_support::CsvRow> rows = test_support::rows_of(table);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].at("outcome"), "not run");
  EXPECT_EQ(rows[0].at("problem"), "the slide did not end within 0.5 s");
  expect_refused({"study", study, "--longest-s", "1e10"}, {"--longest-s"});
}

TEST_F(StudyCommand, APilotMakesTheIntervalOfTheStudyNarrower) {
  table_of("pilot");
  const auto write = [&](const std::string& slides) {
    study = folder.write("stratified.yaml",
                         "scene: scene.yaml\npart: peg\ntrajectory: path.csv\n"
                         "parameters: [{vary: path.x_m, uniform: [-0.002, 0.002]}]\n"
                         "success: {distance_m: 0.003}\nsampling: stratified\npilot: pilot\n" +
                             slides);
  };
  write("slides: 60\n");
  const std::string table = table_of("one", {"--workers", "1"});
  EXPECT_EQ(table_of("three", {"--workers", "3"}), table);
  EXPECT_THAT(table, HasSubstr("slide,path.x_m,stratum,weight,success"));
  expect_refused({"study", study, "--out", folder.path("pilot")}, {"has the pilot of this study", "--out"});
  const auto width_of = [&](const std::string& out) {
    const auto summary = nlohmann::json::parse(read_text_file(folder.path(out + "/study.json")));
    const auto& interval = summary["success_rate_95_percent"];
    EXPECT_LE(interval[0], summary["success_rate"]);
    EXPECT_GE(interval[1], summary["success_rate"]);
    return interval[1].get<double>() - interval[0].get<double>();
  };
  EXPECT_LT(width_of("one"), 0.7 * width_of("pilot")) << "with as many slides";
  write("half_width: 0.03\n");
  table_of("wide");
  EXPECT_NEAR(width_of("wide"), 2.0 * 0.03, 0.02);
}

TEST_F(StudyCommand, ThePageHasTheRowsAndItsNotableSlidesHaveReplays) {
  table_of("out");
  EXPECT_THAT(read_text_file(folder.path("out/index.html")), HasSubstr("id=\"report-study\""));
  const nlohmann::json summary = nlohmann::json::parse(read_text_file(folder.path("out/study.json")));
  for (const auto& slide : summary["greatest_forces"]) {
    const std::string page = read_text_file(folder.path("out/slides/" + slide.dump() + "/index.html"));
    EXPECT_THAT(page, HasSubstr("<title>Slide " + slide.dump() + " of study</title>"));
    EXPECT_THAT(page, HasSubstr("id=\"report-frames\""));
  }
}

TEST_F(StudyCommand, APageIsMadeAgainOnlyForOtherInputs) {
  table_of("out");
  const nlohmann::json summary = nlohmann::json::parse(read_text_file(folder.path("out/study.json")));
  const std::string page = folder.path("out/slides/" + summary["greatest_forces"][0].dump() + "/index.html");
  std::ofstream(page, std::ios::app) << "<!-- mark -->";
  table_of("out");
  EXPECT_THAT(read_text_file(page), HasSubstr("<!-- mark -->"));
  std::ofstream(study, std::ios::app) << "sliding: {stiffness_N_per_m: 2000}\n";
  table_of("out");
  EXPECT_THAT(read_text_file(page), Not(HasSubstr("<!-- mark -->")));
}

TEST_F(StudyCommand, AnImpossibleSlideHasAPageWithoutAReplay) {
  folder.write("path.csv", "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0.006,0,-0.002,1,0,0,0\n0.05,0,0,-0.003,1,0,0,0\n");
  EXPECT_EQ(glissade({"study", study, "--slide", "0", "--report", folder.path("slide")}).exit_code, 0);
  const std::string page = read_text_file(folder.path("slide/index.html"));
  EXPECT_THAT(page, HasSubstr("problem"));
  EXPECT_THAT(page, Not(HasSubstr("id=\"report-frames\"")));
}

TEST_F(StudyCommand, OneSlideIsPrintedAsItsRow) {
  table_of("out");
  const ProgramResult result = glissade({"study", study, "--slide", "7"});
  EXPECT_THAT(read_text_file(folder.path("out/slides.jsonl")), HasSubstr(result.standard_output));
  expect_refused({"study", study, "--slide", "60"}, {"--slide", "0 to 59"});
}

TEST_F(StudyCommand, WrongUsageIsRefused) {
  expect_refused({"study", folder.path("none.yaml")}, {"none.yaml"});
  expect_refused({"study", study, "--shard", "4/4"}, {"--shard", "PART < PARTS"});
  expect_refused({"study", study, "--shard", "x"}, {"--shard", "'x'"});
  expect_refused({"study", study, "--report", folder.path("page")}, {"--report", "--slide"});
  expect_refused({"study", study, "--view", "0", "--shard", "0/2"}, {"--view", "--shard"});
  std::filesystem::create_directories(folder.path("taken/index.html"));
  expect_refused({"study", study, "--out", folder.path("taken")}, {"index.html"});
  expect_refused({"study", study, "--out", study}, {"study.yaml"});
  std::filesystem::create_directories(folder.path("out/slides.journal.jsonl"));
  expect_refused({"study", study, "--out", folder.path("out")}, {"slides.journal.jsonl"});
}

TEST_F(StudyCommand, AFullDiskEndsTheStudyAndKeepsItsRows) {
  const std::string command = " study " + study + " --out " + folder.path("out") + " --quiet";
  const ProgramResult result =
      test_support::Process({"sh", "-c", "ulimit -f 8 && exec " GLISSADE_PROGRAM + command}).wait();
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.standard_error, HasSubstr("could not be written completely"));
  EXPECT_EQ(glissade({"study", study, "--out", folder.path("out")}).exit_code, 0) << "with more space, it goes on";
  EXPECT_EQ(read_text_file(folder.path("out/slides.csv")), table_of("whole"));
}

}  // namespace
}  // namespace glissade::apps
