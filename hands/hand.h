#pragma once

/// Names and numbers for the joints of a human hand, its side, its activity and its grasp. Gloves, the simulation and
/// messages use them.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <Eigen/Geometry>

#include <glissade/base/export.h>

namespace glissade::hands {

/// Maximum number of hands in one simulation.
inline constexpr std::size_t kMaxHands = 4;

inline constexpr int kJoints = 22;

/// One number per joint, in the order of `kJointNames`.
using JointValues = std::array<double, kJoints>;

/// Names of the joints, in CyberGlove order. An abduction named after two fingers is the angle between these fingers.
inline constexpr std::array<std::string_view, kJoints> kJointNames{"thumb_roll",
                                                                   "thumb_mcp",
                                                                   "thumb_ip",
                                                                   "thumb_index_abduction",
                                                                   "index_mcp",
                                                                   "index_pip",
                                                                   "index_dip",
                                                                   "middle_mcp",
                                                                   "middle_pip",
                                                                   "middle_dip",
                                                                   "middle_index_abduction",
                                                                   "ring_mcp",
                                                                   "ring_pip",
                                                                   "ring_dip",
                                                                   "ring_middle_abduction",
                                                                   "little_mcp",
                                                                   "little_pip",
                                                                   "little_dip",
                                                                   "little_ring_abduction",
                                                                   "palm_arch",
                                                                   "wrist_flexion",
                                                                   "wrist_abduction"};

struct JointRange {
  double lower_deg;
  double upper_deg;
};

/// Ranges of the joints of a human hand, in the order of `kJointNames`. At the lower limit of its roll, the thumb lies
/// in the plane of the palm. The ranges of the abductions also limit the angle of each finger to the palm. In degrees
/// towards the thumb, these limits are −15..30 for the index, −20..15 for the ring finger, and −40..20 for the little
/// finger.
inline constexpr std::array<JointRange, kJoints> kJointRanges{{{-20, 60}, {-10, 60}, {-15, 80}, {0, 60},
                                                               {-20, 90}, {0, 105},  {-10, 90},  // index
                                                               {-20, 90}, {0, 105},  {-10, 90},  // middle
                                                               {-15, 30},                        // to the index
                                                               {-20, 90}, {0, 105},  {-10, 90},  // ring
                                                               {-15, 20},                        // to the middle finger
                                                               {-20, 90}, {0, 105},  {-10, 90},  // little
                                                               {-5, 20},                         // to the ring
                                                               {0, 30},   {-70, 80}, {-30, 20}}};

/// Left or right. Messages carry the number.
enum class HandSide : std::int32_t { kUnknown = 0, kLeft = 1, kRight = 2 };

/// The activity of a hand with fingers. Messages carry its number.
enum class HandActivity : std::int32_t {
  kNone = 0,     ///< not reported: the hand has no fingers in the simulation, and holds by its grip
  kLost = 1,     ///< the tracker has lost the hand, and the hand holds nothing
  kWaiting = 2,  ///< the hand has been inside an object since the start or since its tracker found it, and waits until
                 ///< it is free
  kFree = 3,     ///< the hand holds nothing, but may touch objects
  kHolding = 4,  ///< a part moves with the hand, even while the tracker has lost the hand
};

/// Whether a hand with fingers is present among the objects. A hand that waits or is lost is no obstacle, and its
/// posture has no meaning.
constexpr bool is_present(HandActivity activity) noexcept {
  return activity == HandActivity::kFree || activity == HandActivity::kHolding;
}

/// Number of activities; their values run from 0 to kHandActivities − 1.
inline constexpr std::int32_t kHandActivities = 5;

/// The type of a grasp, which follows from the touching segments (paper §4). The thumb's segments count as finger
/// segments, too. Messages carry the number of the type.
enum class GraspType : std::int32_t {
  kNone = 0,       ///< nothing touches
  kPush = 1,       ///< one segment; only the thumb; fingers without thumb and palm; or palm and inner segments
  kPrecision = 2,  ///< segments of the thumb and of another finger, without the palm
  kPower = 3,      ///< the palm and at least one middle or outer segment
};

/// Number of types; their values run from 0 to kGraspTypes − 1.
inline constexpr std::int32_t kGraspTypes = 4;

/// A named form of a grasp within a type. Messages carry the number of the form.
enum class GraspForm : std::int32_t {
  kNone = 0,
  kTipPinch = 1,    ///< precision: outer segments of thumb and index only
  kThreeJaw = 2,    ///< precision: outer segments of thumb, index and middle finger, both fingers on one side
  kThreePoint = 3,  ///< precision: outer segments of thumb and two fingers, from three sides
  kKey = 4,         ///< precision: the thumb's outer segment against the side of the index
  kCigarette = 5,   ///< push: two neighboring fingers from opposite sides, without the thumb
  kGravity = 6,     ///< push or power: two fingers, or palm and finger, carry the object; nothing else touches it
};

/// Number of forms; their values run from 0 to kGraspForms − 1.
inline constexpr std::int32_t kGraspForms = 7;

/// The visible hand with fingers, which never penetrates an object.
struct VisibleHand {
  HandActivity activity = HandActivity::kNone;
  GraspType grasp = GraspType::kNone;
  GraspForm form = GraspForm::kNone;
  /// The segments that touch the grasped object, as the sum of 2^(4 f + s) over these segments. f is 0 for the palm and
  /// 1 to 5 for thumb to little finger. s is 0 for the palm and 1 to 3 for a finger's inner, middle and outer segment.
  std::int32_t touching = 0;
  Eigen::Isometry3d X_WH = Eigen::Isometry3d::Identity();
  JointValues angles{};  ///< rad
};

/// The name of an activity or a type, such as "holding" or "power". Any other value is called "none".
GLISSADE_EXPORT std::string_view name_of(HandActivity activity);
GLISSADE_EXPORT std::string_view name_of(GraspType type);
/// The name of a form, such as "tip-pinch"; empty for kNone and any other value.
GLISSADE_EXPORT std::string_view name_of(GraspForm form);

}  // namespace glissade::hands
