#include <chrono>
#include <iostream>
#include <memory>
#include <string>
#include <thread>

#include <CLI/CLI.hpp>

#include <glissade/apps/command.h>
#include <glissade/apps/embedded_scene.h>
#include <glissade/apps/lcm_option.h>
#include <glissade/apps/progress.h>
#include <glissade/apps/stop_signal.h>
#include <glissade/apps/text.h>
#include <glissade/apps/trajectory_file.h>
#include <glissade/devices/simulated_glove_service.h>

namespace glissade::apps {

namespace {

constexpr const char* kGloveDescription = "Simulate a force-feedback glove in a process of its own";

constexpr const char* kGloveFooter =
    "Script: columns t_s,x_m,y_m,z_m,qw,qx,qy,qz. Each row is a time and the pose X_WH of the hand root, the frame\n"
    "whose pose the glove reports; times increase. Without --script, the hand follows the script of the car door\n"
    "demonstration. The hand waits at the first pose until a haptic server ('glissade run') sends a command, and\n"
    "yields to the forces that it receives. The process ends at the end of the script, or with Ctrl-C.\n"
    "\n"
    "Example, with 'glissade run' in another terminal:\n"
    "  glissade glove --lcm 'udpm://239.255.76.67:7667?ttl=0' --script hand.csv";

struct GloveOptions {
  std::string side = "right";
  std::string lcm_url = "udpm://239.255.76.67:7667?ttl=0";
  std::string script;
};

int run(const GloveOptions& options) {
  check_reaches_other_processes(options.lcm_url);
  const geometry::PoseTrajectory script = options.script.empty()
                                              ? parse_trajectory(embedded_scene_script(), "car_door_script.csv")
                                              : read_trajectory(options.script);
  const StopSignal stop_signal;
  const auto bus = std::make_shared<devices::LcmBus>(options.lcm_url);
  realtime::SteadyClock clock;
  devices::SimulatedGloveService glove(bus, devices::SimulatedGlove(script), clock);

  std::cerr << "glissade glove: the " << options.side << " hand waits for a server at " << options.lcm_url << '\n';
  const auto milliseconds = [](std::chrono::nanoseconds time) { return time / std::chrono::milliseconds(1); };
  {
    ProgressBar progress("script", milliseconds(script.duration()));
    while (glove.script_time() < script.duration() && !StopSignal::requested()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      progress.update(milliseconds(glove.script_time()));
    }
  }
  glove.stop();
  const devices::LinkStatistics link = glove.link_statistics();
  std::cout << "glissade glove: " << milliseconds(glove.script_time()) << " ms of the script, " << link.accepted
            << " commands (" << link.lost << " lost, " << link.rejected() << " refused), greatest force "
            << format_number(glove.greatest_force()) << " N\n";
  return 0;
}

}  // namespace

void add_glove_command(CLI::App& app, Command& chosen) {
  const auto options = std::make_shared<GloveOptions>();
  CLI::App* command = app.add_subcommand("glove", kGloveDescription);
  command->footer(kGloveFooter);
  command->add_option("--side", options->side, "Hand that wears the glove")
      ->check(CLI::IsMember({"left", "right"}))
      ->capture_default_str();
  command->add_option("--lcm", options->lcm_url, "LCM address that glove and haptic server share")
      ->capture_default_str();
  command->add_option("--script", options->script, "Trajectory of the hand root (CSV), see below");
  command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace glissade::apps
