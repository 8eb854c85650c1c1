#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include <glissade/apps/commands/command.h>
#include <glissade/apps/commands/scene_warnings.h>
#include <glissade/apps/files/hand_trajectory_file.h>
#include <glissade/apps/files/scene_file.h>
#include <glissade/apps/open_files.h>
#include <glissade/apps/progress.h>
#include <glissade/apps/record/dump_signal.h>
#include <glissade/apps/report/html_report.h>
#include <glissade/apps/run/lcm_option.h>
#include <glissade/apps/run/status_line.h>
#include <glissade/apps/run/stop_signal.h>
#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/apps/session/haptic_session.h>
#include <glissade/apps/text.h>
#include <glissade/apps/view/session_view.h>
#include <glissade/files/file_checks.h>
#include <glissade/realtime/periodic_thread.h>

namespace glissade::apps {

namespace {

constexpr const char* kRunDescription = "Run the haptic server: receive glove states over LCM and send forces";

constexpr const char* kRunFooter =
    "The parts are the movable objects of the scene. When the first state of a glove arrives on the channel\n"
    "GLOVE_STATE, the hand grasps a part rigidly. The part stays at its pose in the scene. The first glove takes the\n"
    "first part. The second glove takes the second part or, if there is only one part, the same part. --hold chooses\n"
    "other parts. If the glove reports its grip, a hand that opens lets go, and a hand that closes takes the nearest\n"
    "part. Parts that no hand holds do not move. With --fingers, hands grasp the parts round which their fingers\n"
    "close, without any gesture. The joint angles of the gloves move the fingers, and the fingers feel contacts. From\n"
    "the first state on, objects with 'moves: FILE' follow their own scripts.\n"
    "The server sends commands to the gloves on GLOVE_COMMAND. For viewers and loggers, it sends the state of every\n"
    "tick, i.e. of every cycle of the haptic loop, on HAPTIC_STATE. When a force fades, for example because a glove's\n"
    "state is old, the server prints the reason to standard error (see docs/safety.md in the sources).\n"
    "\n"
    "The run ends --seconds after the first glove state, or with Ctrl-C, and prints a summary. Then brute force\n"
    "checks the visible poses, i.e. the poses at which parts and hands with fingers were shown. Without --seconds,\n"
    "only the poses of the last minute are checked. If a pose collides, the exit code is 1.\n"
    "For the keys of --json, see docs/file_formats.md in the sources.\n"
    "\n"
    "Examples, with the files of 'glissade example' and a simulated glove:\n"
    "  glissade glove --script square_peg_script.csv & glissade run square_peg.yaml --seconds 4\n"
    "  glissade glove --fingers & glissade run door_module.yaml --fingers --seconds 9\n"
    "Two gloves; the second holds nothing:\n"
    "  glissade glove --script square_peg_script.csv & glissade glove --device 2 & glissade run square_peg.yaml "
    "--device 1 2 --hold 2= --seconds 4";

constexpr const char* kRecordDescription = "Run the haptic server and record the run, for 'glissade replay'";

constexpr const char* kRecordFooter =
    "Runs as 'glissade run' does. LOG is an event log of LCM, which lcm-logplayer and lcm-logplayer-gui can play. It\n"
    "has the time, inputs and results of each tick and each answer of the simulation. It has no commands to gloves,\n"
    "so playing it moves no glove. 'glissade replay LOG' repeats the run bit by bit. 'glissade replay LOG --lcm URL'\n"
    "sends the states of the recorded gloves to a server. 'glissade log to-csv LOG FOLDER' makes tables of the log.\n"
    "The command replaces an older LOG only with --overwrite.\n"
    "\n"
    "Examples, with the files of 'glissade example' and a simulated glove:\n"
    "  glissade glove --script square_peg_script.csv & glissade record peg.lcmlog square_peg.yaml --seconds 4\n"
    "  glissade demo --seconds 3 --record door_again.lcmlog";

struct RunOptions {
  std::string command = "glissade run";
  std::string scene;
  LcmAddress lcm;
  std::vector<std::int64_t> devices{devices::kDefaultDevice};
  std::vector<std::string> holds;
  bool fingers = false;
  std::vector<std::string> hand_files;
  SlidingChoice choice;
  double seconds = 0.0;
  double rate_hz = 0.0;
  double spin_us = 0.0;
  bool json = false;
  bool verbose = false;
  std::string report;
  RecordSettings record;
  std::optional<std::uint16_t> view_port;
};

/// The gloves and the parts that their hands take.
std::vector<SessionHand> hands_of(const RunOptions& options, const HapticScene& scene) {
  std::vector<SessionHand> hands;
  for (const std::int64_t device : options.devices) {
    for (const SessionHand& hand : hands) {
      if (hand.device != device) continue;
      throw std::invalid_argument("--device: glove " + std::to_string(device) + " is named twice");
    }
    SessionHand hand{.device = device, .part = std::min(hands.size(), scene.parts.size() - 1)};
    if (options.fingers) hand = {.device = device, .part = std::nullopt, .fingers = grasping::HandShape{}};
    hands.push_back(hand);
  }
  if (hands.size() > hands::kMaxHands) {
    throw std::invalid_argument("--device: " + std::to_string(hands.size()) + " gloves are too many: at most " +
                                std::to_string(hands::kMaxHands) + " can be used");
  }
  for (const std::string& hold : options.holds) {
    const std::size_t equals = hold.find('=');
    const std::string device = hold.substr(0, equals);
    const auto hand = std::find_if(hands.begin(), hands.end(), [&](const SessionHand& candidate) {
      return std::to_string(candidate.device) == device;
    });
    if (equals == std::string::npos || hand == hands.end()) {
      throw std::invalid_argument("--hold: " + in_quotes(hold) +
                                  " is not GLOVE=PART with a glove of --device, such as 1=motor");
    }
    const std::string part = hold.substr(equals + 1);
    hand->part = scene.part_number(part);
    if (part.empty() || hand->part) continue;
    throw std::invalid_argument("--hold: " + in_quotes(hold) + ": the movable objects of " + scene.source + " are " +
                                scene.part_names());
  }
  return hands;
}

/// The hands of --hand, one for all gloves or one for each.
void take_shapes(const RunOptions& options, std::vector<SessionHand>& hands) {
  if (options.hand_files.empty()) return;
  if (options.hand_files.size() > 1 && options.hand_files.size() != hands.size()) {
    throw std::invalid_argument("--hand: " + std::to_string(options.hand_files.size()) + " files for " +
                                std::to_string(hands.size()) + " gloves; give one for all, or one for each");
  }
  for (std::size_t h = 0; h < hands.size(); ++h)
    hands[h].fingers = read_hand_shape(options.hand_files[std::min(h, options.hand_files.size() - 1)]);
}

std::string held_text(const RunSettings& settings, const HapticScene& scene) {
  std::string text;
  for (const SessionHand& hand : settings.hands) {
    text += text.empty() ? "" : ", ";
    text += settings.hands.size() == 1 ? "the glove" : "glove " + std::to_string(hand.device);
    text += hand.fingers ? " grasps with its fingers"
                         : " holds " + (hand.part ? in_quotes(scene.parts[*hand.part].name) : "nothing");
  }
  return text;
}

/// Says each thing once, after the set-up of the session has succeeded.
class Announcer {
 public:
  Announcer(const RunOptions& options, const RunSettings& settings, const HapticScene& scene,
            const devices::LcmBus& bus)
      : settings_(settings), scene_(scene), bus_(bus), url_(options.lcm.url), prefix_(options.command + ": ") {}

  void tell(const RunNews& news) {
    if (news.awaited_device && news.awaited_device != told_to_await_) {
      told_to_await_ = news.awaited_device;
      const bool is_only = settings_.hands.size() == 1;
      line_.say(prefix_ + "waiting for " + (is_only ? "a glove" : "glove " + std::to_string(*news.awaited_device)) +
                " at " + url_ + (settings_.view_port ? "; the page of --view opens after that" : ""));
    }
    if (news.ticks == 0 && bus_.refused_packets() > 0 && !std::exchange(said_that_it_refuses_, true)) {
      line_.say(prefix_ + "packets are refused: they come from another machine or interface, or have another key");
    }
    if (news.ticks > 0 && !std::exchange(said_that_it_holds_, true)) {
      line_.say(prefix_ + held_text(settings_, scene_));
    }
    for (const std::string& sentence : news.sentences)
      line_.say(prefix_ + sentence);
    line_.show(news.status);
  }

 private:
  const RunSettings& settings_;
  const HapticScene& scene_;
  const devices::LcmBus& bus_;
  std::string url_;
  std::string prefix_;
  std::optional<std::int64_t> told_to_await_;
  StatusLine line_;
  bool said_that_it_refuses_ = false;
  bool said_that_it_holds_ = false;
};

int run(const RunOptions& options) {
  if (!(options.seconds >= 0.0 && options.seconds <= 86400.0)) {
    throw std::invalid_argument("--seconds: must lie between 0 and 86400, not " + format_number(options.seconds));
  }
  if (options.rate_hz != 0.0 && !(options.rate_hz >= 500.0 && options.rate_hz <= 5000.0)) {
    throw std::invalid_argument("--rate-hz: must lie between 500 and 5000, not " + format_number(options.rate_hz));
  }
  if (!(options.spin_us >= 0.0 && options.spin_us <= 500.0)) {
    throw std::invalid_argument("--spin-us: must lie between 0 and 500, not " + format_number(options.spin_us));
  }
  realtime::lock_memory();
  const std::shared_ptr<devices::LcmBus> bus = open_bus(options.lcm);
  const Scene file = open_scene(options.scene);
  const HapticScene scene = make_haptic_scene(file, movable_objects(file));
  warn_of_scene(file, scene);
  RunSettings settings{.hands = hands_of(options, scene),
                       .choice = options.choice,
                       .seconds = options.seconds,
                       .spin = std::chrono::nanoseconds(std::llround(1e3 * options.spin_us)),
                       .record = options.record,
                       .view_port = options.view_port};
  take_shapes(options, settings.hands);
  settings.record.scene_file = options.scene;
  if (options.rate_hz != 0.0) settings.period = std::chrono::nanoseconds(std::llround(1e9 / options.rate_hz));
  check_distinct({{"LOG", options.record.log},
                  {"--flight-recorder", options.record.flight},
                  {"--report", report_page(options.report)}});
  if (!options.report.empty()) prepare_report_folder(options.report);
  const StopSignal stop_signal;
  const DumpSignal dump_signal;
  Announcer announcer(options, settings, scene, *bus);
  const Session session =
      run_session(scene, bus, settings, &StopSignal::requested, [&](const RunNews& news) { announcer.tell(news); });
  conclude(session, scene, options.command + ": " + scene.part_names(), options.json, options.verbose, options.report);
  return 0;
}

/// Declares what `run` and `record` have in common.
void add_options(CLI::App& command_line, RunOptions& options) {
  command_line.add_option("SCENE", options.scene, "Scene file (YAML)")->required();
  add_lcm_options(command_line, options.lcm);
  command_line.add_option("--device", options.devices, "Numbers of the gloves, one for each hand, at most four")
      ->check(glove_number())
      ->capture_default_str();
  command_line.add_option("--hold", options.holds,
                          "GLOVE=PART: the part that the hand in this glove takes; GLOVE= for none");
  CLI::Option* fingers = command_line.add_flag("--fingers", options.fingers,
                                               "Hands grasp with their fingers; the gloves measure the joint angles");
  fingers->excludes("--hold");
  command_line
      .add_option("--hand", options.hand_files,
                  "Hand files (YAML), one for all gloves or one for each: side, length_m, breadth_m; default: a right "
                  "or left hand, as the glove reports, of 0.183 m and 0.084 m")
      ->needs(fingers);
  add_sliding_options(command_line, options.choice);
  add_strict_option(command_line);
  add_quiet_option(command_line);
  command_line
      .add_option("--seconds", options.seconds, "Duration in seconds from the first glove state; 0: until Ctrl-C")
      ->capture_default_str();
  command_line.add_option("--rate-hz", options.rate_hz,
                          "Rate of the haptic loop, 500 to 5000 ticks a second; default: the rate of the glove");
  command_line
      .add_option("--spin-us", options.spin_us,
                  "Time before each tick, 0 to 500 us, for which the haptic loop polls the clock instead of "
                  "sleeping, so that the tick starts on time; at most half of the period")
      ->capture_default_str();
  command_line.add_option("--flight-recorder", options.record.flight,
                          "File for the last seconds of the run, written when a glove or the simulation fails, and on "
                          "SIGUSR1. The names of later files get a number");
  add_view_option(command_line, options.view_port);
  command_line.add_flag("--json", options.json, "Print the summary as JSON");
  command_line.add_flag("--verbose", options.verbose, kVerboseHelp);
  command_line.add_option(
      "--report", options.report,
      "Folder for a page, index.html, with the summary, the run in three dimensions, and plots of force, "
      "torque, lag (distance from the visible part to the pose to which the hand pulls it), contacts "
      "and states");
}

}  // namespace

void add_run_command(CLI::App& app, Command& chosen) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App* command = app.add_subcommand("run", kRunDescription);
  command->footer(std::string(kRunFooter) + kSlidingChoiceHelp + kSceneFileHelp);
  add_options(*command, *options);
  command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

void add_record_command(CLI::App& app, Command& chosen) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App* command = app.add_subcommand("record", kRecordDescription);
  options->command = "glissade record";
  command->footer(std::string(kRecordFooter) + kSlidingChoiceHelp + kSceneFileHelp);
  command->add_option("LOG", options->record.log, "File for the recording")->required();
  command->add_flag("--overwrite", options->record.overwrites, kOverwriteHelp);
  add_options(*command, *options);
  command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace glissade::apps
