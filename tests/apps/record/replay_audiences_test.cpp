// Those for whom a recording is repeated.

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/apps/files/scene_file.h>
#include <glissade/apps/record/replay_audiences.h>
#include <glissade/apps/run/stop_signal.h>
#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/apps/text.h>
#include <glissade/files/text_file.h>

#include "page_client.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using std::chrono::milliseconds;

constexpr const char* kPartAbovePlate =
    "objects:\n"
    "  - {name: part, movable: true, shape: {type: box}}\n"
    "  - {name: plate, shape: {type: plate}, pose: {position_m: [0, 0, -1]}}\n";

/// A port that was free a moment ago.
std::uint16_t free_port() {
  return viewer::ViewServer(viewer::ViewScene{}).port();
}

/// Looks on as soon as there is a server, for as long as the process lives.
void look_on(std::uint16_t port) {
  for (;; std::this_thread::sleep_for(milliseconds(10))) {
    try {
      test_support::PageViewer viewer(port);
      for (;;)
        viewer.next();
    } catch (const boost::system::system_error&) {  // not yet
    }
  }
}

TEST(ReplayView, CtrlCEndsTheWaitForAStateInTheFarFuture) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto wait = [] {
    const StopSignal stop_signal;
    const HapticScene scene = make_haptic_scene(parse_scene(kPartAbovePlate, "scene", "."), {"part"});
    const std::uint16_t port = free_port();
    std::thread([port] { look_on(port); }).detach();
    ReplayView view(port);
    view.begin(scene, {}, milliseconds(1), {1}, {nullptr});
    devices::HapticState state;
    state.hand_count = 1;
    if (!view.take(state)) std::_Exit(1);
    std::thread([] {
      std::this_thread::sleep_for(milliseconds(200));
      std::raise(SIGINT);
    }).detach();
    state.time = std::chrono::hours(24);
    std::_Exit(view.take(state) ? 2 : 0);
  };
  EXPECT_EXIT(wait(), testing::ExitedWithCode(0), "");
}

TEST(ReplayReport, NamesTheRulesOfTheRun) {
  const test_support::TemporaryFolder folder;
  const HapticScene scene = make_haptic_scene(parse_scene(kPartAbovePlate, "scene", "."), {"part"});
  ReplayReport report("replay");
  report.begin(scene, {.friction = {0.2}}, milliseconds(1), {1}, {nullptr});
  EXPECT_THAT(read_text_file(report.write(folder.path("report"))), testing::HasSubstr("<td>friction 0.2</td>"));
}

}  // namespace
}  // namespace glissade::apps
