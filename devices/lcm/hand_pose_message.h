#pragma once

/// Conversion between poses of trackers and bytes on the wire. Every received message is checked here before it is
/// used.

#include <cstdint>
#include <span>
#include <vector>

#include <glissade/devices/hand_pose.h>

#include "lcm/link_monitor.h"

namespace glissade::devices {

inline constexpr const char* kHandPoseChannel = "HAND_POSE";

struct PoseHeader {
  std::int64_t device = 0;   ///< number of the glove to which the pose belongs
  std::int64_t session = 0;  ///< of the sender
};

std::vector<std::uint8_t> encode(const PoseHeader& header, const TrackedPose& pose);

/// Decodes and checks a message. With any result other than kNone, the output is unchanged. Never throws, for any
/// bytes. The velocities are zero if the tracker does not measure them. A pose that is not valid is not read.
DecodeResult decode(std::span<const std::uint8_t> bytes, PoseHeader& header, TrackedPose& pose) noexcept;

}  // namespace glissade::devices
