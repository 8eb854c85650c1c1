// OpenXR hand tracking tells a glove that measures the fingers only where the hand is. Here, a stand-in for
// xrLocateHandJointsEXT gives the joints, so that the example needs neither a runtime nor a headset.

#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>

#include <glissade/devices/hand_pose.h>
#include <glissade/devices/lcm_bus.h>
#include <glissade/grasping/hand_conversions.h>

using namespace glissade;

// As XrHandJointLocationEXT has them, but a quaternion of OpenXR is x, y, z, w.
grasping::OpenXrJoints located_joints(const grasping::HandModel& hand) {
  grasping::HandPose pose;
  pose.X_WR = Eigen::Translation3d(0.1, 1.2, -0.4) * Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitY());
  return grasping::to_openxr(hand, pose);
}

int main() {
  const grasping::HandModel hand = grasping::make_hand();
  // The space A of the application: x to the right, y up, z backwards. The world W of scenes: x forwards, z up.
  Eigen::Isometry3d X_WA = Eigen::Isometry3d::Identity();
  X_WA.linear() << 0, 0, -1, -1, 0, 0, 0, 1, 0;

  const auto bus = std::make_shared<devices::LcmBus>("memq://");  // between programs: "udpm://..."
  devices::HandPosePublisher tracker(bus, 1);
  devices::HandPoseSource bridge(bus, {.device = 1, .rate_Hz = 90.0});  // what `glissade bridge --pose-from lcm` has
  devices::TrackedPose pose;
  devices::GloveState state;
  while (!bridge.join(state)) {
    const grasping::OpenXrJoints joints = located_joints(hand);
    pose.is_valid = true;  // isActive, and the flags of the joints: position and orientation valid and tracked
    pose.X_WT = X_WA * grasping::from_openxr(hand, joints).X_WR;
    ++pose.sequence;
    pose.time = std::chrono::steady_clock::now().time_since_epoch();
    tracker.publish(pose);
    std::this_thread::sleep_for(std::chrono::milliseconds(11));
  }
  const Eigen::Vector3d p = state.X_WH.translation();
  std::printf("the hand is at %.1f %.1f %.1f m\n", p.x(), p.y(), p.z());
}
