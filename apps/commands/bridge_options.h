#pragma once

/// What the bridges have in common: options, and a run.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>

#include <glissade/apps/commands/glove_link_options.h>
#include <glissade/apps/run/lcm_option.h>
#include <glissade/bridges/wire.h>
#include <glissade/devices/lcm_glove.h>

namespace glissade::apps {

struct BridgeOptions {
  std::string address;  ///< where the device is: a port or a service
  bool lists = false;
  bool checks = false;
  std::string side = "right";
  LcmAddress lcm;
  std::int64_t device = devices::kDefaultDevice;
  GloveLinkOptions link;
  std::vector<double> position_m{0.0, 0.0, 0.0};
  std::vector<double> orientation_wxyz{1.0, 0.0, 0.0, 0.0};
  double seconds = 0.0;
};

/// --list, --check, --side, --device, --lcm, --position-m, --orientation-wxyz, --seconds. `what` has the pose, such as
/// "the hand root".
void add_bridge_options(CLI::App& command, BridgeOptions& options, const std::string& what);
/// The same for a glove at a port, with --port, --calibration, --pose-from and --pose-rate-hz. `ports` is the help of
/// --port.
void add_port_options(CLI::App& command, BridgeOptions& options, const std::string& ports);

/// The pose of the two options. Throws std::invalid_argument, naming the option, if it is none.
Eigen::Isometry3d pose_of(const BridgeOptions& options);

/// Throws std::invalid_argument without --port.
void require_port(const BridgeOptions& options);

/// --list: prints the serial ports of this machine. Returns the exit code.
int list_serial_ports();

/// --check: calls `check` with whether it goes on, and with where its sentences go. `check` returns whether all is
/// well. Returns the exit code.
using Check = std::function<bool(const std::function<bool()>&, const std::function<void(const std::string&)>&)>;
int run_check(const Check& check);

/// A device at its bridge, for people.
struct BridgedDevice {
  bridges::Wire& wire;
  double patience_periods = devices::LcmGloveHostOptions{}.patience_periods;
  std::function<std::string()> status;          ///< the text of the status line
  std::function<bool()> is_free;                ///< the device has been told to let go of the hand
  const char* let_go = "the fingers are free";  ///< what is said if it has
};

/// Runs the bridge until Ctrl-C or --seconds, in real time where the rights permit it. Returns the exit code: 1 if the
/// hand may not be free at the end. Throws std::invalid_argument if the quaternion of the pose has another norm than 1,
/// or if a number is not finite.
int run_bridge(const BridgeOptions& options, const BridgedDevice& device);

}  // namespace glissade::apps
