/// How the program helps a user who does not know it: help on commands, and on what was mistyped.

#include <cstdlib>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/apps/text.h>

#include "glissade_program.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using test_support::expect_refused;
using test_support::glissade;
using test_support::ProgramResult;
using testing::HasSubstr;

TEST(Help, HelpCommandEqualsHelpOption) {
  EXPECT_EQ(glissade({"help"}).standard_output, glissade({"--help"}).standard_output);
  EXPECT_EQ(glissade({"help", "slide"}).standard_output, glissade({"slide", "--help"}).standard_output);
  EXPECT_EQ(glissade({"help", "log", "to-csv"}).standard_output, glissade({"log", "to-csv", "--help"}).standard_output);
  EXPECT_EQ(glissade({"help", "slide"}).exit_code, 0);
  expect_refused({"help", "slid"}, {"'slid' is not a command", "'slide'"});
}

// An option that takes several values would take SCENE for one of them.
TEST(Help, HasArgumentsBeforeOptions) {
  EXPECT_THAT(glissade({"help", "slide"}).standard_output, HasSubstr("Usage: glissade slide SCENE [OPTIONS]\n"));
  EXPECT_THAT(glissade({"help", "log", "to-csv"}).standard_output,
              HasSubstr("Usage: glissade log to-csv LOG FOLDER [OPTIONS]\n"));
}

TEST(Help, ErrorsSuggestTheNearestName) {
  expect_refused({"inof"}, {"'inof' is not a command", "did you mean 'info'?", "glissade help"});
  expect_refused({"demo", "--ofline"}, {"--ofline is not an option of 'demo'", "did you mean '--offline'?"});
  expect_refused({"demo", "--second=3"}, {"--second ", "did you mean '--seconds'?"});
  expect_refused({"log", "to-cvs"}, {"did you mean 'to-csv'?"});
  EXPECT_THAT(glissade({"frobnicate"}).standard_error, testing::Not(HasSubstr("did you mean")));

  const test_support::TemporaryFolder folder;
  const std::string hand = folder.write("hand.csv", "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,1,1,0,0,0\n1,0,0,1,1,0,0,0\n");
  const auto slide = [&](const std::string& object, const std::vector<std::string>& more = {"--part", "box"}) {
    const std::string scene =
        folder.write("scene.yaml", "objects:\n- {name: box, movable: true, shape: {type: box}}\n" + object);
    std::vector<std::string> arguments{"slide", scene, "--trajectory", hand};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  };
  expect_refused(slide("", {"--part", "bxo"}), {"did you mean 'box'?"});
  expect_refused(slide("", {"--part", "box", "--metaphor", "ruber-band"}), {"did you mean 'rubber-band'?"});
  expect_refused(slide("- {name: a, shape: {type: spere}}\n"), {"did you mean 'sphere'?"});
  expect_refused(slide("- {name: a, shape: {type: sphere, radius: 1}}\n"), {"did you mean 'radius_m'?"});
  expect_refused(slide("- {name: a, moveable: true, shape: {type: sphere}}\n"), {"did you mean 'movable'?"});
}

TEST(Help, SuggestsForOneTypoOrAPrefix) {
  const std::vector<std::string> known{"collide", "slide", "info"};
  EXPECT_EQ(did_you_mean("colide", known), " (did you mean 'collide'?)") << "one too few";
  EXPECT_EQ(did_you_mean("slidee", known), " (did you mean 'slide'?)") << "one too many";
  EXPECT_EQ(did_you_mean("ifno", known), " (did you mean 'info'?)") << "two that changed places";
  EXPECT_EQ(did_you_mean("coll", known), " (did you mean 'collide'?)") << "cut short";
  EXPECT_EQ(did_you_mean("glove", known), "");
  EXPECT_EQ(did_you_mean("", known), "");
}

TEST(Help, MissingMulticastRouteErrorNamesTheCommand) {
  const auto run_alone = [](const std::vector<std::string>& command) {
    std::vector<std::string> arguments{"unshare", "-rn"};
    arguments.insert(arguments.end(), command.begin(), command.end());
    return test_support::Process(arguments).wait();
  };
  if (run_alone({"true"}).exit_code != 0) GTEST_SKIP() << "this system refuses network namespaces";
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"glove"}, {"demo", "--lcm", "udpm://239.255.76.67:7667?ttl=0", "--seconds", "0.1"}}) {
    std::vector<std::string> arguments{GLISSADE_PROGRAM};
    arguments.insert(arguments.end(), command.begin(), command.end());
    const ProgramResult result = run_alone(arguments);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.standard_error, HasSubstr("sudo ip route add 239.0.0.0/8 dev lo\n"));
  }
}

TEST(Numbers, AreRoundedToThreeDigitsOrAnInteger) {
  EXPECT_EQ(rounded_text(10.000000001), "10");
  EXPECT_EQ(rounded_text(0.00123456), "0.00123");
  EXPECT_EQ(rounded_text(-0.0), "0");
  EXPECT_EQ(rounded_text(1523.4), "1523");
  EXPECT_EQ(rounded_text(999.6), "1000");
}

TEST(Numbers, ZeroHasNoSign) {
  EXPECT_EQ(format_number(-0.0), "0");
  EXPECT_EQ(fixed_text(-0.0004, 3), "0.000");
  EXPECT_EQ(fixed_text(-0.0006, 3), "-0.001");
  const test_support::TemporaryFolder folder;
  const std::string mesh = folder.write("a.obj", "v -0.0 -0.0 -0.0\nv 1 0 -0.0\nv 0 1 -0.0\nf 1 2 3\n");
  EXPECT_THAT(glissade({"info", mesh}).standard_output, testing::Not(HasSubstr("-0")));
  EXPECT_THAT(glissade({"info", mesh, "--json"}).standard_output, testing::Not(HasSubstr("-0")));
}

}  // namespace
}  // namespace glissade::apps
