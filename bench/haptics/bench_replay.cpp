// See `register_replay` in benches.h.

#include <chrono>
#include <memory>
#include <string>

#include <glissade/apps/files/hand_script.h>
#include <glissade/apps/record/offline_replay.h>
#include <glissade/apps/scene/embedded_scene.h>
#include <glissade/apps/session/haptic_session.h>

#include "benches.h"
#include "seconds_each.h"
#include "temporary_folder.h"

namespace glissade::bench {
namespace {

/// The folder with the log of a run, as `glissade demo --offline --record` writes it.
std::shared_ptr<test_support::TemporaryFolder> recorded(const std::string& log, int ticks) {
  auto folder = std::make_shared<test_support::TemporaryFolder>();
  constexpr auto kDemonstration = apps::Demonstration::kCarDoor;
  const apps::Scene scene = apps::read_or_embedded_scene("", kDemonstration);
  const apps::HandScript script =
      apps::parse_hand_script(apps::embedded_scene_script(kDemonstration), apps::embedded_script_name(kDemonstration));
  const apps::HandScript scaled = script.time_scaled(std::chrono::milliseconds(ticks));
  apps::RecordSettings record;
  record.log = folder->path(log);
  apps::run_session_offline(apps::make_haptic_scene(scene, apps::movable_objects(scene)),
                            devices::SimulatedGlove(scaled.X_WH, scaled.with_grip({})), false, ticks, {}, record);
  return folder;
}

}  // namespace

void register_replay(const BenchOptions& options) {
  const std::string log = "run.lcmlog";
  const auto folder = lazy([=, ticks = options.quick ? 1000 : 6000] { return recorded(log, ticks); });
  register_run("replay/car-door/glissade", [=](benchmark::State& state) {
    for (auto _ : state) {
      const apps::ReplayOutcome outcome = apps::replay_offline((**folder)->path(log), "", nullptr);
      state.SetIterationTime(std::chrono::duration<double>(outcome.elapsed).count());  // without reading the scene
      state.counters["tick"] = seconds_each(outcome.ticks);
      state.counters["wrong"] = outcome.is_same() ? 0 : 1;
    }
  })->UseManualTime();
}

}  // namespace glissade::bench
