/// What the program reads and writes: one rule for all commands, whatever links lead to a file.

#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <glissade/apps/text.h>
#include <glissade/devices/event_log.h>
#include <glissade/files/text_file.h>

#include "glissade_program.h"
#include "pressing_scene.h"
#include "temporary_folder.h"
#include "tetrahedron_file.h"

namespace glissade::apps {
namespace {

using test_support::expect_refused;
using test_support::glissade;
using test_support::kTetrahedronObj;
using test_support::ProgramResult;
using Arguments = std::vector<std::string>;

/// A demonstration of it misses no goal, however brief it is.
std::string write_scene_without_goal(const test_support::TemporaryFolder& folder) {
  std::string text = read_text_file(test_support::write_pressing_scene(folder));
  text.erase(text.find("goal:"));
  return folder.write("scene.yaml", text);
}

class FileChecks : public testing::Test {
 protected:
  FileChecks() {
    devices::EventLogWriter writer(log);
    writer.write(devices::to_event(std::chrono::seconds(1), devices::HapticState{.part_count = 1}));
    writer.close();
    std::filesystem::create_symlink(loop, loop);
    EXPECT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  }

  Arguments demo(const Arguments& more) const {
    Arguments all{"demo", "--offline", "--seconds", "0.02", "--scene", scene};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Arguments slide(const Arguments& more) const {
    Arguments all{"slide", scene, "--part", "box", "--trajectory", way};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  test_support::TemporaryFolder folder;
  const std::string scene = write_scene_without_goal(folder);
  const std::string mesh = folder.write("a.obj", kTetrahedronObj);
  const std::string way =
      folder.write("way.csv", "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,0.1,1,0,0,0\n0.01,0,0,0.1,1,0,0,0\n");
  const std::string hand = folder.write("fingers.csv", read_text_file(GLISSADE_SCENES "/ball_and_tray_hand.csv"));
  const std::string tray = GLISSADE_SCENES "/ball_and_tray.yaml";
  const std::string log = folder.path("run.lcmlog");
  const std::string loop = folder.path("loop");
  const std::string pipe = folder.path("pipe");
};

TEST_F(FileChecks, ExportsMayNotOverwriteTheirLog) {
  const std::string before = read_text_file(log);
  for (const char* table : {"ticks.csv", "parts.csv", "hands.csv", "gloves.csv"}) {
    for (const bool is_hard : {true, false}) {
      std::filesystem::remove_all(folder.path("tables"));
      std::filesystem::create_directory(folder.path("tables"));
      const std::string link = folder.path("tables/" + std::string(table));
      is_hard ? std::filesystem::create_hard_link(log, link) : std::filesystem::create_symlink(log, link);
      expect_refused({"log", "to-csv", log, folder.path("tables")}, {table, "is an input, which would be overwritten"});
      expect_refused({"log", "to-csv", link, folder.path("tables")},
                     {table, "is an input, which would be overwritten"});
      const std::filesystem::directory_iterator files(folder.path("tables"));
      EXPECT_EQ(std::distance(begin(files), end(files)), 1) << "nothing is written";
      EXPECT_EQ(read_text_file(log), before);
    }
  }
  std::filesystem::create_hard_link(log, folder.path("moment.glb"));
  expect_refused({"log", "to-mcap", log, folder.path("moment.glb")}, {"is an input"});
}

TEST_F(FileChecks, APipeIsNoInput) {
  const std::string out = folder.path("out.glb");
  for (const Arguments& arguments : {
           Arguments{"replay", pipe},
           {"replay", pipe, "--json"},
           {"log", "to-csv", pipe, folder.path("tables")},
           {"log", "to-mcap", pipe, folder.path("out.mcap")},
           {"export", "--log", pipe, "--out", out},
           {"export", pipe, "--out", out},
           {"info", pipe},
           {"collide", mesh, pipe},
           {"slide", scene, "--part", "box", "--trajectory", pipe},
           {"grasp", tray, "--hand-trajectory", hand, "--hand", pipe},
       }) {
    SCOPED_TRACE(arguments.front());
    expect_refused(arguments, {"pipe: is not a regular file"});
  }
}

TEST_F(FileChecks, LinksInALoopAreRefusedWhereverTheyAre) {
  const std::string out = folder.path("out.glb");
  for (const Arguments& arguments : {
           Arguments{"replay", loop},
           {"replay", log, "--scene", loop},
           {"log", "to-csv", loop, folder.path("tables")},
           {"log", "to-csv", log, loop},
           {"log", "to-mcap", log, loop},
           {"export", "--log", loop, "--out", out},
           {"export", loop, "--out", out},
           {"info", loop},
           {"collide", mesh, loop},
           {"collide", mesh, mesh, "--out", loop},
           {"slide", loop, "--part", "box", "--trajectory", way},
           slide({"--out", loop}),
           slide({"--out", loop + "/a", "--contacts", folder.path("b")}),
           slide({"--summary", loop}),
           slide({"--report", loop}),
           {"grasp", tray, "--hand-trajectory", hand, "--out", folder.path("a"), "--objects", loop},
           {"grasp", tray, "--hand-trajectory", loop},
           demo({"--record", loop}),
           demo({"--record", loop, "--overwrite"}),
           demo({"--report", loop}),
           {"demo", "--scene", loop},
           {"example", loop},
       }) {
    SCOPED_TRACE(testing::PrintToString(arguments));
    if (arguments.front() == "replay" && arguments.size() > 2) continue;  // the log has no run
    expect_refused(arguments, {"loop"});
  }
  std::filesystem::create_symlink(folder.path("car_door.yaml"), folder.path("car_door.yaml"));
  expect_refused({"example", folder.path("")}, {"car_door.yaml"});
}

TEST_F(FileChecks, ARecordingReplacesAnOlderFileOnlyOnRequest) {
  const std::string before = read_text_file(log);
  expect_refused(demo({"--record", log}), {"run.lcmlog: is there already", "--overwrite"});
  std::filesystem::create_symlink(log, folder.path("link"));
  expect_refused(demo({"--record", folder.path("link")}), {"link: is there already"});
  EXPECT_EQ(read_text_file(log), before);
  const ProgramResult result = glissade(demo({"--record", log, "--overwrite"}));
  EXPECT_EQ(result.exit_code, 0) << result.standard_error;
  EXPECT_EQ(glissade({"replay", log}).exit_code, 0);
  EXPECT_EQ(glissade(demo({"--record", "/dev/null"})).exit_code, 0) << "a device holds nothing";
  expect_refused(demo({"--overwrite"}), {"--overwrite", "--record"});
  expect_refused({"demo", "--seconds", "0.1", "--scene", scene, "--record", log}, {"is there already"});
}

TEST_F(FileChecks, TablesOverwriteOlderFiles) {
  const std::string out = folder.write("out.csv", "of an earlier run");
  EXPECT_EQ(glissade(slide({"--out", out})).exit_code, 0);
  EXPECT_EQ(read_text_file(out), glissade(slide({})).standard_output);
}

TEST_F(FileChecks, ARecordingIsNoPipe) {
  expect_refused(demo({"--record", pipe}), {"pipe: is a pipe"});
  expect_refused(demo({"--record", pipe, "--overwrite"}), {"pipe: is a pipe"});
  expect_refused({"demo", "--seconds", "0.1", "--scene", scene, "--record", pipe}, {"pipe: is a pipe"});
}

TEST_F(FileChecks, ATableMayGoToAPipe) {
  Arguments arguments = slide({"--out", pipe});
  arguments.insert(arguments.begin(),
                   {"/bin/sh", "-c", "cat '" + pipe + "' & \"$0\" \"$@\" > /dev/null; wait", GLISSADE_PROGRAM});
  const ProgramResult result = test_support::Process(arguments).wait();
  EXPECT_EQ(result.standard_output, glissade(slide({})).standard_output) << result.standard_error;
}

TEST_F(FileChecks, TwoOutputsAreNotOneFile) {
  const std::string one = folder.write("one.csv", "");
  std::filesystem::create_hard_link(one, folder.path("other.csv"));
  expect_refused(slide({"--out", one, "--contacts", folder.path("other.csv")}), {"--contacts", "the file of --out"});
  expect_refused(slide({"--out", folder.path("a"), "--summary", folder.path("./a")}), {"--summary", "of --out"});
  expect_refused(slide({"--out", folder.path("page/index.html"), "--report", folder.path("page")}),
                 {"--report", "the file of --out"});
  expect_refused(demo({"--record", folder.path("page/index.html"), "--report", folder.path("page")}),
                 {"--report", "the file of --record"});
  expect_refused({"grasp", tray, "--hand-trajectory", hand, "--out", one, "--objects", folder.path("other.csv")},
                 {"--objects", "the file of --out"});
}

TEST_F(FileChecks, OutputInAMissingFolderOrToAFolderIsRefused) {
  for (const Arguments& arguments : {slide({"--out"}), demo({"--record"}), Arguments{"log", "to-mcap", log}}) {
    Arguments into_nowhere = arguments;
    into_nowhere.push_back(folder.path("no/file"));
    expect_refused(into_nowhere, {"no/file: cannot be created: there is no folder"});
    Arguments into_a_folder = arguments;
    into_a_folder.push_back(folder.path(""));
    expect_refused(into_a_folder, {"is a folder, not a file"});
  }
}

}  // namespace
}  // namespace glissade::apps
