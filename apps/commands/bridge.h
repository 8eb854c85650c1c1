#pragma once

/// The devices of `glissade bridge`.

#include <glissade/apps/commands/command.h>

namespace glissade::apps {

/// `glissade bridge dynamixel --config FILE|--preset NAME --port PORT [--baud N] [--board-port PORT] [--check]
/// [--list]`
void add_bridge_dynamixel(CLI::App& bridge, Command& chosen);

/// `glissade bridge opengloves --port PORT [--device N] [--side left|right] [--check] [--list]`
void add_bridge_opengloves(CLI::App& bridge, Command& chosen);

/// `glissade bridge haply [--service HOST:PORT] [--arm ID] [--handle ID] [--device N] [--side left|right] [--check]
/// [--list]`
void add_bridge_haply(CLI::App& bridge, Command& chosen);

}  // namespace glissade::apps
