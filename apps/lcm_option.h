#pragma once

/// The options --lcm and --device of the commands that talk to another process.

#include <cstdint>
#include <string>

namespace CLI {
class App;
}

namespace glissade::apps {

/// Adds --device, the number of a glove.
void add_device_option(CLI::App& command, std::int64_t& device);

/// Throws std::invalid_argument, naming the option, when `lcm_url` does not reach other processes.
void check_reaches_other_processes(const std::string& lcm_url);

}  // namespace glissade::apps
