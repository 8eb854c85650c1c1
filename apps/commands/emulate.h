#pragma once

/// The devices of `glissade emulate`.

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <glissade/apps/commands/command.h>
#include <glissade/bridges/emulator.h>

namespace glissade::apps {

/// What all emulated devices have in common.
struct EmulateOptions {
  std::vector<std::string> faults;
  std::uint64_t seed = 1;
  double seconds = 0.0;
};

/// --fault, --seed, --seconds.
void add_emulate_options(CLI::App& command, EmulateOptions& options);

/// The faults of the line that --fault names. `share` is that of the packets or lines with each fault, `slowness` that
/// of a slow device.
bridges::LineFaults line_faults(const EmulateOptions& options, double share, std::chrono::nanoseconds slowness);

/// An emulated device that runs.
struct RunningEmulator {
  std::function<void(bool)> set_plugged;
  std::function<std::string()> status;  ///< the text of the status line
};

/// Lets it run until Ctrl-C or --seconds, and pulls its plug at random if that is a fault.
void run_emulator(const EmulateOptions& options, const RunningEmulator& emulator);

/// `glissade emulate dynamixel --config FILE|--preset NAME [--link PATH] [--board-link PATH] [--fault ...]`
void add_emulate_dynamixel(CLI::App& emulate, Command& chosen);

/// `glissade emulate haply [--port N] [--script FILE] [--fault NAME...]`
void add_emulate_haply(CLI::App& emulate, Command& chosen);

/// `glissade emulate opengloves [--link PATH|--tcp PORT] [--encoding alpha|legacy] [--fault ...]`
void add_emulate_opengloves(CLI::App& emulate, Command& chosen);

/// `glissade emulate tracker --script FILE [--device N] [--rate-hz R]`
void add_emulate_tracker(CLI::App& emulate, Command& chosen);

}  // namespace glissade::apps
