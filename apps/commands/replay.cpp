#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <glissade/apps/commands/command.h>
#include <glissade/apps/durations.h>
#include <glissade/apps/open_files.h>
#include <glissade/apps/record/glove_player.h>
#include <glissade/apps/record/offline_replay.h>
#include <glissade/apps/record/replay_audiences.h>
#include <glissade/apps/report/html_report.h>
#include <glissade/apps/run/lcm_option.h>
#include <glissade/apps/run/status_line.h>
#include <glissade/apps/run/stop_signal.h>
#include <glissade/apps/text.h>
#include <glissade/apps/view/session_view.h>

namespace glissade::apps {

namespace {

constexpr const char* kReplayDescription =
    "Repeat a recorded run bit by bit, or send the states of its gloves to a server";

constexpr const char* kReplayFooter =
    "LOG is a file of 'glissade record' or 'glissade demo --record'. If LOG consists of several joined logs, all runs\n"
    "are repeated. Offline, each tick of the haptic loop and each answer of the simulation is repeated from the\n"
    "recorded input, and must give the same bytes. If a result differs, the error names it, and the exit code is 1.\n"
    "If the log is damaged, only its part before the damage is repeated, and the exit code is 1. The scene must not\n"
    "have changed.\n"
    "\n"
    "With --lcm, the command sends the states of the recorded gloves to another server. The gloves wait for the first\n"
    "command of this server, move at the recorded pace, and do not yield to forces. Any log with GLOVE_INFO and\n"
    "GLOVE_STATE can be used, such as a log of lcm-logger.\n"
    "With --view, a browser shows the run at the recorded pace.\n"
    "For the keys of --json, see docs/file_formats.md in the sources.\n"
    "\n"
    "Examples:\n"
    "  glissade demo --seconds 3 --record run.lcmlog && glissade replay run.lcmlog\n"
    "  glissade demo --offline --seconds 2 --record offline.lcmlog && glissade replay offline.lcmlog --json\n"
    "  glissade demo --offline --seconds 2 --record door.lcmlog && glissade replay door.lcmlog --report report\n"
    "With the files of 'glissade example' and the log of 'glissade demo --seconds 3 --record demo.lcmlog', the\n"
    "recorded glove leads the hand of a server:\n"
    "  glissade run car_door.yaml --seconds 2 & glissade replay demo.lcmlog --lcm 'udpm://239.255.76.67:7667?ttl=0'";

struct ReplayOptions {
  std::string log;
  std::string scene;
  LcmAddress lcm{.url = "", .key_file = ""};
  std::optional<std::uint16_t> view_port;
  std::string report;
  bool json = false;
};

/// Repeats the run for its audience, if there is one. `page` becomes the path of the report, if there is one.
ReplayOutcome repeat_for_audience(const ReplayOptions& options, std::string& page) {
  if (options.view_port) {
    const StopSignal stop_signal;
    ReplayView view(*options.view_port);
    return replay_offline(options.log, options.scene, &view);
  }
  if (options.report.empty()) return replay_offline(options.log, options.scene, nullptr);
  prepare_report_folder(options.report);
  ReplayReport report("glissade replay: " + options.log);
  ReplayOutcome outcome = replay_offline(options.log, options.scene, &report);
  page = report.write(options.report);
  return outcome;
}

int repeat(const ReplayOptions& options) {
  std::string page;
  const ReplayOutcome outcome = repeat_for_audience(options, page);
  const double speed = in_seconds(outcome.recorded) / in_seconds(outcome.elapsed);
  if (options.json) {
    const nlohmann::json json{{"runs", outcome.runs},
                              {"ticks", outcome.ticks},
                              {"contact_sets", outcome.contact_sets},
                              {"recorded_s", in_seconds(outcome.recorded)},
                              {"elapsed_s", in_seconds(outcome.elapsed)},
                              {"speed", speed},
                              {"same", outcome.is_same()},
                              {"difference", outcome.difference},
                              {"damage", outcome.damage}};
    std::cout << json.dump(2) << '\n';
  } else {
    std::cout << "glissade replay: " << (outcome.runs > 1 ? std::to_string(outcome.runs) + " runs, " : "")
              << outcome.ticks << " ticks and " << outcome.contact_sets << " contact sets of "
              << fixed_text(in_seconds(outcome.recorded), 3) << " s are bit-identical, " << fixed_text(speed, 1)
              << " times as fast as the recorded run\n";
    if (!page.empty()) std::cout << "report: " << page << '\n';
  }
  if (!outcome.difference.empty()) throw std::runtime_error(options.log + ": " + outcome.difference);
  if (!outcome.damage.empty()) throw std::runtime_error(outcome.damage);
  return 0;
}

int play(const ReplayOptions& options) {
  const std::shared_ptr<devices::LcmBus> bus = open_bus(options.lcm);
  std::string damage;
  const std::vector<GloveTrack> tracks = read_glove_tracks(options.log, damage);
  const double duration_s = in_seconds(duration_of(tracks));
  const StopSignal stop_signal;
  StatusLine line;
  line.say("glissade replay: " + std::to_string(tracks.size()) +
           (tracks.size() == 1 ? " glove waits" : " gloves wait") + " for a server at " + options.lcm.url);
  const std::vector<PlayedGlove> played =
      play_gloves(tracks, bus, &StopSignal::requested, [&](std::chrono::nanoseconds time) {
        line.show(fixed_text(in_seconds(time), 1) + " s of " + fixed_text(duration_s, 1) + " s");
      });
  line.show({});
  nlohmann::json gloves = nlohmann::json::array();
  for (const PlayedGlove& glove : played) {
    gloves.push_back({{"device", glove.device},
                      {"states", glove.states},
                      {"commands", glove.commands},
                      {"force_max_N", glove.greatest_force_N}});
    if (options.json) continue;
    std::cout << "glissade replay: glove " << glove.device << ": " << glove.states << " states, " << glove.commands
              << " commands, greatest force " << fixed_text(glove.greatest_force_N, 2) << " N\n";
  }
  if (options.json) std::cout << nlohmann::json{{"gloves", gloves}, {"damage", damage}}.dump(2) << '\n';
  if (!damage.empty()) throw std::runtime_error(damage);
  return 0;
}

}  // namespace

void add_replay_command(CLI::App& app, Command& chosen) {
  const auto options = std::make_shared<ReplayOptions>();
  CLI::App* command = app.add_subcommand("replay", kReplayDescription);
  command->footer(kReplayFooter);
  command->add_option("LOG", options->log, "Event log of LCM")->required();
  CLI::Option* scene = command->add_option("--scene", options->scene, "Scene file instead of the recorded one");
  add_lcm_options(*command, options->lcm);
  command->get_option("--lcm")->excludes(scene);
  CLI::Option* view = add_view_option(*command, options->view_port);
  view->excludes("--lcm");
  command
      ->add_option("--report", options->report,
                   "Folder for a page, index.html, as from 'glissade run', of the last minute of the recording")
      ->take_last()
      ->excludes(view)
      ->excludes("--lcm");
  command->add_flag("--json", options->json, "Print the outcome as JSON");
  add_strict_option(*command);
  command->callback([options, &chosen] {
    chosen = [options] { return options->lcm.url.empty() ? repeat(*options) : play(*options); };
  });
}

}  // namespace glissade::apps
