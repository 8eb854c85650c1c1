#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>

#include <glissade/apps/commands/command.h>
#include <glissade/apps/commands/scene_warnings.h>
#include <glissade/apps/commands/size_warnings.h>
#include <glissade/apps/durations.h>
#include <glissade/apps/files/hand_script.h>
#include <glissade/apps/files/scene_file.h>
#include <glissade/apps/open_files.h>
#include <glissade/apps/progress.h>
#include <glissade/apps/report/html_report.h>
#include <glissade/apps/run/lcm_option.h>
#include <glissade/apps/run/missed_goal.h>
#include <glissade/apps/run/status_line.h>
#include <glissade/apps/run/stop_signal.h>
#include <glissade/apps/say.h>
#include <glissade/apps/scene/embedded_scene.h>
#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/apps/session/haptic_session.h>
#include <glissade/apps/text.h>
#include <glissade/apps/view/session_view.h>
#include <glissade/devices/glove_model.h>
#include <glissade/devices/simulated_glove_service.h>
#include <glissade/files/file_checks.h>
#include <glissade/realtime/periodic_thread.h>

namespace glissade::apps {

namespace {

constexpr const char* kDemoDescription =
    "Run the whole system without hardware: a simulated glove carries a part to its seat";

constexpr const char* kDemoFooter =
    "Without --scene, the hand carries a window motor into a car door: through the access hole of the inner panel,\n"
    "past the side-impact tube and back against the panel. With --fingers, the hand grasps a motor on a bench with\n"
    "its fingers, carries it to its seat on a door module, lets go and withdraws.\n"
    "\n"
    "The hand follows a script that is scaled in time to --seconds, and yields to the forces on the hand. In real\n"
    "time, glove and server communicate over LCM, 1000 times a second. If the machine is too slow, the simulated\n"
    "wearer waits for the visible parts, and the run takes longer. If the script of --scene has columns for the\n"
    "joints, the hand grasps movable objects with its fingers. Otherwise, the hand holds the first movable object\n"
    "rigidly. Other movable objects lie still, and objects with 'moves: FILE' follow their own scripts. With\n"
    "--offline, everything runs in one thread on a simulated clock, and the result is the same every time. With\n"
    "--view, the run starts when a browser has opened the page.\n"
    "\n"
    "After the run, brute force checks every visible pose, i.e. every pose at which parts and hands with fingers were\n"
    "shown. If a pose collides, or if the part misses the goal of the scene, the exit code is 1. If Ctrl-C ends the\n"
    "run earlier, the goal does not count.\n"
    "For the keys of --json, see docs/file_formats.md in the sources.\n"
    "\n"
    "Examples:\n"
    "  glissade demo --seconds 4\n"
    "  glissade demo --fingers --seconds 6 --report report\n"
    "  glissade demo --offline --seconds 2 --json\n"
    "  glissade demo --offline --fingers --preset dynamixel\n"
    "  glissade demo --seconds 3 --record demo.lcmlog";

/// How much longer than its script a run may take because the wearer waits: so many times as long, but at most so long.
constexpr double kMostWaiting = 4.0;
constexpr double kMostWaiting_s = 120.0;
/// Shorter waits are not told.
constexpr std::chrono::milliseconds kToldWaiting{100};

struct DemoOptions {
  double seconds = 10.0;
  std::string scene;
  bool fingers = false;
  std::string preset;
  bool offline = false;
  bool json = false;
  bool verbose = false;
  std::string lcm_url = "memq://";
  std::string report;
  std::string record;
  bool overwrites = false;
  std::optional<std::uint16_t> view_port;
  SlidingChoice choice;
};

std::int64_t checked_ticks(double seconds) {
  if (!(seconds >= 0.01 && seconds <= 3600.0)) {
    throw std::invalid_argument("--seconds: must lie between 0.01 and 3600, not " + format_number(seconds));
  }
  return std::llround(seconds * 1000.0);
}

struct Demo {
  HapticScene scene;
  HandScript script;
};

Eigen::AlignedBox3d positions_of(const geometry::PoseTrajectory& trajectory) {
  constexpr int kMoments = 200;
  Eigen::AlignedBox3d positions;
  for (int i = 0; i <= kMoments; ++i) {
    const std::chrono::nanoseconds time = trajectory.first_time() + i * trajectory.duration() / kMoments;
    positions.extend(Eigen::Vector3d(trajectory.pose_at(time).translation()));
  }
  return positions;
}

Demo demo_of(const std::string& path, bool fingers) {
  const Demonstration demonstration = fingers ? Demonstration::kDoorModule : Demonstration::kCarDoor;
  const Scene scene = read_or_embedded_scene(path, demonstration);
  if (!scene.script_path && !path.empty()) {
    throw std::invalid_argument(path + ": the scene has no script for the hand to follow");
  }
  HapticScene haptic_scene = make_haptic_scene(scene, movable_objects(scene));
  warn_of_scene(scene, haptic_scene);
  HandScript script = path.empty()
                          ? parse_hand_script(embedded_scene_script(demonstration), embedded_script_name(demonstration))
                          : read_hand_script(*scene.script_path);
  if (const std::string doubt = doubt_of_positions(positions_of(script.X_WH), haptic_scene); !doubt.empty())
    warn(scene.script_path.value_or(scene.source) + ": " + doubt);
  return {std::move(haptic_scene), std::move(script)};
}

RecordSettings record_of(const DemoOptions& options) {
  return {.log = options.record, .overwrites = options.overwrites, .scene_file = options.scene};
}

devices::SimulatedGlove simulated_glove(const HandScript& script, const std::string& preset) {
  const devices::SimulatedGloveParameters parameters = script.with_grip({});
  if (preset.empty()) return devices::SimulatedGlove(script.X_WH, parameters);
  return devices::SimulatedGlove(script.X_WH, parameters, devices::read_glove_model(preset));
}

Session run_in_real_time(const Demo& demo, const HandScript& script, std::int64_t ticks, const DemoOptions& options) {
  realtime::lock_memory();
  const StopSignal stop_signal;
  const auto bus = connect_to_lcm(options.lcm_url);
  realtime::SteadyClock clock;
  devices::SimulatedGloveService glove(bus, simulated_glove(script, options.preset), clock);
  const auto should_stop = [&] {
    return StopSignal::requested() || glove.script_time() >= std::chrono::milliseconds(ticks);
  };
  StatusLine line;
  SessionHand hand;
  if (!script.fingers.empty()) hand = {.part = std::nullopt, .fingers = grasping::HandShape{}};
  const double seconds = 1e-3 * static_cast<double>(ticks);
  Session session = run_session(demo.scene, bus,
                                {.hands = {hand},
                                 .choice = options.choice,
                                 .seconds = seconds,
                                 .longer_s = std::min(kMostWaiting * seconds, kMostWaiting_s),
                                 .period = haptics::kTickPeriod,
                                 .record = record_of(options),
                                 .view_port = options.view_port,
                                 .waits_for_page = true},
                                should_stop, [&](const RunNews& news) {
                                  for (const std::string& sentence : news.sentences)
                                    line.say("glissade demo: " + sentence);
                                  line.show(news.status);
                                });
  if (glove.waited() > kToldWaiting)
    say("glissade demo: the wearer waited " + fixed_text(in_seconds(glove.waited()), 1) +
        " s in total for the visible hand and part, which lagged behind");
  return session;
}

int run(const DemoOptions& options) {
  const std::int64_t ticks = checked_ticks(options.seconds);
  const Demo demo = demo_of(options.scene, options.fingers);
  const HandScript script = demo.script.time_scaled(std::chrono::milliseconds(ticks));
  check_distinct({{"--record", options.record}, {"--report", report_page(options.report)}});
  if (!options.report.empty()) prepare_report_folder(options.report);
  const Session session = options.offline
                              ? run_session_offline(demo.scene, simulated_glove(script, options.preset),
                                                    !script.fingers.empty(), ticks, options.choice, record_of(options))
                              : run_in_real_time(demo, script, ticks, options);
  const SessionSummary summary = conclude(
      session, demo.scene, "glissade demo: " + demo.scene.parts.front().name + (options.offline ? ", offline" : ""),
      options.json, options.verbose, options.report);
  const bool is_missed = summary.goal_reached == false && !StopSignal::requested();
  if (is_missed) throw std::runtime_error(why_goal_is_missed(summary, session, demo.scene));
  return 0;
}

}  // namespace

void add_demo_command(CLI::App& app, Command& chosen) {
  const auto options = std::make_shared<DemoOptions>();
  CLI::App* command = app.add_subcommand("demo", kDemoDescription);
  command->footer(std::string(kDemoFooter) + kSlidingChoiceHelp + kSceneFileHelp);
  command->add_option("--seconds", options->seconds, "Duration of the script in seconds")->capture_default_str();
  command->add_option("--scene", options->scene, "Scene file (YAML) with a movable object and a script");
  command
      ->add_flag("--fingers", options->fingers, "Without --scene: the hand grasps a motor with its fingers, see below")
      ->excludes("--scene");
  command->add_option(
      "--preset", options->preset,
      "Simulated device on the hand: a preset (see 'glissade glove --presets') or a YAML file with a model");
  add_sliding_options(*command, options->choice);
  CLI::Option* offline =
      command->add_flag("--offline", options->offline, "Run deterministically, on a simulated clock, in one thread");
  command->add_flag("--json", options->json, "Print the summary as JSON");
  command->add_flag("--verbose", options->verbose, kVerboseHelp);
  command->add_option("--lcm", options->lcm_url, "LCM address of the glove and the haptic server")
      ->capture_default_str()
      ->excludes(offline);
  CLI::Option* record = command->add_option("--record", options->record,
                                            "File for a recording, which 'glissade replay' repeats bit by bit");
  command->add_flag("--overwrite", options->overwrites, kOverwriteHelp)->needs(record);
  add_view_option(*command, options->view_port)->excludes(offline);
  command
      ->add_option(
          "--report", options->report,
          "Folder for a page, index.html, with the summary, the run in three dimensions, and plots of force, torque, "
          "lag (distance from the visible part to the pose to which the hand pulls it), contacts and states")
      ->take_last();
  add_strict_option(*command);
  add_quiet_option(*command);
  command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace glissade::apps
