#pragma once

/// The numbers of a hand's links and flex values.

#include <array>
#include <cstddef>

namespace glissade::grasping {

/// Links of the wrist and the palm, and of the thumb.
inline constexpr std::size_t kForearm = 0;
inline constexpr std::size_t kWrist = 1;
inline constexpr std::size_t kPalmLink = 2;
inline constexpr std::size_t kThumbRoll = 3;
inline constexpr std::size_t kThumbMetacarpal = 4;
inline constexpr std::size_t kThumbProximal = 5;
inline constexpr std::size_t kThumbDistal = 6;

/// Links of a finger. `metacarpal` is the palm's link where the metacarpal does not move.
struct FingerLinks {
  std::size_t metacarpal;
  std::size_t knuckle;  ///< no mesh: abduction
  std::size_t proximal;
  std::size_t middle;
  std::size_t distal;
};

/// Index, middle, ring and little finger.
inline constexpr std::array<FingerLinks, 4> kFingerLinks{
    {{kPalmLink, 7, 8, 9, 10}, {kPalmLink, 11, 12, 13, 14}, {15, 16, 17, 18, 19}, {20, 21, 22, 23, 24}}};

/// Flex values, in the order of hands::kJointNames.
inline constexpr std::size_t kThumbRollValue = 0;
inline constexpr std::size_t kThumbMcpValue = 1;
inline constexpr std::size_t kThumbIpValue = 2;
inline constexpr std::size_t kThumbIndexValue = 3;
/// MCP of index, middle, ring and little finger; PIP and DIP follow.
inline constexpr std::array<std::size_t, 4> kMcpValues{4, 7, 11, 15};
inline constexpr std::size_t kMiddleIndexValue = 10;
inline constexpr std::size_t kRingMiddleValue = 14;
inline constexpr std::size_t kLittleRingValue = 18;
inline constexpr std::size_t kPalmArchValue = 19;
inline constexpr std::size_t kWristFlexionValue = 20;
inline constexpr std::size_t kWristAbductionValue = 21;
/// Those that bend the thumb or a finger towards the palm where they grow.
inline constexpr std::array<std::size_t, 14> kFlexionValues{1, 2, 4, 5, 6, 7, 8, 9, 11, 12, 13, 15, 16, 17};

}  // namespace glissade::grasping
