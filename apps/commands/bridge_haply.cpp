#include <iostream>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include <glissade/apps/commands/bridge.h>
#include <glissade/apps/commands/bridge_options.h>
#include <glissade/apps/text.h>
#include <glissade/bridges/haply_check.h>
#include <glissade/bridges/haply_wire.h>

namespace glissade::apps {

namespace {

constexpr const char* kHaplyBridge = "Connect an Inverse3 of Haply, with or without a VerseGrip";

constexpr const char* kHaplyBridgeFooter =
    "The bridge talks to Haply's Inverse Service, version 3.1 or later. The service must run on this machine, or at\n"
    "the address --service. --list shows the devices of the service. The tip of the arm is a hand without fingers. A\n"
    "VerseGrip gives the orientation of the hand. The hand is closed, and holds the nearest part, while a button of\n"
    "the VerseGrip is pressed. Without a VerseGrip, the hand is always closed.\n"
    "--position-m and --orientation-wxyz give the pose of the device. Its X axis points to the right, Y forward and Z\n"
    "up. Its origin is at the mounting plate.\n"
    "The service lets go of the hand when the bridge is silent, ends or is killed. See docs/devices.md in the "
    "sources.\n"
    "\n"
    "Examples, with an emulated service:\n"
    "  glissade emulate haply --port 10101 --seconds 4 & glissade bridge haply --service localhost:10101 --seconds 4\n"
    "A hand takes the peg and drops it into its hole:\n"
    "  glissade run square_peg.yaml --seconds 9 & glissade emulate haply --port 10102 --script square_peg_script.csv "
    "--seconds 9 & glissade bridge haply --service localhost:10102 --seconds 9";

struct HaplyBridgeOptions {
  BridgeOptions bridge{.address = "localhost"};
  std::string arm;
  std::string handle;
};

std::string force_text(const Eigen::Vector3d& force) {
  return fixed_text(force.norm(), 2) + " N";
}

std::string status_of(const bridges::HaplyTraffic& traffic) {
  if (traffic.states == 0) return "waiting for the device";
  std::string text = std::to_string(traffic.states) + " states, force " + force_text(traffic.f_H_W);
  if (traffic.exerted_H_W) text += ", exerted " + force_text(*traffic.exerted_H_W);
  if (!traffic.handle) text += ", no VerseGrip";
  if (traffic.refused > 0) text += ", " + std::to_string(traffic.refused) + " messages refused";
  return text;
}

int list_devices(const std::string& service) {
  bool is_empty = true;
  bridges::list_haply_devices(service, [&](const std::string& text) {
    is_empty = false;
    std::cout << text << '\n';
  });
  if (is_empty) std::cout << "the service has no device: is one plugged in, and on?\n";
  return 0;
}

int run(const HaplyBridgeOptions& options) {
  if (options.bridge.lists) return list_devices(options.bridge.address);
  const bridges::HaplyOptions wire_options{
      .service = options.bridge.address, .arm = options.arm, .handle = options.handle, .X_WD = pose_of(options.bridge)};
  if (options.bridge.checks)
    return run_check(
        [&](const auto& goes_on, const auto& say) { return bridges::check_haply(wire_options, goes_on, say); });
  bridges::HaplyWire wire(wire_options);
  return run_bridge(options.bridge, {.wire = wire,
                                     .status = [&wire] { return status_of(wire.traffic()); },
                                     .is_free = [] { return true; },  // the service lets go in silence
                                     .let_go = "the force is off"});
}

}  // namespace

void add_bridge_haply(CLI::App& bridge, Command& chosen) {
  const auto options = std::make_shared<HaplyBridgeOptions>();
  CLI::App* command = bridge.add_subcommand("haply", kHaplyBridge);
  command->footer(kHaplyBridgeFooter);
  command->add_option("--service", options->bridge.address, "Address of the service, HOST or HOST:PORT")
      ->capture_default_str();
  command->add_option("--arm", options->arm, "Id of the Inverse3, if there are several");
  command->add_option("--handle", options->handle, "Id of the VerseGrip, if there are several");
  add_bridge_options(*command, options->bridge, "the device");
  command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace glissade::apps
