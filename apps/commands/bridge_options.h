#pragma once

/// What the bridges to devices with a port have in common: their options, and a run.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <glissade/apps/commands/glove_link_options.h>
#include <glissade/apps/run/lcm_option.h>
#include <glissade/bridges/wire.h>
#include <glissade/devices/lcm_glove.h>

namespace glissade::apps {

struct BridgeOptions {
  std::string port;
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

/// --port, --list, --check, --side, --device, --lcm, --calibration, --pose-from, --pose-rate-hz, --position-m,
/// --orientation-wxyz, --seconds.
void add_bridge_options(CLI::App& command, BridgeOptions& options);

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
  std::function<std::string()> status;  ///< the text of the status line
  std::function<bool()> is_free;        ///< the device has been told to let go of the hand
};

/// Runs the bridge until Ctrl-C or --seconds, and returns the exit code: 1 if the hand may not be free at the end.
/// Throws std::invalid_argument for a pose that is none.
int run_bridge(const BridgeOptions& options, const BridgedDevice& device);

}  // namespace glissade::apps
