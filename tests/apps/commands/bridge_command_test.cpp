/// `glissade bridge opengloves` and `glissade emulate opengloves`: bad usage, and ports that are none.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "glissade_program.h"

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

TEST(BridgeCommand, ChecksAPortThatIsNone) {
  const test_support::ProgramResult result =
      test_support::glissade({"bridge", "opengloves", "--port", "/dev/null", "--check"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.standard_error, "glissade bridge: /dev/null: this is no serial port\n");
}

TEST(BridgeCommand, ListsPorts) {
  const test_support::ProgramResult result = test_support::glissade({"bridge", "opengloves", "--list"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.standard_output, "");
}

}  // namespace
}  // namespace glissade::apps
