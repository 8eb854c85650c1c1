// A game engine beside the haptic loop: a renderer of 60 frames a second that stalls twice for half a second, and a
// driver of a glove in a thread of its own.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <thread>

#include "c_scene.h"

namespace glissade {
namespace {

using std::chrono::milliseconds;

/// A driver at 1 kHz whose hand goes to and fro by 1 cm, above the plate, and turns with its place: 1 rad/m.
class SwingingDriver {
 public:
  explicit SwingingDriver(GlissadeGlove glove) : glove_(glove), thread_([this] { run(); }) {}
  ~SwingingDriver() {
    should_end_ = true;
    thread_.join();
  }

 private:
  void run() {
    GlissadeGloveState state;
    glissade_glove_state_default(&state);
    for (std::int64_t ms = 0; !should_end_; ++ms) {
      const std::int64_t phase = std::max<std::int64_t>(0, ms - 200) + 500;  // the box is taken at the origin
      const double x = 20e-6 * static_cast<double>(500 - std::abs(phase % 2000 - 1000));
      state.X_WH = {x, 0.0, 0.0, std::cos(0.5 * x), 0.0, 0.0, std::sin(0.5 * x)};
      state.time_ns = glissade_now_ns();
      EXPECT_C(glissade_glove_put(glove_, &state));
      GlissadeGloveCommand command;
      EXPECT_C(glissade_glove_command(glove_, &command));
      std::this_thread::sleep_for(milliseconds(1));
    }
  }

  GlissadeGlove glove_;
  std::atomic<bool> should_end_{false};
  std::thread thread_;
};

/// Whether position and rotation of the ghost are of one moment.
void expect_whole(const GlissadeFrame& frame) {
  ASSERT_EQ(frame.part_count, 1);
  const GlissadePose& ghost = frame.parts[0].X_WG;
  EXPECT_NEAR(2.0 * std::atan2(ghost.qz, ghost.qw), ghost.x, 1e-9) << "tick " << frame.tick;
  EXPECT_DOUBLE_EQ(ghost.z, 0.022);
}

TEST_F(BoxOnPlate, TheLoopGoesOnWhileARendererStalls) {
  const GlissadeGlove glove = driven_glove(100.0);  // patient, because a busy machine stops threads
  GlissadeServer server{};
  ASSERT_C(glissade_server_start(simulation, &glove, 1, &server));
  {
    const SwingingDriver driver(glove);
    GlissadeFrame frame{};
    while (frame.tick == 0) {
      ASSERT_C(glissade_server_frame(server, &frame));
      std::this_thread::sleep_for(milliseconds(1));
    }
    const std::int64_t first_tick = frame.tick;
    const std::int64_t first_ns = frame.time_ns;
    for (int rendered = 0; rendered < 90; ++rendered) {
      const std::int64_t before = frame.tick;
      const std::int64_t before_ns = frame.time_ns;
      const bool stalls = rendered == 30 || rendered == 60;
      std::this_thread::sleep_for(stalls ? milliseconds(500) : milliseconds(16));
      GlissadeStatistics at_least;
      ASSERT_C(glissade_server_statistics(server, &at_least));
      ASSERT_C(glissade_server_frame(server, &frame));
      expect_whole(frame);
      EXPECT_GE(frame.tick, at_least.ticks) << "the newest: none older than the count of ticks";
      if (stalls) {
        EXPECT_GE(frame.tick - before, (frame.time_ns - before_ns) / 2'000'000)
            << "the loop has not waited: at 1 kHz, less than half of the ticks may be skipped";
      }
    }
    const double seconds = static_cast<double>(frame.time_ns - first_ns) * 1e-9;
    RecordProperty("ticks_per_second", std::to_string(static_cast<double>(frame.tick - first_tick) / seconds));
  }
  EXPECT_C(glissade_server_check(server));
  EXPECT_C(glissade_server_free(server));
  EXPECT_C(glissade_glove_free(glove));
}

/// A driver that presses its hand into the plate, and a loop that ends: the force comes, and does not last.
TEST_F(BoxOnPlate, AForceReachesTheDriverAndEndsWithTheLoop) {
  const GlissadeGlove glove = driven_glove(100.0);
  GlissadeServer server{};
  ASSERT_C(glissade_server_start(simulation, &glove, 1, &server));
  GlissadeGloveState state;
  glissade_glove_state_default(&state);
  GlissadeGloveCommand command{};
  const auto period = [&] {
    state.X_WH.z = std::max(-0.006, state.X_WH.z - 20e-6);
    state.time_ns = glissade_now_ns();
    EXPECT_C(glissade_glove_put(glove, &state));
    EXPECT_C(glissade_glove_command(glove, &command));
    std::this_thread::sleep_for(milliseconds(1));
  };
  for (int i = 0; i < 20'000 && command.force_N[2] < 1.0; ++i)
    period();
  EXPECT_GE(command.force_N[2], 1.0) << "upwards, from the plate";
  GlissadeFrame frame;
  ASSERT_C(glissade_server_frame(server, &frame));
  EXPECT_GT(frame.hands[0].force_N[2], 0.0);
  ASSERT_C(glissade_server_stop(server));
  ASSERT_C(glissade_server_frame(server, &frame));
  EXPECT_EQ(frame.hands[0].force_N[2], 0.0) << "a renderer draws no force that has gone";
  EXPECT_NE(frame.hands[0].reasons, 0);
  for (int i = 0; i < 20'000 && command.force_N[2] > 0.0; ++i)
    period();
  EXPECT_EQ(command.force_N[2], 0.0);
  for (int i = 0; i < 200; ++i)
    period();
  EXPECT_EQ(command.force_N[2], 0.0) << "nothing lasts";
  char reason[100];
  ASSERT_C(glissade_reason_text(command.reasons, command.age_ns, reason, sizeof reason));
  EXPECT_NE(std::string(reason).find("no force"), std::string::npos) << reason;
  EXPECT_C(glissade_server_free(server));
  EXPECT_C(glissade_glove_free(glove));
}

TEST_F(BoxOnPlate, ASimulatedGloveTellsWhatItExerts) {
  const double times_s[] = {0.0, 0.3};
  const GlissadePose hand[] = {{.z = 0.1, .qw = 1.0}, {.z = 0.08, .qw = 1.0}};
  GlissadeGlove glove{};
  ASSERT_C(glissade_glove_new_simulated(times_s, hand, 2, &glove));
  GlissadeServer server{};
  ASSERT_C(glissade_server_start(simulation, &glove, 1, &server));
  GlissadeGloveCommand command{};
  const auto wait_until = [&](auto condition) {
    for (int i = 0; i < 20'000 && !condition(); ++i) {
      std::this_thread::sleep_for(milliseconds(1));
      EXPECT_C(glissade_glove_command(glove, &command));
    }
  };
  wait_until([&] { return command.force_N[2] > 1.0; });
  EXPECT_GT(command.force_N[2], 1.0) << "upwards, from the plate";
  ASSERT_C(glissade_server_stop(server));
  wait_until([&] { return (command.reasons & GLISSADE_REASON_COMMAND_OLD) != 0; });
  EXPECT_EQ(command.force_N[2], 0.0) << "no commands come any more";
  EXPECT_C(glissade_server_free(server));
  EXPECT_C(glissade_glove_free(glove));
}

}  // namespace
}  // namespace glissade
