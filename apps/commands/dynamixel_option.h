#pragma once

/// The glove of servos that a bridge joins and an emulator is.

#include <string>

#include <CLI/CLI.hpp>

#include <glissade/bridges/dynamixel_hand.h>

namespace glissade::apps {

struct DynamixelOption {
  std::string config;
  std::string preset;
  unsigned baud_rate = 0;  ///< 0: that of the configuration
};

/// --config, --preset, --baud.
void add_dynamixel_option(CLI::App& command, DynamixelOption& option);

/// Throws std::invalid_argument, naming file, line and key, or the option.
bridges::DynamixelHand read_hand(const DynamixelOption& option);

}  // namespace glissade::apps
