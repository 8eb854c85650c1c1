#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include <glissade/grasping/hand_conversions.h>

#include "hand/hand_links.h"
#include "hand/hand_proportions.h"
#include "hand/joint_fit.h"
#include "hand/metacarpals.h"
#include "hand/segment_meshes.h"

namespace glissade::grasping {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kBoneWeight = 4.0;  ///< of the direction of the thumb's metacarpal, against its rotation about itself

constexpr std::size_t kOpenXrPalm = 0;
constexpr std::size_t kOpenXrWrist = 1;
constexpr std::size_t kOpenXrThumb = 2;
/// Metacarpals of index, middle, ring and little finger; the other four joints of each finger follow.
constexpr std::array<std::size_t, 4> kOpenXrFingers{6, 11, 16, 21};

/// The axes of a joint of OpenXR in L.
Matrix3d openxr_axes() {
  Matrix3d R_LOpenXr;
  R_LOpenXr.col(0) = -Vector3d::UnitY();
  R_LOpenXr.col(1) = Vector3d::UnitZ();
  R_LOpenXr.col(2) = -Vector3d::UnitX();
  return R_LOpenXr;
}

Isometry3d along(double x) {
  return Isometry3d(Eigen::Translation3d(x, 0.0, 0.0));
}

/// Writes joints of OpenXR, placed in frames of links.
class JointWriter {
 public:
  JointWriter(const HandModel& hand, const HandPose& pose) : hand_(hand) {
    hand.chain.poses(pose.X_WR, pose.values, X_WL_);
  }

  void write_palm() {
    const double middle = (kCmc_x + kFingerProportions[1].mcp_x) / 2;
    write(kOpenXrPalm, X_WL_[kPalmLink] * along(middle * hand_.shape.length_m), 0.15);
    write(kOpenXrWrist, X_WL_[kPalmLink], 0.18);
  }

  void write_thumb() {
    write(kOpenXrThumb, X_WL_[kThumbMetacarpal], kThumbBaseDiameter / 2);
    write(kOpenXrThumb + 1, X_WL_[kThumbProximal], kThumbProximalDiameter / 2);
    write(kOpenXrThumb + 2, X_WL_[kThumbDistal], kThumbDistalDiameter / 2);
    write_tip(kOpenXrThumb + 3, kThumbDistal, kThumbDistal_HL, kThumbDistalDiameter / 2);
  }

  void write_finger(std::size_t finger) {
    const FingerProportions& ratios = kFingerProportions[finger];
    const FingerLinks& link = kFingerLinks[finger];
    const std::size_t first = kOpenXrFingers[finger];
    const double pip = (ratios.proximal_diameter + ratios.middle_diameter) / 4;
    const double dip = (ratios.middle_diameter + ratios.distal_diameter) / 4;
    write(first, X_WL_[link.metacarpal] * metacarpal_in_link(finger), 0.15);
    write(first + 1, X_WL_[link.proximal], ratios.proximal_diameter / 2);
    write(first + 2, X_WL_[link.middle], pip);
    write(first + 3, X_WL_[link.distal], dip);
    write_tip(first + 4, link.distal, ratios.distal, dip);
  }

  const OpenXrJoints& joints() const { return joints_; }

 private:
  /// The radius is a ratio of the hand's breadth.
  void write(std::size_t joint, const Isometry3d& X_WL, double radius) {
    joints_[joint] = {X_WL * Isometry3d(openxr_axes()), radius * hand_.shape.breadth_m};
  }

  /// The tip of OpenXR lies within the finger, its radius below the skin.
  void write_tip(std::size_t joint, std::size_t link, double length, double radius) {
    const double tip = length * hand_.shape.length_m - radius * hand_.shape.breadth_m;
    write(joint, X_WL_[link] * along(tip), radius);
  }

  /// Index and middle finger have metacarpals that belong to the palm.
  Isometry3d metacarpal_in_link(std::size_t finger) const {
    if (kFingerLinks[finger].metacarpal != kPalmLink) return Isometry3d::Identity();
    const Isometry3d X_PM = metacarpal_pose(finger, hand_.shape.length_m, hand_.shape.breadth_m);
    return hand_.shape.side == hands::HandSide::kLeft ? mirrored(X_PM) : X_PM;
  }

  const HandModel& hand_;
  std::array<Isometry3d, kHandLinks> X_WL_;
  OpenXrJoints joints_;
};

/// Reads flex values off the rotations of a hand's links.
class ValueReader {
 public:
  ValueReader(const HandModel& hand, hands::JointValues& values) : links_(hand.chain.links()), values_(values) {}

  /// The thumb's metacarpal in the palm: two links, the second of which is turned against the first.
  void read_thumb_metacarpal(const Matrix3d& R_PL) {
    const ChainLink& roll = links_[kThumbRoll];
    const ChainLink& spread = links_[kThumbMetacarpal];
    const Matrix3d R_JK = spread.X_PJ.linear();  // the joints of roll and spread
    const Matrix3d R = roll.X_PJ.linear().transpose() * R_PL * R_JK.transpose();
    const TwoAngles angles =
        two_hinge_angles(R, roll.axis_J, R_JK * spread.axis_J, R_JK * Vector3d::UnitX(), kBoneWeight);
    values_[kThumbRollValue] = angles.first - roll.offset;
    values_[kThumbIndexValue] = angles.second - spread.offset;
  }

  /// A link that hangs on its parent by a hinge.
  double hinge(std::size_t link, const Matrix3d& R_PL) const {
    return hinge_angle(links_[link].X_PJ.linear().transpose() * R_PL, links_[link].axis_J);
  }

  /// The arch that fits both metacarpals best; their rotations in the palm.
  void read_palm_arch(const Matrix3d& R_PRing, const Matrix3d& R_PLittle) {
    const double ring = hinge(kFingerLinks[2].metacarpal, R_PRing);
    const double little = hinge(kFingerLinks[3].metacarpal, R_PLittle);
    values_[kPalmArchValue] = (kRingArchFactor * ring + little) / (kRingArchFactor * kRingArchFactor + 1.0);
  }

  /// The proximal segment in the palm, after the palm's arch. Returns the abduction towards the thumb.
  double read_proximal(std::size_t finger, const Matrix3d& R_PL) {
    const FingerLinks& link = kFingerLinks[finger];
    const ChainLink& knuckle = links_[link.knuckle];
    const Matrix3d R_PJ = metacarpal_rotation(finger) * knuckle.X_PJ.linear();
    const TwoAngles angles =
        two_hinge_angles(R_PJ.transpose() * R_PL, knuckle.axis_J, links_[link.proximal].axis_J, Vector3d::UnitX(), 0.0);
    values_[kMcpValues[finger]] = angles.second;
    return angles.first;
  }

  void write_abductions(const std::array<double, 4>& towards_thumb) {
    values_[kMiddleIndexValue] = towards_thumb[0] - towards_thumb[1];
    values_[kRingMiddleValue] = towards_thumb[1] - towards_thumb[2];
    values_[kLittleRingValue] = towards_thumb[2] - towards_thumb[3];
  }

 private:
  /// In the palm.
  Matrix3d metacarpal_rotation(std::size_t finger) const {
    const FingerLinks& link = kFingerLinks[finger];
    if (link.metacarpal == kPalmLink) return Matrix3d::Identity();
    const ChainLink& metacarpal = links_[link.metacarpal];
    const double angle = metacarpal.terms[0].factor * values_[kPalmArchValue];
    return metacarpal.X_PJ.linear() * Eigen::AngleAxisd(angle, metacarpal.axis_J).toRotationMatrix();
  }

  std::span<const ChainLink> links_;
  hands::JointValues& values_;
};

/// The rotation of the Adroit hand's thumb metacarpal in its palm: a thumb that points 45 degrees off the fingers,
/// turned by THJ4 about itself and by THJ3 out of the plane of the palm.
Matrix3d adroit_thumb(double THJ4, double THJ3) {
  return (Eigen::AngleAxisd(45.0 * kDegree, Vector3d::UnitY()) * Eigen::AngleAxisd(-THJ4, Vector3d::UnitZ()) *
          Eigen::AngleAxisd(THJ3, Vector3d::UnitX()))
      .toRotationMatrix();
}

/// What LFJ4 lowers the knuckle of the little finger by, over its distance from our CMC joint: lengths of the Adroit
/// model in metres, for a hand of 183 mm.
constexpr double kAdroitArchFactor = 0.0391 / (0.306 * 0.183);

}  // namespace

OpenXrJoints to_openxr(const HandModel& hand, const HandPose& pose) noexcept {
  JointWriter writer(hand, pose);
  writer.write_palm();
  writer.write_thumb();
  for (std::size_t finger = 0; finger < 4; ++finger)
    writer.write_finger(finger);
  return writer.joints();
}

HandPose from_openxr(const HandModel& hand, const OpenXrJoints& joints) noexcept {
  const Matrix3d R_OpenXrL = openxr_axes().transpose();
  HandPose pose{joints[kOpenXrWrist].X_WOpenXr * Isometry3d(R_OpenXrL), {}};
  const auto between = [&](std::size_t outer, std::size_t inner) -> Matrix3d {
    return R_OpenXrL.transpose() * joints[inner].X_WOpenXr.linear().transpose() * joints[outer].X_WOpenXr.linear() *
           R_OpenXrL;
  };
  ValueReader reader(hand, pose.values);
  reader.read_thumb_metacarpal(between(kOpenXrThumb, kOpenXrWrist));
  pose.values[kThumbMcpValue] = reader.hinge(kThumbProximal, between(kOpenXrThumb + 1, kOpenXrThumb));
  pose.values[kThumbIpValue] = reader.hinge(kThumbDistal, between(kOpenXrThumb + 2, kOpenXrThumb + 1));
  reader.read_palm_arch(between(kOpenXrFingers[2], kOpenXrWrist), between(kOpenXrFingers[3], kOpenXrWrist));
  std::array<double, 4> towards_thumb{};
  for (std::size_t finger = 0; finger < 4; ++finger) {
    const std::size_t proximal = kOpenXrFingers[finger] + 1;
    const std::size_t value = kMcpValues[finger];
    towards_thumb[finger] = reader.read_proximal(finger, between(proximal, kOpenXrWrist));
    pose.values[value + 1] = reader.hinge(kFingerLinks[finger].middle, between(proximal + 1, proximal));
    pose.values[value + 2] = reader.hinge(kFingerLinks[finger].distal, between(proximal + 2, proximal + 1));
  }
  reader.write_abductions(towards_thumb);
  return pose;
}

HandPose from_adroit(const HandModel& hand, const std::array<double, kAdroitJoints>& joints,
                     const Isometry3d& X_WAdroit) {
  if (hand.shape.side != hands::HandSide::kRight)
    throw std::invalid_argument("The Adroit hand is a right hand, but the hand model is a left one.");
  Matrix3d R_AdroitR;  // x of R is z of Adroit, and so on round
  R_AdroitR << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  HandPose pose{X_WAdroit * Isometry3d(R_AdroitR), {}};
  pose.values[kWristAbductionValue] = joints[0];
  pose.values[kWristFlexionValue] = joints[1];

  constexpr std::array<std::size_t, 4> kFingerJoints{2, 6, 10, 15};  // FFJ3, MFJ3, RFJ3, LFJ3
  constexpr std::size_t kLittleArch = 14;                            // LFJ4
  constexpr std::size_t kThumb = 19;                                 // THJ4
  std::array<double, 4> towards_thumb{};
  for (std::size_t finger = 0; finger < 4; ++finger) {
    towards_thumb[finger] = joints[kFingerJoints[finger]];
    for (std::size_t joint = 0; joint < 3; ++joint)
      pose.values[kMcpValues[finger] + joint] = joints[kFingerJoints[finger] + 1 + joint];
  }
  pose.values[kPalmArchValue] = kAdroitArchFactor * joints[kLittleArch];
  ValueReader reader(hand, pose.values);
  reader.write_abductions(towards_thumb);
  // Our metacarpal: x is z of theirs, z, the nail, is x of theirs: at zero angles, both bend before the palm.
  Matrix3d R_TL;
  R_TL << 0, 0, 1, 0, -1, 0, 1, 0, 0;
  reader.read_thumb_metacarpal(R_AdroitR.transpose() * adroit_thumb(joints[kThumb], joints[kThumb + 1]) * R_TL);
  pose.values[kThumbMcpValue] = -joints[kThumb + 3];
  pose.values[kThumbIpValue] = -joints[kThumb + 4];
  return pose;
}

}  // namespace glissade::grasping
