// Wrong use of `glissade view` and of --view.

#include <string>

#include <gtest/gtest.h>

#include <glissade/viewer/view_server.h>

#include "glissade_program.h"

namespace glissade::apps {
namespace {

using test_support::expect_refused;

TEST(ViewCommand, NamesWhatIsWrong) {
  expect_refused({"view", "no_such_scene.yaml"}, {"no_such_scene.yaml"});
  expect_refused({"view", "--lcm", "memq://"}, {"--lcm", "one process only"});
  expect_refused({"view", "--hand", "hand.yaml"}, {"--hand", "--fingers"});
  expect_refused({"view", "--port", "65536"}, {"--port", "must be a port, 0 to 65535, not '65536'"});
}

TEST(ViewOption, ATakenPortNamesTheOption) {
  const viewer::ViewServer other(viewer::ViewScene{});
  const std::string port = std::to_string(other.port());
  expect_refused({"demo", "--view", port, "--quiet"},
                 {"--view: port " + port + " cannot be opened", "choose another port, or any free one with --view 0"});
}

TEST(ViewOption, TakesAPortOrNothing) {
  expect_refused({"demo", "--view", "nonsense"}, {"--view", "0 to 65535", "nonsense"});
  expect_refused({"demo", "--view", "65536"}, {"--view", "65536"});
  expect_refused({"demo", "--view", "--offline"}, {"--view", "--offline"});
}

}  // namespace
}  // namespace glissade::apps
