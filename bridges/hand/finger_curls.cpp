#include "hand/finger_curls.h"

#include <algorithm>
#include <cmath>

namespace glissade::bridges {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;
constexpr double kThumbRoll_deg = 57;  // opposite to the palm

constexpr std::size_t joint_of(std::string_view name) {
  return static_cast<std::size_t>(std::find(hands::kJointNames.begin(), hands::kJointNames.end(), name) -
                                  hands::kJointNames.begin());
}

constexpr CurlingJoint curling(std::size_t finger, std::string_view name, double open_deg, double closed_deg) {
  return {finger, joint_of(name), open_deg * kRadiansPerDegree, closed_deg * kRadiansPerDegree};
}

constexpr std::array<CurlingJoint, kFingers * kJointsOfFinger> kCurlingJoints{
    {curling(0, "thumb_mcp", -5, 50), curling(0, "thumb_ip", -5, 70), curling(0, "thumb_index_abduction", 50, 23),
     curling(1, "index_mcp", 0, 80), curling(1, "index_pip", 0, 100), curling(1, "index_dip", 0, 70),
     curling(2, "middle_mcp", 0, 80), curling(2, "middle_pip", 0, 100), curling(2, "middle_dip", 0, 70),
     curling(3, "ring_mcp", 0, 80), curling(3, "ring_pip", 0, 100), curling(3, "ring_dip", 0, 70),
     curling(4, "little_mcp", 0, 80), curling(4, "little_pip", 0, 100), curling(4, "little_dip", 0, 70)}};

}  // namespace

const std::array<CurlingJoint, kFingers * kJointsOfFinger>& curling_joints() noexcept {
  return kCurlingJoints;
}

hands::JointValues lower_angles() noexcept {
  hands::JointValues angles{};
  for (const CurlingJoint& joint : kCurlingJoints)
    angles[joint.joint] = std::min(joint.open, joint.closed);
  return angles;
}

hands::JointValues upper_angles() noexcept {
  hands::JointValues angles{};
  for (const CurlingJoint& joint : kCurlingJoints)
    angles[joint.joint] = std::max(joint.open, joint.closed);
  return angles;
}

hands::JointValues angles_of(const FingerValues& curls) noexcept {
  hands::JointValues angles{};
  angles[joint_of("thumb_roll")] = kThumbRoll_deg * kRadiansPerDegree;
  for (const CurlingJoint& joint : kCurlingJoints)
    angles[joint.joint] = std::lerp(joint.open, joint.closed, curls[joint.finger]);
  return angles;
}

}  // namespace glissade::bridges
