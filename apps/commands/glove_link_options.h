#pragma once

/// The options --calibration, --pose-from and --pose-rate-hz of commands that drive a glove.

#include <cstdint>
#include <string>

#include <glissade/devices/lcm_glove.h>
#include <glissade/hands/hand.h>

namespace CLI {
class App;
}

namespace glissade::apps {

struct GloveLinkOptions {
  std::string calibration;
  std::string pose_from;
  double pose_rate_Hz = 60.0;
};

void add_calibration_option(CLI::App& command, GloveLinkOptions& options);
/// The two options of a tracker, for gloves that do not measure the pose of the hand.
void add_pose_options(CLI::App& command, GloveLinkOptions& options);

/// Throws std::invalid_argument, naming the option, or what `read_calibration` throws.
devices::LcmGloveHostOptions link_options(const GloveLinkOptions& options, std::int64_t device, hands::HandSide side);

}  // namespace glissade::apps
