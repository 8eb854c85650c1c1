#pragma once

/// Converts hand poses from and to the 26 joints of OpenXR hand tracking. Also converts poses from the 24 joints of
/// recordings made with the Adroit hand, a simulated robot hand. Frames: W world, R root of the hand (`HandModel`).

#include <array>
#include <cstddef>
#include <string_view>

#include <Eigen/Geometry>

#include <glissade/base/export.h>
#include <glissade/grasping/hand_model.h>
#include <glissade/hands/hand.h>

namespace glissade::grasping {

/// The pose of a hand: its root, and its flex values in rad.
struct HandPose {
  Eigen::Isometry3d X_WR = Eigen::Isometry3d::Identity();
  hands::JointValues values{};
};

inline constexpr std::size_t kOpenXrJoints = 26;

/// The joints of XR_EXT_hand_tracking, in the order of that extension.
inline constexpr std::array<std::string_view, kOpenXrJoints> kOpenXrJointNames{"palm",
                                                                               "wrist",
                                                                               "thumb_metacarpal",
                                                                               "thumb_proximal",
                                                                               "thumb_distal",
                                                                               "thumb_tip",
                                                                               "index_metacarpal",
                                                                               "index_proximal",
                                                                               "index_intermediate",
                                                                               "index_distal",
                                                                               "index_tip",
                                                                               "middle_metacarpal",
                                                                               "middle_proximal",
                                                                               "middle_intermediate",
                                                                               "middle_distal",
                                                                               "middle_tip",
                                                                               "ring_metacarpal",
                                                                               "ring_proximal",
                                                                               "ring_intermediate",
                                                                               "ring_distal",
                                                                               "ring_tip",
                                                                               "little_metacarpal",
                                                                               "little_proximal",
                                                                               "little_intermediate",
                                                                               "little_distal",
                                                                               "little_tip"};

/// A joint of OpenXR and its frame. The origin is the joint nearer to the wrist, −z points along the bone to the tip,
/// and y points out of the back of the hand (for the thumb, out of the nail).
struct OpenXrJoint {
  Eigen::Isometry3d X_WOpenXr = Eigen::Isometry3d::Identity();
  double radius = 0.0;  ///< distance from the joint to the skin, m
};

using OpenXrJoints = std::array<OpenXrJoint, kOpenXrJoints>;

/// The OpenXR joints of a hand. The joint `wrist` is at the wrist, with the axes of the palm. The joint `palm` is in
/// the middle of the middle finger's metacarpal. Real-time safe; about 2 µs.
GLISSADE_EXPORT OpenXrJoints to_openxr(const HandModel& hand, const HandPose& pose) noexcept;

/// The pose of `hand` that is nearest to tracked joints. Uses the rotations of the joints and the position of the
/// wrist, so the bone lengths of the tracked hand do not matter. Each flex value is the least-squares angle of its
/// joint. For the thumb's metacarpal, the direction of the bone counts four times as much as the direction of the nail.
/// The poses of the joints must be rigid, so pass only joints that the runtime reports as tracked.
///
/// OpenXR has no forearm. So both wrist angles are 0, and R is the frame of the palm. Values may lie beyond the limits
/// (`KinematicChain::clamp`). The function is the inverse of `to_openxr` up to rounding if the wrist angles are 0.
/// Real-time safe; about 3 µs.
GLISSADE_EXPORT HandPose from_openxr(const HandModel& hand, const OpenXrJoints& joints) noexcept;

inline constexpr std::size_t kAdroitJoints = 24;

/// The joints of the Adroit hand in the order of its recordings: wrist; first, middle, ring and little finger; thumb.
inline constexpr std::array<std::string_view, kAdroitJoints> kAdroitJointNames{
    "WRJ1", "WRJ0", "FFJ3", "FFJ2", "FFJ1", "FFJ0", "MFJ3", "MFJ2", "MFJ1", "MFJ0", "RFJ3", "RFJ2",
    "RFJ1", "RFJ0", "LFJ4", "LFJ3", "LFJ2", "LFJ1", "LFJ0", "THJ4", "THJ3", "THJ2", "THJ1", "THJ0"};

/// The pose of a right hand for joint angles of the Adroit hand, in rad. Frame Adroit is the wrist frame of the Adroit
/// hand. The z axis of this frame points to the fingers, the x axis to the thumb's side, and the y axis out of the back
/// of the hand.
///
/// The Adroit hand and this hand differ in structure. Three kinds of angles stay the same: those of the wrist; those of
/// MCP, PIP and DIP joints; and those between fingers. `palm_arch` lowers the knuckle of the little finger as far as
/// LFJ4 does. The thumb's metacarpal has the recorded direction. The thumb's MCP and IP joints have the angles −THJ1
/// and −THJ0. THJ2, a sideways motion of the thumb's MCP joint, has no counterpart. Values may lie beyond the limits.
///
/// Throws std::invalid_argument for a left hand.
GLISSADE_EXPORT HandPose from_adroit(const HandModel& hand, const std::array<double, kAdroitJoints>& joints,
                                     const Eigen::Isometry3d& X_WAdroit);

}  // namespace glissade::grasping
