#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>
#include <stdexcept>

#include <glissade/apps/commands/bridge_options.h>
#include <glissade/apps/run/machine_check.h>
#include <glissade/apps/run/status_line.h>
#include <glissade/apps/run/stop_signal.h>
#include <glissade/apps/usage.h>
#include <glissade/bridges/bridge.h>
#include <glissade/bridges/serial_ports.h>
#include <glissade/realtime/periodic_thread.h>

namespace glissade::apps {

namespace {

bool goes_on() {
  return !StopSignal::requested();
}

}  // namespace

void add_bridge_options(CLI::App& command, BridgeOptions& options, const std::string& what) {
  command.add_flag("--list", options.lists, "List the devices or ports that can be found, and end");
  command.add_flag("--check", options.checks, "Print what the device sends, or what is wrong, and end");
  command.add_option("--side", options.side, "Hand that holds or wears the device")
      ->check(one_of({"left", "right"}))
      ->capture_default_str();
  add_device_option(command, options.device);
  add_lcm_options(command, options.lcm);
  command.add_option("--position-m", options.position_m, "Position of " + what + " in the world, X Y Z")
      ->expected(3)
      ->capture_default_str();
  command.add_option("--orientation-wxyz", options.orientation_wxyz, "Orientation of " + what + ", a unit quaternion")
      ->expected(4)
      ->capture_default_str();
  command.add_option("--seconds", options.seconds, "Duration in seconds; 0: until Ctrl-C")->capture_default_str();
}

void add_port_options(CLI::App& command, BridgeOptions& options, const std::string& ports) {
  command.add_option("--port", options.address, ports);
  add_calibration_option(command, options.link);
  add_pose_options(command, options.link);
  add_bridge_options(command, options, "the hand root");
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

void require_port(const BridgeOptions& options) {
  if (options.address.empty()) throw std::invalid_argument("--port is missing: --list shows the ports of this machine");
}

int list_serial_ports() {
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

int run_check(const Check& check) {
  const StopSignal stop_signal;
  StatusLine line;
  return check(goes_on, [&line](const std::string& sentence) { line.say("glissade bridge: " + sentence); }) ? 0 : 1;
}

int run_bridge(const BridgeOptions& options, const BridgedDevice& device) {
  const StopSignal stop_signal;
  StatusLine line;
  const auto say = [&line](const std::string& sentence) { line.say("glissade bridge: " + sentence); };
  const hands::HandSide side = options.side == "left" ? hands::HandSide::kLeft : hands::HandSide::kRight;
  bridges::BridgeOptions bridge{.link = link_options(options.link, options.device, side), .X_WH = pose_of(options)};
  bridge.link.patience_periods = device.patience_periods;
  const bool has_locked_memory = realtime::lock_memory();
  const bool has_fifo = realtime::schedule_this_thread(realtime::kLinkPriority).is_fifo;
  const std::string missing = missing_rights(has_fifo, has_locked_memory);
  if (!missing.empty()) say(missing);
  const std::shared_ptr<devices::LcmBus> bus = open_bus(options.lcm);
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  Clock::time_point shown = start;
  const auto goes_on_and_shows = [&] {
    const Clock::time_point now = Clock::now();
    constexpr std::chrono::milliseconds kStatus{100};
    if (now - shown > kStatus) {
      shown = now;
      line.show(device.status());
    }
    const bool is_over = options.seconds > 0.0 && now - start > std::chrono::duration<double>(options.seconds);
    return goes_on() && !is_over;
  };
  say("glove " + std::to_string(options.device) + ", the " + options.side + " hand, at " + options.address +
      ", for servers at " + options.lcm.url);
  const bridges::BridgeStatistics statistics = bridges::run_bridge(device.wire, bus, bridge, goes_on_and_shows, say);
  line.show({});
  const bool is_free = device.is_free();
  std::cout << "glissade bridge: " << statistics.states << " states, the wire failed " << statistics.errors
            << " times; " << (is_free ? device.let_go : "the device was not reached at the end: switch it off") << '\n';
  return is_free ? 0 : 1;
}

}  // namespace glissade::apps
