#include <chrono>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>

#include <glissade/apps/commands/bridge.h>
#include <glissade/apps/run/lcm_option.h>
#include <glissade/apps/run/status_line.h>
#include <glissade/apps/run/stop_signal.h>
#include <glissade/apps/text.h>
#include <glissade/apps/usage.h>
#include <glissade/bridges/bridge.h>
#include <glissade/bridges/opengloves_check.h>
#include <glissade/bridges/opengloves_wire.h>
#include <glissade/bridges/serial_ports.h>

namespace glissade::apps {

namespace {

constexpr const char* kOpenGlovesBridge = "Join a glove with the firmware of LucidGloves, or another OpenGloves glove";

constexpr const char* kOpenGlovesBridgeFooter =
    "The port is a serial port such as /dev/ttyUSB0 (USB) or /dev/rfcomm0 (Bluetooth), or tcp:HOST for a glove in the\n"
    "network (port 65432, or tcp:HOST:PORT). The bridge finds the encoding, 'alpha' or 'legacy', by itself. The glove\n"
    "measures the fingers only: the hand stays at --position-m and --orientation-wxyz. After its start, the firmware\n"
    "scales its numbers to what it has seen, so open and close all fingers once.\n"
    "The fingers stop where an object stops the visible hand of 'glissade run --fingers'. There is no force on the\n"
    "hand. The servos are released when the server, the glove's states or the bridge are silent, or the bridge ends,\n"
    "even if it is killed. See docs/devices.md in the sources.\n"
    "\n"
    "Examples, with an emulated glove:\n"
    "  glissade emulate opengloves --link glove_port --seconds 4 & glissade bridge opengloves --port glove_port "
    "--seconds 4\n"
    "A hand closes round the ball, and its fingers stop there:\n"
    "  glissade emulate opengloves --link glove_port & glissade bridge opengloves --port glove_port --position-m "
    "-0.095 "
    "0 0.1 & glissade run ball_and_tray.yaml --fingers --seconds 8";

struct BridgeOptions {
  std::string port;
  bool lists = false;
  bool checks = false;
  std::string side = "right";
  LcmAddress lcm;
  std::int64_t device = devices::kDefaultDevice;
  std::vector<double> position_m{0.0, 0.0, 0.0};
  std::vector<double> orientation_wxyz{1.0, 0.0, 0.0, 0.0};
  double full_scale = 4095.0;
  double seconds = 0.0;
};

int list_ports() {
  const std::vector<bridges::SerialPort> ports = bridges::serial_ports();
  for (const bridges::SerialPort& port : ports) {
    std::cout << port.path;
    if (!port.device.empty()) std::cout << "  " << port.device;
    if (!port.lasting.empty()) std::cout << "  " << port.lasting;
    std::cout << '\n';
    if (!port.trouble.empty()) std::cout << "    " << port.trouble << '\n';
  }
  if (ports.empty())
    std::cout << "no serial port: no USB adapter (/dev/ttyUSB*, /dev/ttyACM*) and no Bluetooth port (/dev/rfcomm*; "
                 "'rfcomm bind 0 ADDRESS' makes one)\n";
  return 0;
}

Eigen::Isometry3d pose_of(const BridgeOptions& options) {
  const std::vector<double>& q = options.orientation_wxyz;
  const Eigen::Quaterniond orientation(q[0], q[1], q[2], q[3]);
  if (!(std::abs(orientation.norm() - 1.0) < 1e-3))
    throw std::invalid_argument("--orientation-wxyz: the norm of the quaternion must be 1");
  Eigen::Isometry3d pose(orientation.normalized());
  pose.translation() = Eigen::Vector3d(options.position_m[0], options.position_m[1], options.position_m[2]);
  if (!pose.matrix().allFinite()) throw std::invalid_argument("--position-m: must be finite");
  return pose;
}

bridges::OpenGlovesOptions wire_options(const BridgeOptions& options) {
  if (options.port.empty()) throw std::invalid_argument("--port is missing: --list shows the ports of this machine");
  if (!(options.full_scale >= 1.0)) throw std::invalid_argument("--full-scale: must be 1 or more");
  bridges::OpenGlovesOptions wire{.port = options.port, .X_WH = pose_of(options)};
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

int run(const BridgeOptions& options) {
  if (options.lists) return list_ports();
  const bridges::OpenGlovesOptions wire_options = apps::wire_options(options);
  const StopSignal stop_signal;
  const auto goes_on = [] { return !StopSignal::requested(); };
  StatusLine line;
  const auto say = [&line](const std::string& sentence) { line.say("glissade bridge: " + sentence); };
  if (options.checks) return bridges::check_opengloves(wire_options, goes_on, say) ? 0 : 1;

  bridges::OpenGlovesWire wire(wire_options);  // before there are other threads: it forks
  const std::shared_ptr<devices::LcmBus> bus = open_bus(options.lcm);
  const hands::HandSide side = options.side == "left" ? hands::HandSide::kLeft : hands::HandSide::kRight;
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  Clock::time_point shown = start;
  const auto goes_on_and_shows = [&] {
    const Clock::time_point now = Clock::now();
    constexpr std::chrono::milliseconds kStatus{100};
    if (now - shown > kStatus) {
      shown = now;
      line.show(status_of(wire.traffic()));
    }
    const bool is_over = options.seconds > 0.0 && now - start > std::chrono::duration<double>(options.seconds);
    return goes_on() && !is_over;
  };
  say("glove " + std::to_string(options.device) + ", the " + options.side + " hand, at " + options.port +
      ", for servers at " + options.lcm.url);
  const bridges::BridgeStatistics statistics =
      bridges::run_bridge(wire, bus, {.link = {.device = options.device, .side = side}}, goes_on_and_shows, say);
  line.show({});
  const bool is_free = wire.traffic().is_free;
  std::cout << "glissade bridge: " << statistics.states << " states, the wire failed " << statistics.errors
            << " times; "
            << (is_free ? "the fingers are free\n" : "the glove was not reached at the end: switch it off\n");
  return is_free ? 0 : 1;
}

}  // namespace

void add_bridge_opengloves(CLI::App& bridge, Command& chosen) {
  const auto options = std::make_shared<BridgeOptions>();
  CLI::App* command = bridge.add_subcommand("opengloves", kOpenGlovesBridge);
  command->footer(kOpenGlovesBridgeFooter);
  command->add_option("--port", options->port, "Serial port, or tcp:HOST or tcp:HOST:PORT");
  command->add_flag("--list", options->lists, "List the serial ports of this machine, and end");
  command->add_flag("--check", options->checks, "Say what arrives at the port or what is wrong, and end");
  command->add_option("--side", options->side, "Hand that wears the glove")
      ->check(one_of({"left", "right"}))
      ->capture_default_str();
  add_device_option(*command, options->device);
  add_lcm_options(*command, options->lcm);
  command->add_option("--position-m", options->position_m, "Position of the hand root in the world, X Y Z")
      ->expected(3)
      ->capture_default_str();
  command
      ->add_option("--orientation-wxyz", options->orientation_wxyz, "Orientation of the hand root, a unit quaternion")
      ->expected(4)
      ->capture_default_str();
  command
      ->add_option("--full-scale", options->full_scale,
                   "Number of a closed finger: 4095 of an ESP32, 1023 of an Arduino Nano")
      ->capture_default_str();
  command->add_option("--seconds", options->seconds, "Time after which the bridge ends; 0: with Ctrl-C")
      ->capture_default_str();
  command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace glissade::apps
