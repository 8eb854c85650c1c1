#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>

#include <glissade/apps/command.h>
#include <glissade/apps/haptic_scene.h>
#include <glissade/apps/haptic_session.h>
#include <glissade/apps/html_report.h>
#include <glissade/apps/lcm_option.h>
#include <glissade/apps/say.h>
#include <glissade/apps/scene_file.h>
#include <glissade/apps/stop_signal.h>
#include <glissade/apps/text.h>

namespace glissade::apps {

namespace {

constexpr const char* kRunDescription = "Run the haptic server: receive glove states over LCM and send forces";

constexpr const char* kRunFooter =
    "The part in the hand is the only movable object of the scene. When the first glove state arrives on the channel\n"
    "GLOVE_STATE, the hand grasps the part rigidly; the part stays at its pose in the scene. Commands to the glove\n"
    "go out on GLOVE_COMMAND. The state of every tick, i.e. of every cycle of the haptic loop, goes out on\n"
    "HAPTIC_STATE, for viewers and loggers. When the force fades, because the glove's state is old for instance, the\n"
    "reason goes to standard error: docs/safety.md in the sources.\n"
    "\n"
    "The run ends --seconds after the first glove state, or with Ctrl-C, and prints a summary. Then brute force\n"
    "checks the visible poses, i.e. the poses at which the part was shown; without --seconds, only those of the last\n"
    "minute are checked. If a pose collides, the exit code is 1.\n"
    "Keys of --json: docs/file_formats.md in the sources.\n"
    "\n"
    "Example, with a simulated glove in a second terminal:\n"
    "  glissade run examples/scenes/car_door.yaml --lcm 'udpm://239.255.76.67:7667?ttl=0' --seconds 12\n"
    "  glissade glove --lcm 'udpm://239.255.76.67:7667?ttl=0'";

struct RunOptions {
  std::string scene;
  LcmAddress lcm;
  std::int64_t device = devices::kDefaultDevice;
  double seconds = 0.0;
  double rate_hz = 0.0;
  bool json = false;
  std::string report;
};

int run(const RunOptions& options) {
  if (!(options.seconds >= 0.0 && options.seconds <= 86400.0)) {
    throw std::invalid_argument("--seconds: must lie between 0 and 86400, not " + format_number(options.seconds));
  }
  if (options.rate_hz != 0.0 && !(options.rate_hz >= 500.0 && options.rate_hz <= 5000.0)) {
    throw std::invalid_argument("--rate-hz: must lie between 500 and 5000, not " + format_number(options.rate_hz));
  }
  RunSettings settings{.device = options.device, .seconds = options.seconds};
  if (options.rate_hz != 0.0) settings.period = std::chrono::nanoseconds(std::llround(1e9 / options.rate_hz));
  const std::shared_ptr<devices::LcmBus> bus = open_bus(options.lcm);
  const Scene file = read_scene(options.scene);
  const HapticScene scene = make_haptic_scene(file, only_movable_object(file));
  if (!options.report.empty()) prepare_report_folder(options.report);
  const StopSignal stop_signal;
  // Announced from within the session, after its set-up has succeeded.
  bool said_that_it_waits = false;
  bool said_that_it_refuses = false;
  bool said_that_it_holds = false;
  const auto watch = [&](std::int64_t ticks, const std::string& news) {
    if (ticks == 0 && !std::exchange(said_that_it_waits, true)) {
      say("glissade run: waiting for a glove at " + options.lcm.url);
    }
    if (ticks == 0 && bus->refused_packets() > 0 && !std::exchange(said_that_it_refuses, true)) {
      say("glissade run: packets are refused: they come from elsewhere, or were made with another key");
    }
    if (ticks > 0 && !std::exchange(said_that_it_holds, true)) {
      say("glissade run: the glove holds '" + scene.part_name + "'");
    }
    if (!news.empty()) say("glissade run: " + news);
  };
  const Session session = run_session(scene, bus, settings, &StopSignal::requested, watch);
  conclude(session, scene, "glissade run: " + scene.part_name, options.json, options.report);
  return 0;
}

}  // namespace

void add_run_command(CLI::App& app, Command& chosen) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App* command = app.add_subcommand("run", kRunDescription);
  command->footer(std::string(kRunFooter) + kSceneFileHelp);
  command->add_option("SCENE", options->scene, "Scene file (YAML)")->required();
  add_lcm_options(*command, options->lcm);
  add_device_option(*command, options->device);
  command->add_option("--seconds", options->seconds, "Duration in seconds from the first glove state; 0: until Ctrl-C")
      ->capture_default_str();
  command->add_option("--rate-hz", options->rate_hz,
                      "Rate of the haptic loop, 500 to 5000 ticks a second; default: that of the glove");
  command->add_flag("--json", options->json, "Print the summary as JSON");
  command->add_option("--report", options->report,
                      "Folder for a page, index.html, with the summary and plots of force, lag (distance from the "
                      "visible part to the pose that the hand asks for) and states");
  command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace glissade::apps
