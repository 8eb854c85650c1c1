/// Completes words in bash, with the completion that is made of the program's own declarations.

#include <array>
#include <cstdio>
#include <string>

#include <CLI/CLI.hpp>
#include <gtest/gtest.h>

#include <glissade/apps/command_line/completion.h>
#include <glissade/apps/command_line/man_page.h>
#include <glissade/apps/program.h>

#include "temporary_folder.h"

namespace glissade::apps {
namespace {

class CommandLineFiles : public testing::Test {
 protected:
  CommandLineFiles() { declare_program(app_, chosen_); }

  /// What bash offers for the last of these words.
  std::string completed(const std::string& words) const {
    const test_support::TemporaryFolder folder;
    const std::string script = folder.write(
        "glissade.bash", bash_completion(app_) + "COMP_WORDS=(" + words +
                             ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_glissade\necho \"${COMPREPLY[*]}\"\n");
    std::FILE* bash = popen(("bash " + script + " 2>&1").c_str(), "r");
    std::string output;
    std::array<char, 4096> buffer{};
    while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), bash) != nullptr)
      output += buffer.data();
    EXPECT_EQ(pclose(bash), 0) << output;
    return output.substr(0, output.find('\n'));
  }

  CLI::App app_;
  Command chosen_;
};

TEST_F(CommandLineFiles, CommandsAreCompleted) {
  EXPECT_EQ(completed("glissade sl"), "slide");
  EXPECT_EQ(completed("glissade bridge ha"), "haply");
  EXPECT_EQ(completed("glissade help col"), "collide");
}

TEST_F(CommandLineFiles, OptionsAreThoseOfTheCommand) {
  EXPECT_EQ(completed("glissade slide scene.yaml --traj"), "--trajectory");
  EXPECT_EQ(completed("glissade bridge opengloves --full"), "--full-scale");
  EXPECT_EQ(completed("glissade info --traj"), "");
}

TEST_F(CommandLineFiles, ValuesOfAChoiceAreCompleted) {
  EXPECT_EQ(completed("glissade glove --side l"), "left");
}

TEST_F(CommandLineFiles, AllValuesOfAListAreCompleted) {
  EXPECT_EQ(completed("glissade emulate opengloves --fault echo cu"), "cut");
  EXPECT_EQ(completed("glissade emulate opengloves --fault echo --se"), "--seed --seconds");
  EXPECT_EQ(completed("glissade emulate opengloves --fault echo --link cu"), "");
  EXPECT_EQ(completed("glissade glove --side left ri"), "");  // one side is all it takes
}

TEST_F(CommandLineFiles, FilesAreLeftToBash) {
  EXPECT_EQ(completed("glissade info ''"), "");
}

TEST_F(CommandLineFiles, ZshCompletionNamesEveryCommand) {
  const std::string script = zsh_completion(app_);
  EXPECT_TRUE(script.starts_with("#compdef glissade\n"));
  for (const CLI::App* command : app_.get_subcommands([](const CLI::App*) { return true; }))
    EXPECT_NE(script.find("'glissade " + command->get_name() + "') command="), std::string::npos)
        << command->get_name();
}

TEST_F(CommandLineFiles, ManualPageHasNameSynopsisAndEveryOption) {
  const CLI::App& slide = *app_.get_subcommand("slide");
  const std::string page = man_page(slide, "glissade slide", "1.2.3");
  EXPECT_NE(page.find(".SH NAME\nglissade\\-slide \\- Move a part"), std::string::npos);
  EXPECT_NE(page.find(".SH SYNOPSIS\nglissade slide SCENE [OPTIONS]\n"), std::string::npos);
  for (const CLI::Option* option : slide.get_options()) {
    for (const std::string& name : option->get_lnames())
      EXPECT_NE(page.find("\\-\\-" + CLI::detail::find_and_replace(name, "-", "\\-")), std::string::npos) << name;
  }
}

TEST_F(CommandLineFiles, TextOfAManualPageIsNoRequest) {
  CLI::App command("Print\n.so and 'so at the beginning of a line, and back\\slashes");
  const std::string page = man_page(command, "glissade print", "1.2.3");
  EXPECT_NE(page.find("\n\\&.so and 'so at the beginning of a line, and back\\eslashes\n"), std::string::npos) << page;
}

}  // namespace
}  // namespace glissade::apps
