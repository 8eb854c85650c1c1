/// What the program does with input that no user means to give it: numbers that are none, files that are huge or lead
/// elsewhere, output that goes nowhere.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <glissade/apps/text.h>
#include <glissade/files/text_file.h>

#include "glissade_program.h"
#include "sanitizers.h"
#include "temporary_folder.h"
#include "tetrahedron_file.h"

namespace glissade::apps {
namespace {

using test_support::expect_refused;
using test_support::glissade;
using test_support::kTetrahedronObj;
using test_support::ProgramResult;
using testing::HasSubstr;

class HostileInput : public testing::Test {
 protected:
  /// The program behind a shell that does this first, with its own file descriptors.
  static ProgramResult run_by_shell(const std::string& command, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"/bin/sh", "-c", command, GLISSADE_PROGRAM});
    return test_support::Process(arguments).wait();
  }

  std::vector<std::string> slide(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"slide", scene, "--part", "ball", "--trajectory", trajectory};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  test_support::TemporaryFolder folder;
  const std::string mesh = folder.write("a.obj", kTetrahedronObj);
  const std::string poses = folder.write("poses.csv", "x_m,y_m,z_m,qw,qx,qy,qz\n2,0,0,1,0,0,0\n");
  const std::string scene = folder.write("scene.yaml",
                                         "objects:\n"
                                         "  - {name: ball, movable: true, shape: {type: sphere, radius_m: 0.02}}\n"
                                         "  - {name: floor, shape: {type: plate}}\n");
  const std::string trajectory =
      folder.write("hand.csv", "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,0.1,1,0,0,0\n0.01,0,0,0.1,1,0,0,0\n");
};

TEST_F(HostileInput, NumbersMustBeFinite) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> options{
      {slide(), "--friction"},
      {slide(), "--goal-tolerance-m"},
      {slide(), "--goal-tolerance-deg"},
      {{"collide", mesh, mesh, "--poses", poses}, "--tolerance-m"},
      {{"demo", "--offline"}, "--seconds"},
      {{"run", scene}, "--seconds"},
      {{"run", scene}, "--rate-hz"},
      {{"run", scene}, "--spin-us"},
      {{"run", scene}, "--friction"},
      {{"record", folder.path("log"), scene}, "--seconds"},
      {{"glove"}, "--frozen-ms"},
      {{"latency"}, "--seconds"}};
  for (const auto& [command, option] : options) {
    for (const char* number : {"nan", "-nan", "inf", "1e999"}) {
      std::vector<std::string> arguments = command;
      arguments.push_back(option + "=" + number);
      expect_refused(arguments, {option});
    }
  }
}

TEST_F(HostileInput, UnwritableStandardOutputExitsWithCode1) {
  const std::vector<std::vector<std::string>> commands{{"--help"},
                                                       {"--version"},
                                                       {"info", mesh},
                                                       {"info", mesh, "--json"},
                                                       {"collide", mesh, mesh, "--poses", poses},
                                                       slide(),
                                                       slide({"--summary", "-"}),
                                                       {"demo", "--offline", "--seconds", "1", "--quiet"},
                                                       {"doctor"}};
  for (const std::vector<std::string>& arguments : commands) {
    for (const char* output : {"> /dev/full", ">&-", "<&- >&-"}) {
      SCOPED_TRACE(arguments.front() + " " + output);
      const ProgramResult result = run_by_shell("exec \"$0\" \"$@\" " + std::string(output), arguments);
      EXPECT_EQ(result.exit_code, 1);
      EXPECT_EQ(result.standard_error, "glissade: standard output: not everything could be written\n");
    }
  }
  const ProgramResult silent = run_by_shell("exec \"$0\" \"$@\" >&- 2>&-", {"info", mesh});
  EXPECT_EQ(silent.exit_code, 1);
}

TEST_F(HostileInput, OutputFileIsNotUsedAsClosedStandardOutput) {
  const ProgramResult result = run_by_shell("exec \"$0\" \"$@\" >&-", slide({"--out", folder.path("out.csv")}));
  EXPECT_EQ(result.exit_code, 1) << "the sentence about the outcome could not be printed";
  EXPECT_EQ(result.standard_error, "glissade: standard output: not everything could be written\n");
  EXPECT_EQ(read_text_file(folder.path("out.csv")), glissade(slide()).standard_output);
}

TEST_F(HostileInput, HugeInvalidFilesAreRefusedWithoutLoadingThem) {
  if (test_support::kSanitized) GTEST_SKIP() << "a sanitizer takes more address space than is allowed here";
  for (const char* name : {"huge.stl", "huge.obj", "huge.ply", "huge.glb", "huge.gltf", "huge.yaml"}) {
    const std::string path = folder.write(name, "");
    std::filesystem::resize_file(path, std::uintmax_t{1} << 35U);  // without a block on the disk
    const std::vector<std::string> info{"info", path};
    const std::vector<std::string> slide{"slide", path, "--part", "ball", "--trajectory", trajectory};
    const ProgramResult result =
        run_by_shell("ulimit -v 4000000; exec \"$0\" \"$@\"", path.ends_with(".yaml") ? slide : info);
    EXPECT_EQ(result.exit_code, 2) << result.standard_error;
    EXPECT_THAT(result.standard_error, HasSubstr(name));
  }
}

TEST_F(HostileInput, OutputsMayNotOverwriteInputs) {
  const std::string poses = folder.write("poses.csv", "x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,1,0,0,0\n");
  const std::string hand = folder.write("fingers.csv", read_text_file(GLISSADE_SCENES "/ball_and_tray_hand.csv"));
  const std::string tray = GLISSADE_SCENES "/ball_and_tray.yaml";
  const std::string script = folder.write("script.csv", read_text_file(trajectory));
  const std::string led = folder.write(
      "led.yaml",
      "objects:\n"
      "  - {name: ball, movable: true, shape: {type: sphere, radius_m: 0.02}, pose: {position_m: [0, 0, 0.1]}}\n"
      "  - {name: floor, shape: {type: plate}}\n"
      "script: script.csv\n");
  const std::string meshed = folder.write("meshed.yaml", "objects: [{name: a, mesh: a.obj}]\n");
  const std::string link = folder.path("link.csv");
  std::filesystem::create_symlink(trajectory, link);
  const std::vector<std::pair<std::string, std::vector<std::string>>> runs{
      {trajectory, slide({"--out", trajectory})},
      {trajectory, slide({"--out", link})},
      {trajectory, slide({"--summary", trajectory})},
      {scene, slide({"--contacts", scene})},
      {poses, {"collide", mesh, mesh, "--poses", poses, "--out", poses}},
      {mesh, {"export", meshed, "--out", mesh}},
      {led, {"demo", "--scene", led, "--offline", "--record", led}},
      {hand, {"grasp", tray, "--hand-trajectory", hand, "--out", hand}},
      {script, {"glove", "--script", script, "--record", script}}};
  for (const auto& [input, arguments] : runs) {
    SCOPED_TRACE(arguments.front() + " over " + input);
    const std::string before = read_text_file(input);
    const ProgramResult result = glissade(arguments);
    EXPECT_EQ(result.exit_code, 2) << result.standard_error;
    EXPECT_THAT(result.standard_error, HasSubstr(": is an input, which would be overwritten\n"));
    EXPECT_EQ(read_text_file(input), before);
  }
}

TEST_F(HostileInput, TreeCacheReplacesRegularFilesOnly) {
  const std::string cache = mesh + ".dop-tree";
  const std::string other = folder.write("precious", "of somebody else");
  const std::string expected = glissade({"info", mesh}).standard_output;
  const auto expect_left = [&] {
    const ProgramResult result = glissade({"info", mesh, "--cache"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.standard_output, expected);
    EXPECT_THAT(result.standard_error, HasSubstr("not replaced"));
  };

  std::filesystem::create_symlink(other, cache);
  expect_left();
  EXPECT_TRUE(std::filesystem::is_symlink(cache));
  EXPECT_EQ(read_text_file(other), "of somebody else");

  std::filesystem::remove(cache);
  std::filesystem::create_symlink(folder.path("nowhere"), cache);
  expect_left();
  EXPECT_TRUE(std::filesystem::is_symlink(cache));

  std::filesystem::remove(cache);
  ASSERT_EQ(mkfifo(cache.c_str(), 0600), 0);
  expect_left();
  EXPECT_TRUE(std::filesystem::is_fifo(cache));
}

TEST_F(HostileInput, ErrorsDeepInAYamlFileHaveTheirLine) {
  const auto expect_line = [&](const std::string& text, const std::vector<std::string>& parts) {
    const std::string path = folder.write("deep.yaml", "objects:\n  - name: ball\n    shape: {type: sphere}\n" + text);
    expect_refused({"slide", path, "--part", "ball", "--trajectory", trajectory}, parts);
  };
  expect_line("    pose:\n      position_m:\n        - 0\n        - {a: 1}\n        - 0\n",
              {"deep.yaml:7:", "position_m"});
  expect_line("    pose:\n      position_m:\n        - 0\n        -  # nothing\n\n        - 0\n",
              {"deep.yaml:7:", "position_m", "not nothing"});
  expect_line("    pose:\n\n    # A comment.\n    movable: true\n", {"deep.yaml:4:", "pose", "not nothing"});
  expect_line("    movable:\n", {"deep.yaml:4:", "movable"});
  std::string nested = "    pose: ";
  for (int i = 0; i < 5000; ++i)
    nested += '[';
  expect_line(nested, {"deep.yaml:4:", "lists or maps in more than"});
}

TEST_F(HostileInput, AMeshTakesNoFileFromAnotherFolder) {
  std::filesystem::create_directories(folder.path("meshes/part"));
  for (const char* name : {"secret.bin", "meshes/buffer.bin"})
    folder.write(name, std::string(36, 'x'));
  const auto mesh_of = [&](const std::string& uri) {
    return folder.write("meshes/a.gltf", R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 36, "uri": ")" +
                                             uri +
                                             R"("}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
      "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
      "bufferViews": [{"buffer": 0, "byteLength": 36}], "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}]})");
  };
  for (const std::string& uri : {std::string("../secret.bin"), std::string("%2e%2e/secret.bin"),
                                 std::string("part/../../secret.bin"), folder.path("secret.bin")}) {
    expect_refused({"info", mesh_of(uri)}, {"a.gltf", "buffers[0]", "only files in the folder"});
  }
}

}  // namespace
}  // namespace glissade::apps
