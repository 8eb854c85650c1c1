/// `glissade bridge` and `glissade emulate`: bad usage, and devices that are none.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "glissade_program.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using test_support::expect_refused;

TEST(BridgeCommand, RefusesBadUsage) {
  expect_refused({"bridge", "opengloves"}, {"--port is missing", "--list"});
  expect_refused({"bridge", "opengloves", "--port", "tcp:glove:0"}, {"tcp:glove:0", "from 1 to 65535"});
  expect_refused({"bridge", "opengloves", "--port", "a", "--orientation-wxyz", "1", "1", "0", "0"},
                 {"--orientation-wxyz", "norm"});
  expect_refused({"bridge", "opengloves", "--port", "a", "--full-scale", "0"}, {"--full-scale"});
  expect_refused({"bridge", "opengloves", "--port", "a", "--lcm", "memq://"}, {"--lcm", "udpm://"});
  expect_refused({"emulate", "opengloves", "--rate-hz", "0"}, {"rate", "1000 Hz"});
}

TEST(BridgeCommand, RefusesBadConfigurationsOfServos) {
  const test_support::TemporaryFolder folder;
  const std::string file =
      folder.write("glove.yaml", "name: a\nmodel: XL330-M288\nservos:\n  - {id: 1, joint: nose}\n");
  expect_refused({"bridge", "dynamixel", "--port", "a"}, {"--config is missing", "--preset", "doglove"});
  expect_refused({"bridge", "dynamixel", "--port", "a", "--config", file}, {"glove.yaml:4", "'nose' is no joint"});
  expect_refused({"bridge", "dynamixel", "--port", "a", "--config", "missing.yaml"}, {"missing.yaml"});
  expect_refused({"bridge", "dynamixel", "--preset", "doglove"}, {"--port is missing"});
  expect_refused({"bridge", "dynamixel", "--preset", "doglove", "--port", "a"}, {"--board-port is missing"});
  expect_refused({"bridge", "dynamixel", "--preset", "dogglove", "--port", "a"}, {"--preset", "doglove"});
  expect_refused({"bridge", "dynamixel", "--preset", "doglove", "--port", "a", "--baud", "100"}, {"baud_rate"});
  expect_refused({"emulate", "dynamixel"}, {"--config is missing"});
}

TEST(BridgeCommand, RefusesBadUsageOfHaply) {
  expect_refused({"bridge", "haply", "--service", "haply.example"}, {"haply.example", "address"});
  expect_refused({"bridge", "haply", "--service", "localhost:0"}, {"localhost:0", "from 1 to 65535"});
  expect_refused({"bridge", "haply", "--orientation-wxyz", "1", "1", "0", "0"}, {"--orientation-wxyz", "norm"});
  expect_refused({"emulate", "haply", "--fault", "fire"}, {"--fault", "unplug"});
  expect_refused({"emulate", "haply", "--script", "no_such_file.csv"}, {"no_such_file.csv"});
}

TEST(BridgeCommand, SaysThatThereIsNoHaplyService) {
  // Nothing listens at port 1 of a machine.
  const test_support::ProgramResult result =
      test_support::glissade({"bridge", "haply", "--service", "localhost:1", "--check"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.standard_error, testing::HasSubstr("127.0.0.1:1: nothing listens there"));
  test_support::expect_fails(1, {"bridge", "haply", "--service", "localhost:1", "--list"}, {"nothing listens there"});
}

TEST(BridgeCommand, ChecksAPortThatIsNone) {
  test_support::ProgramResult result =
      test_support::glissade({"bridge", "opengloves", "--port", "/dev/null", "--check"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.standard_error, "glissade bridge: /dev/null: this is no serial port\n");
  result = test_support::glissade(
      {"bridge", "dynamixel", "--preset", "doglove", "--port", "/dev/null", "--board-port", "/dev/null", "--check"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.standard_error, "glissade bridge: /dev/null: this is no serial port\n");
}

TEST(BridgeCommand, ListsPorts) {
  for (const char* device : {"opengloves", "dynamixel"}) {
    const test_support::ProgramResult result = test_support::glissade({"bridge", device, "--list"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_NE(result.standard_output, "");
  }
}

}  // namespace
}  // namespace glissade::apps
