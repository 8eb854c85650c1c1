/// `glissade run` and `glissade glove` as two processes over UDP multicast, in a network namespace of their own.

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <future>
#include <iterator>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "glissade_program.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

std::string write_key(const test_support::TemporaryFolder& folder, const std::string& name, char digit) {
  const std::string path = folder.write(name, std::string(64, digit) + '\n');
  std::filesystem::permissions(path, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  return path;
}

/// Waits until the program has said this; false after twenty seconds.
bool says(const test_support::Process& program, const std::string& text) {
  for (int i = 0; i < 2000; ++i) {
    if (program.standard_error().find(text) != std::string::npos) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

std::string write_box_on_plate(const test_support::TemporaryFolder& folder) {
  return folder.write("scene.yaml",
                      "objects:\n"
                      "  - {name: plate, shape: {type: plate}}\n"
                      "  - {name: box, movable: true, shape: {type: box}, pose: {position_m: [0, 0, 2]}}\n");
}

TEST(TwoProcesses, AGloveInOneProcessCarriesThePartInTheOtherToItsSeat) {
  ASSERT_NE(std::getenv("GLISSADE_NETWORK_NAMESPACE"), nullptr) << "would send outside of this test";
  const test_support::TemporaryFolder folder;
  const std::string scene = folder.write("scene.yaml",
                                         "objects:\n"
                                         "  - {name: plate, shape: {type: plate, size_x_m: 0.5, size_y_m: 0.5}}\n"
                                         "  - name: box\n"
                                         "    movable: true\n"
                                         "    shape: {type: box, size_x_m: 0.1, size_y_m: 0.06, size_z_m: 0.04}\n"
                                         "    pose: {position_m: [0, 0, 0.03]}\n"
                                         "goal: {position_m: [0.05, 0, 0.02]}\n");
  const std::string script = folder.write("hand.csv",
                                          "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n"
                                          "0,0,0,0.03,1,0,0,0\n"
                                          "0.5,0,0,0.01,1,0,0,0\n"
                                          "1.5,0.05,0,0.01,1,0,0,0\n"
                                          "4,0.05,0,0.01,1,0,0,0\n");
  // The glove waits for the server, so the order does not matter; the server ends first, while the hand still presses.
  const std::string key = write_key(folder, "key", 'a');
  auto glove = std::async(std::launch::async, [&] {
    return test_support::glissade({"glove", "--lcm", test_support::kUrl, "--script", script, "--key-file", key});
  });
  const test_support::ProgramResult server = test_support::glissade(
      {"run", scene, "--lcm", test_support::kUrl, "--seconds", "3", "--json", "--key-file", key});
  const test_support::ProgramResult hand = glove.get();

  ASSERT_EQ(server.exit_code, 0) << server.standard_error;
  ASSERT_EQ(hand.exit_code, 0) << hand.standard_error;
  const nlohmann::json summary = nlohmann::json::parse(server.standard_output);
  EXPECT_EQ(summary["ticks"], 3000);
  EXPECT_EQ(summary["colliding_poses"], 0);
  EXPECT_EQ(summary["goal_reached"], true);
  EXPECT_GT(summary["parts"][0]["contact_fraction"], 0.3);
  EXPECT_GT(summary["hands"][0]["force_max_N"], 1.0);
  EXPECT_NE(hand.standard_output.find(" 0 refused)"), std::string::npos) << hand.standard_output;
  EXPECT_EQ(hand.standard_output.find("greatest force 0 N"), std::string::npos) << hand.standard_output;
}

TEST(TwoProcesses, AServerThatABrowserMayWatchWritesAReportToo) {
  ASSERT_NE(std::getenv("GLISSADE_NETWORK_NAMESPACE"), nullptr) << "would send outside of this test";
  const test_support::TemporaryFolder folder;
  const std::string scene = folder.write("scene.yaml",
                                         "objects:\n"
                                         "  - {name: plate, shape: {type: plate}}\n"
                                         "  - {name: box, movable: true, shape: {type: box}, pose: {position_m: [0, 0, "
                                         "1]}}\n");
  const test_support::Process glove({GLISSADE_PROGRAM, "glove", "--lcm", test_support::kUrl});
  const test_support::ProgramResult server =
      test_support::glissade({"run", scene, "--lcm", test_support::kUrl, "--seconds", "0.3", "--view", "0", "--report",
                              folder.path("report")});
  ASSERT_EQ(server.exit_code, 0) << server.standard_error;
  EXPECT_NE(server.standard_error.find("http://127.0.0.1:"), std::string::npos) << server.standard_error;
  EXPECT_NE(server.standard_output.find(folder.path("report/index.html")), std::string::npos) << server.standard_output;
  std::ifstream page(folder.path("report/index.html"));
  const std::string html{std::istreambuf_iterator<char>(page), {}};
  for (const char* part : {"id=\"report-frames\"", "\"title\":\"Force on the hand of glove 1\""})
    EXPECT_NE(html.find(part), std::string::npos) << part;
}

/// A hand that goes straight to another place in half a second and stays.
std::string write_way(const test_support::TemporaryFolder& folder, const std::string& name, const std::string& from,
                      const std::string& to) {
  return folder.write(
      name, "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0," + from + ",1,0,0,0\n0.5," + to + ",1,0,0,0\n6," + to + ",1,0,0,0\n");
}

TEST(ThreeProcesses, TwoGlovesPressTheirPartsTogether) {
  ASSERT_NE(std::getenv("GLISSADE_NETWORK_NAMESPACE"), nullptr) << "would send outside of this test";
  const test_support::TemporaryFolder folder;
  const auto cube = [](const std::string& name, const std::string& x) {
    return "  - {name: " + name +
           ", movable: true, shape: {type: box, size_x_m: 0.04, size_y_m: 0.04, size_z_m: 0.04}, " +
           "pose: {position_m: [" + x + ", 0, 0]}}\n";
  };
  const std::string scene = folder.write("scene.yaml", "objects:\n" + cube("left", "-0.03") + cube("right", "0.03"));
  const test_support::Process first({GLISSADE_PROGRAM, "glove", "--lcm", test_support::kUrl, "--device", "1",
                                     "--script", write_way(folder, "a.csv", "-0.03,0,0", "-0.01,0,0")});
  const test_support::Process second({GLISSADE_PROGRAM, "glove", "--lcm", test_support::kUrl, "--device", "2", "--side",
                                      "left", "--script", write_way(folder, "b.csv", "0.03,0,0", "0.01,0,0")});
  const test_support::ProgramResult server = test_support::glissade(
      {"run", scene, "--lcm", test_support::kUrl, "--device", "1", "2", "--seconds", "3", "--json"});
  ASSERT_EQ(server.exit_code, 0) << server.standard_error;
  EXPECT_NE(server.standard_error.find("glove 1 holds 'left', glove 2 holds 'right'"), std::string::npos)
      << server.standard_error;
  const nlohmann::json summary = nlohmann::json::parse(server.standard_output);
  EXPECT_EQ(summary["colliding_poses"], 0);
  ASSERT_EQ(summary["hands"].size(), 2U);
  for (const nlohmann::json& hand : summary["hands"])
    EXPECT_GT(hand["force_max_N"], 1.5) << hand["device"];
}

/// The first hand brings a cube and opens 0.3 s after the second has closed; the second carries it on, and opens too.
TEST(ThreeProcesses, OneGlovePassesAPartToTheOther) {
  ASSERT_NE(std::getenv("GLISSADE_NETWORK_NAMESPACE"), nullptr) << "would send outside of this test";
  const test_support::TemporaryFolder folder;
  const std::string scene = folder.write(
      "scene.yaml",
      "objects:\n"
      "  - {name: plate, shape: {type: plate, size_x_m: 0.5, size_y_m: 0.5}, pose: {position_m: [0, 0, -0.05]}}\n"
      "  - {name: cube, movable: true, shape: {type: box, size_x_m: 0.04, size_y_m: 0.04, size_z_m: 0.04}}\n"
      "goal: {position_m: [0.15, 0, 0]}\n");
  const std::string header = "t_s,x_m,y_m,z_m,qw,qx,qy,qz,grip\n";
  const std::string giver = folder.write("giver.csv", header +
                                                          "0,0,0.03,0,1,0,0,0,1\n"
                                                          "1,0.1,0.03,0,1,0,0,0,1\n"
                                                          "1.8,0.1,0.03,0,1,0,0,0,0\n"
                                                          "2.3,0,0.1,0,1,0,0,0,0\n"
                                                          "8,0,0.1,0,1,0,0,0,0\n");
  const std::string taker = folder.write("taker.csv", header +
                                                          "0,0.1,-0.03,0,1,0,0,0,0\n"
                                                          "1.5,0.1,-0.03,0,1,0,0,0,1\n"
                                                          "2.3,0.1,-0.03,0,1,0,0,0,1\n"
                                                          "3,0.15,-0.03,0,1,0,0,0,1\n"
                                                          "3.5,0.15,-0.03,0,1,0,0,0,0\n"
                                                          "4,0.15,-0.1,0,1,0,0,0,0\n"
                                                          "8,0.15,-0.1,0,1,0,0,0,0\n");
  const test_support::Process first(
      {GLISSADE_PROGRAM, "glove", "--lcm", test_support::kUrl, "--device", "1", "--script", giver});
  const test_support::Process second(
      {GLISSADE_PROGRAM, "glove", "--lcm", test_support::kUrl, "--device", "2", "--script", taker});
  const test_support::ProgramResult server = test_support::glissade(
      {"run", scene, "--lcm", test_support::kUrl, "--device", "1", "2", "--seconds", "5", "--json"});
  ASSERT_EQ(server.exit_code, 0) << server.standard_error;
  const nlohmann::json summary = nlohmann::json::parse(server.standard_output);
  EXPECT_EQ(summary["colliding_poses"], 0);
  EXPECT_EQ(summary["goal_reached"], true) << summary.dump(1);
  EXPECT_GT(summary["parts"][0]["state_s"]["released"], 0.5) << "it lies still at the end";
}

TEST(TwoProcesses, TheRecordOfAGloveHasNoAgeBeforeTheFirstCommand) {
  ASSERT_NE(std::getenv("GLISSADE_NETWORK_NAMESPACE"), nullptr) << "would send outside of this test";
  const test_support::TemporaryFolder folder;
  test_support::Process glove(
      {GLISSADE_PROGRAM, "glove", "--lcm", test_support::kUrl, "--record", folder.path("hand.csv")});
  while (!std::filesystem::exists(folder.path("hand.csv")))
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  std::this_thread::sleep_for(std::chrono::milliseconds(100));  // some periods
  glove.signal(SIGINT);
  ASSERT_EQ(glove.wait().exit_code, 0);
  std::ifstream record(folder.path("hand.csv"));
  std::string row;
  std::getline(record, row);
  std::getline(record, row);
  EXPECT_TRUE(row.ends_with(",0,0,0,0,0,0,,")) << row;
}

TEST(OneProcess, RecordsAreNoPipesAndReplaceNoFile) {
  ASSERT_NE(std::getenv("GLISSADE_NETWORK_NAMESPACE"), nullptr) << "would send outside of this test";
  const test_support::TemporaryFolder folder;
  const std::string pipe = folder.path("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const std::string older = folder.write("older", "of an earlier run");
  const std::string scene = write_box_on_plate(folder);
  const std::string url = test_support::kUrl;
  test_support::expect_refused({"glove", "--lcm", url, "--record", pipe}, {"pipe: is a pipe"});
  test_support::expect_refused({"glove", "--lcm", url, "--record", older}, {"older: is there already", "--overwrite"});
  test_support::expect_refused({"record", pipe, scene, "--lcm", url}, {"pipe: is a pipe"});
  test_support::expect_refused({"record", older, scene, "--lcm", url}, {"older: is there already", "--overwrite"});
  test_support::expect_refused({"run", scene, "--lcm", url, "--flight-recorder", pipe}, {"pipe: is a pipe"});
  test_support::expect_refused({"run", scene, "--lcm", url, "--key-file", pipe}, {"pipe: is not a regular file"});
  test_support::expect_refused({"replay", pipe, "--lcm", url}, {"pipe: is not a regular file"});
}

TEST(TwoProcesses, AServerWithAnotherKeySaysThatItRefuses) {
  ASSERT_NE(std::getenv("GLISSADE_NETWORK_NAMESPACE"), nullptr) << "would send outside of this test";
  const test_support::TemporaryFolder folder;
  const std::string scene = folder.write("scene.yaml",
                                         "objects:\n"
                                         "  - {name: plate, shape: {type: plate}}\n"
                                         "  - {name: box, movable: true, shape: {type: box}, pose: {position_m: [0, 0, "
                                         "1]}}\n");
  const test_support::Process glove(
      {GLISSADE_PROGRAM, "glove", "--lcm", test_support::kUrl, "--key-file", write_key(folder, "a", 'a')});
  test_support::Process server(
      {GLISSADE_PROGRAM, "run", scene, "--lcm", test_support::kUrl, "--key-file", write_key(folder, "b", 'b')});
  for (int i = 0; i < 2000 && server.standard_error().find("refused") == std::string::npos; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  server.signal(SIGINT);
  const test_support::ProgramResult result = server.wait();
  EXPECT_EQ(result.exit_code, 0) << result.standard_error;
  EXPECT_NE(result.standard_error.find("have another key"), std::string::npos) << result.standard_error;
}

TEST(TwoProcesses, WaitingServerListsOtherGloves) {
  ASSERT_NE(std::getenv("GLISSADE_NETWORK_NAMESPACE"), nullptr) << "would send outside of this test";
  const test_support::TemporaryFolder folder;
  const test_support::Process glove({GLISSADE_PROGRAM, "glove", "--lcm", test_support::kUrl});
  const test_support::Process server(
      {GLISSADE_PROGRAM, "run", write_box_on_plate(folder), "--lcm", test_support::kUrl, "--device", "7"});
  EXPECT_TRUE(says(server, "glove 7 is silent, but there are other gloves (--device): 1\n")) << server.standard_error();
}

TEST(ThreeProcesses, SecondGloveWithTheSameNumberIsReported) {
  ASSERT_NE(std::getenv("GLISSADE_NETWORK_NAMESPACE"), nullptr) << "would send outside of this test";
  const test_support::TemporaryFolder folder;
  const test_support::Process first({GLISSADE_PROGRAM, "glove", "--lcm", test_support::kUrl});
  const test_support::Process server(
      {GLISSADE_PROGRAM, "run", write_box_on_plate(folder), "--lcm", test_support::kUrl});
  EXPECT_TRUE(says(server, "holds 'box'"));
  const test_support::Process second({GLISSADE_PROGRAM, "glove", "--lcm", test_support::kUrl});
  EXPECT_TRUE(says(server, "a second glove sends as glove 1, and is not heard")) << server.standard_error();
  EXPECT_TRUE(says(second, "another glove sends as glove 1, ")) << second.standard_error();
}

TEST(TwoProcesses, TakenViewPortIsReportedBeforeWaitingForGloves) {
  ASSERT_NE(std::getenv("GLISSADE_NETWORK_NAMESPACE"), nullptr) << "would send outside of this test";
  const test_support::TemporaryFolder folder;
  const test_support::Process viewer({GLISSADE_PROGRAM, "view", "--lcm", test_support::kUrl, "--port", "8499"});
  ASSERT_TRUE(says(viewer, "http://127.0.0.1:8499/"));
  test_support::expect_refused({"run", write_box_on_plate(folder), "--lcm", test_support::kUrl, "--view", "8499"},
                               {"--view: port 8499", "--view 0"});
  test_support::expect_refused({"view", "--lcm", test_support::kUrl, "--port", "8499"},
                               {"--port: port 8499", "--port 0"});
}

TEST(TwoProcesses, AServerThatCannotStartSaysNothingOfWaiting) {
  ASSERT_NE(std::getenv("GLISSADE_NETWORK_NAMESPACE"), nullptr) << "would send outside of this test";
  const test_support::TemporaryFolder folder;
  const std::string scene = folder.write("stuck.yaml",
                                         "objects:\n"
                                         "  - {name: plate, shape: {type: plate}}\n"
                                         "  - {name: box, movable: true, shape: {type: box}}\n");
  test_support::expect_refused({"run", scene, "--lcm", test_support::kUrl},
                               {"stuck.yaml", "'box' collides", "mm deep in 'plate'", "--depenetrate"});
}

}  // namespace
}  // namespace glissade::apps
