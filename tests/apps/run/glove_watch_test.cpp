#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/apps/run/glove_watch.h>
#include <glissade/devices/simulated_glove.h>

namespace glissade::apps {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::IsEmpty;

/// A glove that is pulled with 8 N, whose clock begins at an hour.
class Glove : public testing::Test {
 protected:
  void run(int periods) {
    devices::GloveCommand wanted;
    wanted.f_H_W.x() = 8.0;
    for (int i = 0; i < periods; ++i) {
      state_.time += milliseconds(1);
      ++state_.sequence;
      wanted.state_time = state_.time;
      watch_.note(state_.time, envelope_.limit(wanted, state_, state_.time));
    }
  }

  std::string status() { return watch_.status(milliseconds(2500), milliseconds(12'000)); }

  GloveWatch watch_;
  devices::SafetyEnvelope envelope_{devices::simulated_glove_descriptor()};
  devices::GloveState state_{.time = std::chrono::hours(1)};
};

TEST_F(Glove, ShowsNothingBeforeAServerCommands) {
  EXPECT_EQ(status(), "");
  EXPECT_THAT(watch_.events(), IsEmpty());
}

TEST_F(Glove, ShowsItsForceOrWhyThereIsNone) {
  run(500);
  EXPECT_EQ(status(), "2.5 of 12.0 s of the script: 8.0 N");
  state_.is_enabled = false;
  run(1);
  EXPECT_THAT(status(), testing::EndsWith(" N, no force: the wearer does not hold the enable switch")) << "it fades";
  run(10);
  EXPECT_EQ(status(), "2.5 of 12.0 s of the script: no force: the wearer does not hold the enable switch");
}

TEST_F(Glove, TellsEventsWithTheTimeSinceTheFirstCommand) {
  run(500);
  EXPECT_THAT(watch_.events(), IsEmpty());
  state_.is_enabled = false;
  run(100);
  EXPECT_THAT(watch_.events(), ElementsAre("0.500 s: no force: the wearer does not hold the enable switch"));
}

}  // namespace
}  // namespace glissade::apps
