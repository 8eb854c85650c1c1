#include <memory>
#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>

#include <glissade/apps/commands/bridge.h>
#include <glissade/apps/commands/bridge_options.h>
#include <glissade/apps/text.h>
#include <glissade/bridges/opengloves_check.h>
#include <glissade/bridges/opengloves_wire.h>

namespace glissade::apps {

namespace {

constexpr const char* kOpenGlovesBridge =
    "Connect a glove with the firmware of LucidGloves, or another OpenGloves glove";

constexpr const char* kOpenGlovesBridgeFooter =
    "--port is a serial port such as /dev/ttyUSB0 (USB) or /dev/rfcomm0 (Bluetooth). For a glove in the network, it\n"
    "is tcp:HOST (with the TCP port 65432) or tcp:HOST:PORT. The bridge finds the encoding, 'alpha' or 'legacy', by\n"
    "itself. The glove measures the fingers only, so the hand stays at --position-m and --orientation-wxyz, or\n"
    "follows a tracker (--pose-from). The firmware scales its numbers to the range that it has seen since its start,\n"
    "so open and close all fingers once.\n"
    "The fingers stop where an object stops the visible hand of 'glissade run --fingers'. There is no force on the\n"
    "hand. The servos are released if the server, the glove or the bridge is silent, and if the bridge ends or is\n"
    "killed. See docs/devices.md in the sources.\n"
    "\n"
    "Examples, with an emulated glove:\n"
    "  glissade emulate opengloves --link glove_port --seconds 4 & glissade bridge opengloves --port glove_port "
    "--seconds 4\n"
    "A hand closes round the ball, and its fingers stop there:\n"
    "  glissade emulate opengloves --link glove_port & glissade bridge opengloves --port glove_port --position-m "
    "-0.095 0 0.1 & glissade run ball_and_tray.yaml --fingers --seconds 8";

struct OpenGlovesBridge {
  BridgeOptions bridge;
  double full_scale = 4095.0;
};

bridges::OpenGlovesOptions wire_options(const OpenGlovesBridge& options) {
  require_port(options.bridge);
  if (!(options.full_scale >= 1.0)) throw std::invalid_argument("--full-scale: must be 1 or more");
  bridges::OpenGlovesOptions wire{.port = options.bridge.address};
  for (bridges::SensorRange& sensor : wire.sensors)
    sensor.closed = options.full_scale;
  return wire;
}

std::string status_of(const bridges::OpenGlovesTraffic& traffic) {
  if (!traffic.encoding) return "waiting for the glove";
  std::string text = std::to_string(traffic.states) + " states, curls";
  for (const double curl : traffic.curls)
    text += " " + fixed_text(curl, 2);
  text += ", limits";
  for (const int limit : traffic.limits)
    text += limit == 0 ? " free" : " " + fixed_text(1.0 - limit / 1000.0, 2);
  return text;
}

int run(const OpenGlovesBridge& options) {
  if (options.bridge.lists) return list_serial_ports();
  const bridges::OpenGlovesOptions wire_options = apps::wire_options(options);
  if (options.bridge.checks)
    return run_check(
        [&](const auto& goes_on, const auto& say) { return bridges::check_opengloves(wire_options, goes_on, say); });
  bridges::OpenGlovesWire wire(wire_options);  // before there are other threads: it forks
  return run_bridge(options.bridge, {.wire = wire,
                                     .patience_periods = bridges::kOpenGlovesPatience_periods,
                                     .status = [&] { return status_of(wire.traffic()); },
                                     .is_free = [&] { return wire.traffic().is_free; }});
}

}  // namespace

void add_bridge_opengloves(CLI::App& bridge, Command& chosen) {
  const auto options = std::make_shared<OpenGlovesBridge>();
  CLI::App* command = bridge.add_subcommand("opengloves", kOpenGlovesBridge);
  command->footer(kOpenGlovesBridgeFooter);
  add_port_options(*command, options->bridge, "Serial port, or tcp:HOST or tcp:HOST:PORT");
  command
      ->add_option("--full-scale", options->full_scale,
                   "Number that a closed finger gives: 4095 on an ESP32, 1023 on an Arduino Nano")
      ->capture_default_str();
  command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace glissade::apps
