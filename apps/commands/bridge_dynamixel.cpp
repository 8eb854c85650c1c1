#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>

#include <glissade/apps/commands/bridge.h>
#include <glissade/apps/commands/bridge_options.h>
#include <glissade/apps/commands/dynamixel_option.h>
#include <glissade/apps/text.h>
#include <glissade/bridges/dynamixel_check.h>
#include <glissade/bridges/dynamixel_hand.h>
#include <glissade/bridges/serial_stream.h>

namespace glissade::apps {

namespace {

constexpr const char* kDynamixelBridge = "Connect a glove of Dynamixel servos, such as the DOGlove";

constexpr const char* kDynamixelBridgeFooter =
    "The port, such as /dev/ttyUSB0, leads to a bus of XL330 or XC330 servos. A YAML file (--config) says which servo\n"
    "drives which joint, and at which servo angle the joint angle is 0. --preset doglove is such a file for the\n"
    "DOGlove. The zero angles differ from glove to glove. To adapt them, copy bridges/presets/doglove.yaml of the\n"
    "sources, hold the hand flat, and write into the copy the angles that --check shows. Each servo holds the limit\n"
    "of its joint in its own loop, so a finger stops at objects of 'glissade run --fingers'. The torque of a servo is\n"
    "off while its finger is free, and while the server or the bridge is silent. If the bridge is killed, a second\n"
    "process turns the torques off. The hand stays at --position-m and --orientation-wxyz, or follows a tracker\n"
    "(--pose-from).\n"
    "\n"
    "Examples, with an emulated glove:\n"
    "  glissade bridge dynamixel --list\n"
    "  glissade emulate dynamixel --preset doglove --link servos --board-link board --seconds 4 & glissade bridge "
    "dynamixel --preset doglove --port servos --board-port board --seconds 4\n"
    "A hand closes round the ball, and its fingers stop there:\n"
    "  glissade emulate dynamixel --preset doglove --link servos --board-link board & glissade bridge dynamixel "
    "--preset doglove --port servos --board-port board --position-m -0.095 0 0.1 & glissade run ball_and_tray.yaml "
    "--fingers --seconds 8";

struct DynamixelBridge {
  BridgeOptions bridge;
  DynamixelOption hand;
  std::string board_port;
};

bridges::DynamixelHand hand_of(const DynamixelBridge& options) {
  bridges::DynamixelHand hand = read_hand(options.hand);
  require_port(options.bridge);
  if (!options.board_port.empty()) hand.board_port = options.board_port;
  if (!hand.measured.empty() && hand.board_port.empty())
    throw std::invalid_argument("--board-port is missing: the glove has joints that a measuring board measures");
  return hand;
}

std::string status_of(const bridges::DynamixelHand& hand, const bridges::DynamixelTraffic& traffic) {
  std::string text;
  for (std::size_t i = 0; i < hand.servos.size(); ++i) {
    const std::string angle =
        std::isfinite(traffic.angles[i]) ? fixed_text(traffic.angles[i] * 180.0 / std::numbers::pi, 0) + "°" : "?";
    text += (text.empty() ? "" : ", ") +
            std::string(hands::kJointNames[static_cast<std::size_t>(hand.servos[i].joint)]) + " " + angle +
            (traffic.holds[i] ? " held" : "");
  }
  return text + "; " + std::to_string(traffic.missing_answers) + " answers missing";
}

int run(const DynamixelBridge& options) {
  if (options.bridge.lists) return list_serial_ports();
  const bridges::DynamixelHand hand = hand_of(options);
  const std::string& port = options.bridge.address;
  if (options.bridge.checks)
    return run_check(
        [&](const auto& goes_on, const auto& say) { return bridges::check_dynamixel(hand, port, goes_on, say); });
  const auto line = [](const std::string& of, double baud_rate) {
    return std::make_shared<bridges::SerialStream>(of, static_cast<unsigned>(baud_rate));
  };
  const auto board = hand.measured.empty() ? nullptr : line(hand.board_port, bridges::kMeasuringBoardBaudRate);
  const auto wire = bridges::make_dynamixel_wire(hand, line(port, hand.baud_rate), board);
  return run_bridge(options.bridge, {.wire = *wire,
                                     .status = [&] { return status_of(hand, wire->traffic()); },
                                     .is_free = [&] { return wire->traffic().is_free; }});
}

}  // namespace

void add_bridge_dynamixel(CLI::App& bridge, Command& chosen) {
  const auto options = std::make_shared<DynamixelBridge>();
  CLI::App* command = bridge.add_subcommand("dynamixel", kDynamixelBridge);
  command->footer(kDynamixelBridgeFooter);
  add_dynamixel_option(*command, options->hand);
  add_port_options(*command, options->bridge, "Serial port, or tcp:HOST:PORT");
  command->add_option("--board-port", options->board_port, "Serial port of the measuring board");
  command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace glissade::apps
