#include <algorithm>
#include <string>

#include <glissade/bridges/calibration_poses.h>

#include "calibration/degrees.h"

namespace glissade::bridges {
namespace {

// Chosen. A flat hand, a fist and spread fingers are much the same for all wearers. A fingertip can touch the thumb
// with joints that are bent in many ways.
constexpr double kExact = radians(10.0);
constexpr double kVague = radians(25.0);

constexpr std::array<std::string_view, 4> kFingerNames{"index", "middle", "ring", "little"};

struct ThumbDegrees {
  double roll;
  double mcp;
  double ip;
  double abduction;
};

struct FingerDegrees {
  double mcp;
  double pip;
  double dip;
};

void set(CalibrationPose& pose, std::string_view joint, double degrees) {
  const auto* const found = std::find(hands::kJointNames.begin(), hands::kJointNames.end(), joint);
  pose.angles[static_cast<std::size_t>(found - hands::kJointNames.begin())] = radians(degrees);
}

void set(CalibrationPose& pose, const ThumbDegrees& thumb) {
  set(pose, "thumb_roll", thumb.roll);
  set(pose, "thumb_mcp", thumb.mcp);
  set(pose, "thumb_ip", thumb.ip);
  set(pose, "thumb_index_abduction", thumb.abduction);
}

void set(CalibrationPose& pose, std::string_view name, const FingerDegrees& finger) {
  set(pose, std::string(name) + "_mcp", finger.mcp);
  set(pose, std::string(name) + "_pip", finger.pip);
  set(pose, std::string(name) + "_dip", finger.dip);
}

CalibrationPose with_all_fingers(std::string_view name, std::string_view guidance, const ThumbDegrees& thumb,
                                 const FingerDegrees& fingers) {
  CalibrationPose pose{name, guidance, kExact, {}};
  set(pose, thumb);
  for (const std::string_view finger : kFingerNames)
    set(pose, finger, fingers);
  return pose;
}

CalibrationPose thumb_to(std::string_view finger, std::string_view name, std::string_view guidance,
                         const ThumbDegrees& thumb, const FingerDegrees& bent) {
  CalibrationPose pose{name, guidance, kVague, {}};
  set(pose, thumb);
  set(pose, finger, bent);
  return pose;
}

CalibrationPose flat() {
  CalibrationPose pose = with_all_fingers("flat",
                                          "Lay the hand flat on a table, fingers straight and side by side, the thumb "
                                          "half spread, the wrist straight.",
                                          {-20, 0, 0, 50}, {0, 0, 0});
  for (const std::string_view joint : {"middle_index_abduction", "ring_middle_abduction", "little_ring_abduction",
                                       "palm_arch", "wrist_flexion", "wrist_abduction"})
    set(pose, joint, 0);
  return pose;
}

/// The palm bends, or the thumb would not reach the tip.
CalibrationPose thumb_to_little() {
  CalibrationPose pose =
      thumb_to("little", "thumb to little", "Touch the tip of the little finger with the tip of the thumb.",
               {60, 46, 6, 48}, {18, 71, 42});
  set(pose, "palm_arch", 15);
  return pose;
}

/// The angles of the widest spread are chosen.
CalibrationPose spread() {
  CalibrationPose pose =
      with_all_fingers("spread", "Lay the hand flat on a table, and spread fingers and thumb as far as they go.",
                       {-20, 0, 0, 60}, {0, 0, 0});
  set(pose, "middle_index_abduction", 20);
  set(pose, "ring_middle_abduction", 15);
  set(pose, "little_ring_abduction", 15);
  return pose;
}

}  // namespace

const std::array<CalibrationPose, kCalibrationPoses>& calibration_poses() {
  static const std::array<CalibrationPose, kCalibrationPoses> poses{
      flat(),
      with_all_fingers("fist", "Make a fist, the thumb over the fingers.", {57, 50, 70, 23}, {80, 100, 70}),
      thumb_to("index", "thumb to index",
               "Touch the tip of the index with the tip of the thumb, so that they form a ring.", {44, 9, 8, 41},
               {52, 52, 21}),
      thumb_to("middle", "thumb to middle", "Touch the tip of the middle finger with the tip of the thumb.",
               {60, 11, 7, 43}, {56, 55, 21}),
      thumb_to("ring", "thumb to ring", "Touch the tip of the ring finger with the tip of the thumb.", {60, 28, 6, 42},
               {41, 66, 31}),
      thumb_to_little(),
      spread()};
  return poses;
}

hands::JointValues posture_of(const CalibrationPose& pose) {
  hands::JointValues angles{};
  std::transform(pose.angles.begin(), pose.angles.end(), angles.begin(),
                 [](const std::optional<double>& angle) { return angle.value_or(0.0); });
  return angles;
}

}  // namespace glissade::bridges
