/// Every example in a help works as it is pasted, in a folder with the files of `glissade example`.

#include "help_examples.h"

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/apps/text.h>
#include <glissade/files/text_file.h>

#include "glissade_program.h"
#include "sanitizers.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using test_support::examples_of;
using test_support::glissade;
using test_support::ProgramResult;
using test_support::run_example;

TEST(HelpExamples, EveryCommandHasTwo) {
  for (const std::string& command : test_support::kCommands)
    EXPECT_GE(examples_of(command).size(), 2U) << command;
  // The commands are those that the help lists.
  std::istringstream help(glissade({"help"}).standard_output);
  std::string line;
  while (std::getline(help, line) && line != "Subcommands:")
    continue;
  while (std::getline(help, line) && line.starts_with("  ")) {
    if (line[2] == ' ') continue;  // more of a description
    EXPECT_THAT(test_support::kCommands, testing::Contains(line.substr(2, line.find(' ', 2) - 2)));
  }
}

TEST(HelpExamples, WorkAsTheyArePasted) {
  const test_support::TemporaryFolder folder;
  ASSERT_EQ(run_example("glissade example", folder).exit_code, 0);
  for (const std::string& command : test_support::kCommands) {
    for (const std::string& example : examples_of(command)) {
      const bool is_slow = example.find("demo") != std::string::npos || command == "grasp" || command == "study";
      if (test_support::needs_network(example) || (test_support::kSanitized && is_slow)) continue;
      SCOPED_TRACE(example);
      const ProgramResult result = run_example(example, folder);
      const bool is_too_fast =
          result.standard_error.find("missed its goal") != std::string::npos;  // in a second, with fingers
      EXPECT_LE(result.exit_code, is_too_fast ? 1 : 0) << result.standard_error;
    }
  }
  // They show what they say.
  EXPECT_EQ(run_example("cat ways.csv | cut -d, -f1,2", folder).standard_output,
            "trajectory,goal_reached\nsquare_peg_beside.csv,0\nsquare_peg_script.csv,1\n");
  EXPECT_EQ(run_example("glissade collide panel.obj motor.obj --poses poses.csv", folder).standard_output,
            "pose,colliding\n0,0\n1,0\n2,1\n");
}

TEST(HelpExamples, ExampleFilesOverwriteNoChangedFile) {
  const test_support::TemporaryFolder folder;
  ASSERT_EQ(glissade({"example", folder.path("a")}).exit_code, 0);
  EXPECT_EQ(glissade({"example", folder.path("a")}).exit_code, 0) << "the same again";
  folder.write("a/poses.csv", "mine");
  std::filesystem::remove(folder.path("a/car_door.yaml"));
  test_support::expect_refused({"example", folder.path("a")}, {"poses.csv", "another content"});
  EXPECT_EQ(read_text_file(folder.path("a/poses.csv")), "mine");
  EXPECT_FALSE(std::filesystem::exists(folder.path("a/car_door.yaml"))) << "nothing is written";
  test_support::expect_refused({"example", folder.path("a/poses.csv/b")}, {"poses.csv/b", "cannot make"});
}

}  // namespace
}  // namespace glissade::apps
