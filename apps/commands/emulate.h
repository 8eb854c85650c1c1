#pragma once

/// The devices of `glissade emulate`.

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <glissade/apps/commands/command.h>
#include <glissade/bridges/emulator.h>

namespace glissade::apps {

/// What all emulated devices have in common.
struct EmulateOptions {
  std::vector<std::string> faults;
  std::uint64_t seed = 1;
  double seconds = 0.0;

  bool has_fault(std::string_view name) const;
};

/// What may be wrong with a line that carries bytes.
inline const std::vector<std::string> kLineFaults{"garbage", "cut", "wrong-bits", "echo", "slow", "unplug"};

/// --fault with these names, --seed, --seconds.
void add_emulate_options(CLI::App& command, EmulateOptions& options,
                         const std::vector<std::string>& faults = kLineFaults);

/// The faults of the line that --fault names. `share` is that of the packets or lines with each fault, `slowness` that
/// of a slow device.
bridges::LineFaults line_faults(const EmulateOptions& options, double share, std::chrono::nanoseconds slowness);

/// Something of a device that goes and comes back, such as its plug.
struct LoosePart {
  const char* fault;              ///< the name in --fault
  const char* gone;               ///< what is said when it goes
  const char* back;               ///< what is said when it comes back
  std::function<void(bool)> set;  ///< called with whether it is there
};

/// An emulated device that runs.
struct RunningEmulator {
  std::vector<LoosePart> loose;
  std::function<std::string()> status;  ///< the text of the status line
};

/// The plug of a device with these two functions.
template <typename Emulator>
LoosePart plug_of(Emulator& emulator) {
  return {"unplug", "unplugged", "plugged in",
          [&emulator](bool is_in) { is_in ? emulator.plug() : emulator.unplug(); }};
}

/// Lets it run until Ctrl-C or --seconds. Loose parts go and come back at random if that is a fault.
void run_emulator(const EmulateOptions& options, const RunningEmulator& emulator);

/// `glissade emulate dynamixel --config FILE|--preset NAME [--link PATH] [--board-link PATH] [--fault ...]`
void add_emulate_dynamixel(CLI::App& emulate, Command& chosen);

/// `glissade emulate haply [--port N] [--script FILE] [--fault NAME...]`
void add_emulate_haply(CLI::App& emulate, Command& chosen);

/// `glissade emulate opengloves [--link PATH|--tcp PORT] [--encoding alpha|legacy] [--fault ...]`
void add_emulate_opengloves(CLI::App& emulate, Command& chosen);

}  // namespace glissade::apps
