/// `glissade calibrate`, and the options of a calibration and a tracker: bad usage and bad files.

#include <gtest/gtest.h>

#include "glissade_program.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using test_support::expect_refused;

TEST(CalibrateCommand, RefusesBadUsage) {
  const test_support::TemporaryFolder folder;
  const std::string out = folder.path("anna.yaml");
  expect_refused({"calibrate"}, {"--out"});
  expect_refused({"calibrate", "--out", out, "--hold-s", "0"}, {"--hold-s", "between 0.2 and 60"});
  expect_refused({"calibrate", "--out", out, "--pause-s", "-1"}, {"--pause-s"});
  expect_refused({"calibrate", "--out", out, "--without", "index_knuckle"}, {"--without", "index_knuckle"});
  const std::string old = folder.write("old.yaml", "user: anna\n");
  expect_refused({"calibrate", "--out", old}, {"old.yaml", "--overwrite"});
}

TEST(CalibrateCommand, OfABridgeRefusesAFileThatIsWrong) {
  const test_support::TemporaryFolder folder;
  const std::string wrong = folder.write("wrong.yaml", "user: anna\ndevice: glove\nside: middle\n");
  expect_refused({"bridge", "opengloves", "--port", "/dev/null", "--calibration", wrong}, {"wrong.yaml:3", "side"});
}

TEST(CalibrateCommand, OfABridgeRefusesATrackerThatIsNone) {
  for (const char* const tracker : {"udp", "lcm:", "lcm:0", "lcm:-2", "lcm:1x"})
    expect_refused({"bridge", "opengloves", "--port", "/dev/null", "--pose-from", tracker}, {"--pose-from", tracker});
  expect_refused({"bridge", "opengloves", "--port", "/dev/null", "--pose-from", "lcm", "--pose-rate-hz", "0"},
                 {"--pose-rate-hz"});
  expect_refused({"emulate", "opengloves", "--tracker"}, {"--tracker", "--script"});
  expect_refused({"emulate", "opengloves", "--script", "missing.csv"}, {"missing.csv"});
}

}  // namespace
}  // namespace glissade::apps
