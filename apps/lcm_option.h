#pragma once

/// The option --lcm of the commands that talk to another process.

#include <string>

namespace glissade::apps {

/// Throws std::invalid_argument, naming the option, when `lcm_url` does not reach other processes.
void check_reaches_other_processes(const std::string& lcm_url);

}  // namespace glissade::apps
