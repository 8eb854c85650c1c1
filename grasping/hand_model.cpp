#include <array>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <glissade/base/require.h>
#include <glissade/grasping/hand_model.h>

#include "hand/hand_links.h"
#include "hand/hand_proportions.h"
#include "hand/metacarpals.h"
#include "hand/segment_meshes.h"

namespace glissade::grasping {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using geometry::TriangleMesh;

/// Each finger's abduction towards the thumb: minus the sum of the angles between it and the middle finger, or the
/// angle to the index finger.
std::vector<JointTerm> abduction(std::size_t finger) {
  switch (finger) {
    case 0:
      return {{kMiddleIndexValue, 1.0}};
    case 1:
      return {};
    case 2:
      return {{kRingMiddleValue, -1.0}};
    default:
      return {{kRingMiddleValue, -1.0}, {kLittleRingValue, -1.0}};
  }
}

Isometry3d at(double x, double y) {
  return Isometry3d(Eigen::Translation3d(x, y, 0.0));
}

Isometry3d turn(double angle, const Vector3d& axis) {
  return Isometry3d(Eigen::AngleAxisd(angle, axis));
}

/// Makes the links of a right hand in the order of hand_links.h.
class RightHand {
 public:
  RightHand(double length, double breadth) : HL_(length), HB_(breadth) {
    links_.push_back({.name = "forearm"});
    add("wrist", kForearm, Isometry3d::Identity(), Vector3d::UnitY(), {{kWristFlexionValue}});
    add("palm", kWrist, Isometry3d::Identity(), Vector3d::UnitZ(), {{kWristAbductionValue}}, palm_mesh(HL_, HB_));
    add_thumb();
    constexpr std::array<const char*, 4> kNames{"index", "middle", "ring", "little"};
    for (std::size_t finger = 0; finger < 4; ++finger)
      add_finger(kNames[finger], finger);
  }

  std::vector<ChainLink> links() && { return std::move(links_); }

 private:
  void add(std::string name, std::size_t parent, const Isometry3d& X_PJ, const Vector3d& axis_J,
           std::vector<JointTerm> terms, TriangleMesh mesh = {}) {
    links_.push_back(
        {.name = std::move(name), .parent = parent, .X_PJ = X_PJ, .axis_J = axis_J, .terms = std::move(terms)});
    if (!mesh.vertices.empty()) links_.back().mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
  }

  void add_thumb() {
    const double metacarpal = kThumbMetacarpal_HL * HL_;
    const double proximal = kThumbProximal_HL * HL_;
    const double mcp = kThumbProximalDiameter / 2 * HB_;
    const double ip = kThumbDistalDiameter / 2 * HB_;
    add("thumb_roll", kPalmLink, at(kCmc_x * HL_, kThumbCmc_y * HB_) * turn(-kThumbRollAxisTilt, Vector3d::UnitZ()),
        -Vector3d::UnitX(), {{kThumbRollValue}});
    links_.back().offset = kThumbRollOffset;
    // From here on, z points out of the nail: for a thumb beside the palm, towards the thumb's side.
    add("thumb_metacarpal", kThumbRoll, turn(-90 * kDegree, Vector3d::UnitX()), -Vector3d::UnitY(),
        {{kThumbIndexValue}}, thumb_metacarpal_mesh(metacarpal, HB_));
    links_.back().offset = kThumbRollAxisTilt;
    add("thumb_proximal", kThumbMetacarpal, at(metacarpal, 0.0) * turn(kThumbPronation, Vector3d::UnitX()),
        Vector3d::UnitY(), {{kThumbMcpValue}}, phalanx_mesh(proximal, mcp, ip));
    add("thumb_distal", kThumbProximal, at(proximal, 0.0), Vector3d::UnitY(), {{kThumbIpValue}},
        fingertip_mesh(kThumbDistal_HL * HL_, ip));
  }

  void add_finger(const std::string& name, std::size_t finger) {
    const FingerProportions& ratios = kFingerProportions[finger];
    const FingerLinks& link = kFingerLinks[finger];
    const double proximal = ratios.proximal * HL_;
    const double middle = ratios.middle * HL_;
    const double pip = (ratios.proximal_diameter + ratios.middle_diameter) / 4 * HB_;
    const double dip = (ratios.middle_diameter + ratios.distal_diameter) / 4 * HB_;
    const std::size_t value = kMcpValues[finger];
    const Isometry3d X_metacarpal_mcp =
        link.metacarpal == kPalmLink ? at(ratios.mcp_x * HL_, ratios.mcp_y * HB_) : add_metacarpal(name, finger);
    add(name + "_knuckle", link.metacarpal, X_metacarpal_mcp, Vector3d::UnitZ(), abduction(finger));
    add(name + "_proximal", link.knuckle, Isometry3d::Identity(), Vector3d::UnitY(), {{value}},
        phalanx_mesh(proximal, ratios.proximal_diameter / 2 * HB_, pip));
    add(name + "_middle", link.proximal, at(proximal, 0.0), Vector3d::UnitY(), {{value + 1}},
        phalanx_mesh(middle, pip, dip));
    add(name + "_distal", link.middle, at(middle, 0.0), Vector3d::UnitY(), {{value + 2}},
        fingertip_mesh(ratios.distal * HL_, dip));
  }

  /// The metacarpal of ring or little finger. Returns the place of the knuckle on it, at which fingers are parallel.
  Isometry3d add_metacarpal(const std::string& name, std::size_t finger) {
    const double length = kFingerProportions[finger].metacarpal * HL_;
    const Isometry3d X_PJ = metacarpal_pose(finger, HL_, HB_);
    const bool is_ring = finger == 2;
    add(name + "_metacarpal", kPalmLink, X_PJ, Vector3d::UnitY(), {{kPalmArchValue, is_ring ? kRingArchFactor : 1.0}},
        is_ring ? ring_metacarpal_mesh(length, HB_) : little_metacarpal_mesh(length, HB_));
    return at(length, 0.0) * Isometry3d(X_PJ.linear().transpose());
  }

  double HL_;
  double HB_;
  std::vector<ChainLink> links_;
};

/// The mirror image at y = 0. A rotation by an angle about an axis becomes one by the same angle about the negative of
/// the mirrored axis.
ChainLink mirrored_link(ChainLink link) {
  link.X_PJ = mirrored(link.X_PJ);
  link.axis_J = Vector3d(-link.axis_J.x(), link.axis_J.y(), -link.axis_J.z());
  if (!link.mesh) return link;
  auto mesh = std::make_shared<TriangleMesh>(*link.mesh);
  for (Vector3d& p_L : mesh->vertices)
    p_L.y() = -p_L.y();
  for (geometry::Triangle& triangle : mesh->triangles)
    std::swap(triangle[1], triangle[2]);
  link.mesh = std::move(mesh);
  return link;
}

std::vector<FlexValue> flex_values() {
  std::vector<FlexValue> values;
  for (std::size_t i = 0; i < hands::kJointRanges.size(); ++i) {
    const hands::JointRange& range = hands::kJointRanges[i];
    values.push_back({std::string(hands::kJointNames[i]), range.lower_deg * kDegree, range.upper_deg * kDegree});
  }
  return values;
}

std::array<SegmentMeaning, kHandLinks> meanings() {
  std::array<SegmentMeaning, kHandLinks> meaning{};
  meaning[kPalmLink] = {Finger::kNone, HandSegment::kPalm};
  meaning[kThumbMetacarpal] = {Finger::kThumb, HandSegment::kInner};
  meaning[kThumbProximal] = {Finger::kThumb, HandSegment::kMiddle};
  meaning[kThumbDistal] = {Finger::kThumb, HandSegment::kOuter};
  constexpr std::array<Finger, 4> kFingers{Finger::kIndex, Finger::kMiddle, Finger::kRing, Finger::kLittle};
  for (std::size_t finger = 0; finger < 4; ++finger) {
    const FingerLinks& link = kFingerLinks[finger];
    meaning[link.metacarpal] = {Finger::kNone, HandSegment::kPalm};
    meaning[link.proximal] = {kFingers[finger], HandSegment::kInner};
    meaning[link.middle] = {kFingers[finger], HandSegment::kMiddle};
    meaning[link.distal] = {kFingers[finger], HandSegment::kOuter};
  }
  return meaning;
}

}  // namespace

HandModel make_hand(const HandShape& shape) {
  base::require_between("length_m", shape.length_m, 0.05, 0.5);
  base::require_between("breadth_m", shape.breadth_m, 0.3 * shape.length_m, 0.7 * shape.length_m);
  if (shape.side != hands::HandSide::kLeft && shape.side != hands::HandSide::kRight)
    throw std::invalid_argument("A hand is a left or a right one, but its side is unknown.");
  std::vector<ChainLink> links = RightHand(shape.length_m, shape.breadth_m).links();
  if (shape.side == hands::HandSide::kLeft) {
    for (ChainLink& link : links)
      link = mirrored_link(std::move(link));
  }
  return {shape, KinematicChain(flex_values(), std::move(links)), meanings(), {kWrist, kPalmLink}};
}

}  // namespace glissade::grasping
