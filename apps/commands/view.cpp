#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include <glissade/apps/commands/command.h>
#include <glissade/apps/commands/size_warnings.h>
#include <glissade/apps/files/hand_trajectory_file.h>
#include <glissade/apps/open_files.h>
#include <glissade/apps/run/lcm_option.h>
#include <glissade/apps/run/status_line.h>
#include <glissade/apps/run/stop_signal.h>
#include <glissade/apps/say.h>
#include <glissade/apps/scene/embedded_scene.h>
#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/apps/text.h>
#include <glissade/apps/usage.h>
#include <glissade/apps/view/session_view.h>
#include <glissade/apps/view/viewed_parts.h>
#include <glissade/devices/event_log.h>
#include <glissade/devices/lcm_glove.h>
#include <glissade/viewer/view_server.h>
#include <glissade/viewer/view_simulation.h>

namespace glissade::apps {

namespace {

constexpr const char* kViewDescription = "Show a running scene in a browser, from the states of a haptic server";

constexpr const char* kViewFooter =
    "Receives HAPTIC_STATE, which 'glissade run', 'record' and 'demo' publish at their LCM address, and serves a page\n"
    "on this machine. SCENE must be the scene of the server. The default is the scene of 'glissade demo'. The command\n"
    "sends nothing to the server, so it disturbs no hand. 'run', 'demo' and 'replay' have their own page with --view.\n"
    "If no state has come after 5 s or at the end, a line on standard error says so.\n"
    "\n"
    "Examples, with the files of 'glissade example' and a demonstration as the server:\n"
    "  glissade demo --seconds 10 --lcm 'udpm://239.255.76.67:7667?ttl=0' & glissade view --seconds 10\n"
    "  glissade view car_door.yaml --seconds 10 --port 8500 --lcm 'udpm://239.255.76.67:7667?ttl=0'";

struct ViewOptions {
  std::string scene;
  LcmAddress lcm;
  std::uint16_t port = kViewPort;
  double seconds = 0.0;
  std::vector<std::int64_t> devices{devices::kDefaultDevice};
  bool fingers = false;
  std::string hand_file;
};

/// What has come from the server so far.
struct Received {
  std::atomic<std::int64_t> states{0};
  std::atomic<bool> has_unreadable{false};
  std::mutex mutex;
  std::string doubt;  // why it has another scene
};

/// What is wrong with the states of the server; empty if nothing is.
std::string doubt_of(Received& received) {
  if (received.has_unreadable)
    return "the states of the server cannot be read: they come from another version of glissade";
  const std::lock_guard lock(received.mutex);
  return received.doubt;
}

/// Why the page shows nothing, and what to start.
std::string told_of_silence(const devices::LcmBus& bus, const LcmAddress& lcm) {
  if (bus.refused_packets() > 0)
    return "packets are refused: they come from another machine or interface, or have another key";
  return "no server has been heard on HAPTIC_STATE at " + lcm.url + "; start one, such as: glissade demo --lcm '" +
         lcm.url + "'" + (lcm.key_file.empty() ? "" : " --key-file " + lcm.key_file);
}

int view(const ViewOptions& options) {
  const Scene file =
      read_or_embedded_scene(options.scene, options.fingers ? Demonstration::kDoorModule : Demonstration::kCarDoor);
  for (const std::string& sentence : doubtful_objects(file))
    warn(sentence);
  std::shared_ptr<const grasping::HandModel> model;
  if (options.fingers) {
    const grasping::HandShape shape =
        options.hand_file.empty() ? grasping::HandShape{} : read_hand_shape(options.hand_file);
    model = std::make_shared<const grasping::HandModel>(grasping::make_hand(shape));
  }
  viewer::ViewScene scene{.title = file.source, .objects = viewer::shown_objects(file, movable_objects(file))};
  const ViewedParts parts(file);
  for (const std::int64_t device : options.devices)
    scene.hands.push_back({"glove " + std::to_string(device), model});
  const std::shared_ptr<devices::LcmBus> bus = open_bus(options.lcm);
  const StopSignal stop_signal;
  const std::unique_ptr<viewer::ViewServer> server = open_view(std::move(scene), options.port, "--port");
  Received received;
  const auto subscription = bus->subscribe("HAPTIC_STATE", [&](std::span<const std::uint8_t> bytes) {
    const auto state = devices::haptic_state_of({.channel = "HAPTIC_STATE", .message = {bytes.begin(), bytes.end()}});
    if (!state) {
      received.has_unreadable = true;
      return;
    }
    if (std::string doubt = parts.doubt(*state); !doubt.empty()) {
      const std::lock_guard lock(received.mutex);
      received.doubt = std::move(doubt);
    }
    ++received.states;
    server->push(*state);
  });
  StatusLine line;
  line.say("glissade view: " + server->url() + " shows the states of a server at " + options.lcm.url + "; Ctrl-C ends");
  bool has_warned = false;
  bool has_told_of_silence = false;
  const auto start = std::chrono::steady_clock::now();
  const auto passed_s = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  const auto is_over = [&] {
    return StopSignal::requested() || (options.seconds > 0.0 && passed_s() > options.seconds);
  };
  const auto tell_if_silent = [&] {
    if (received.states > 0 || received.has_unreadable || std::exchange(has_told_of_silence, true)) return;
    line.say("glissade view: " + told_of_silence(*bus, options.lcm));
  };
  while (!is_over()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    constexpr double kSilence_s = 5.0;
    if (passed_s() > kSilence_s) tell_if_silent();
    if (const std::string doubt = doubt_of(received); !has_warned && !doubt.empty()) {
      has_warned = true;
      line.say("glissade view: " + doubt);
    }
    line.show(received.states == 0 ? "waiting for a server" : std::to_string(received.states) + " states");
  }
  tell_if_silent();
  return 0;
}

}  // namespace

void add_view_command(CLI::App& app, Command& chosen) {
  const auto options = std::make_shared<ViewOptions>();
  CLI::App* command = app.add_subcommand("view", kViewDescription);
  command->footer(kViewFooter);
  command->add_option("SCENE", options->scene, "Scene file (YAML) of the server");
  add_lcm_options(*command, options->lcm);
  command
      ->add_option_function<std::string>(
          "--port", [options](const std::string& text) { options->port = parse_port("--port", text); },
          "Port on 127.0.0.1 for the page; 0: any free port")
      ->type_name("PORT")
      ->default_str(std::to_string(kViewPort));
  command->add_option("--seconds", options->seconds, "Duration in seconds; 0: until Ctrl-C")
      ->check(not_negative())
      ->capture_default_str();
  command->add_option("--device", options->devices, "Numbers of the server's gloves, in the server's order")
      ->check(glove_number())
      ->capture_default_str();
  CLI::Option* fingers = command->add_flag("--fingers", options->fingers, "The server runs with --fingers: show hands");
  command->add_option("--hand", options->hand_file, "Hand file (YAML), as for 'glissade run'")->needs(fingers);
  add_strict_option(*command);
  command->callback([options, &chosen] { chosen = [options] { return view(*options); }; });
}

}  // namespace glissade::apps
