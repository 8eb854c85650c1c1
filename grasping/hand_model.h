#pragma once

/// A human hand as a kinematic chain with 22 flex values, scaled to a person. Each segment has a closed mesh.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <glissade/base/export.h>
#include <glissade/grasping/kinematic_chain.h>
#include <glissade/hands/hand.h>

namespace glissade::grasping {

/// The size and side of a hand. The length is measured from the crease of the wrist to the tip of the middle finger,
/// the breadth across the knuckles. The defaults are those of a typical man's hand. A typical woman's hand is 0.166 m
/// long and 0.075 m broad.
struct HandShape {
  double length_m = 0.183;
  double breadth_m = 0.084;
  hands::HandSide side = hands::HandSide::kRight;
};

enum class Finger { kNone, kThumb, kIndex, kMiddle, kRing, kLittle };

/// The name of a finger, such as "middle finger"; empty for `kNone`.
GLISSADE_EXPORT std::string_view name_of(Finger finger);

/// Kinds of segments, from the palm outwards. The inner segment of a finger is its proximal phalanx. The inner segment
/// of the thumb is its metacarpal.
enum class HandSegment { kNone, kPalm, kInner, kMiddle, kOuter };

/// The finger and segment of a link, for the grasp analysis. The palm consists of three links, because its arch moves
/// the metacarpals of ring and little finger. The finger of these links is `kNone`. Links without a mesh have the
/// segment `kNone`.
struct SegmentMeaning {
  Finger finger = Finger::kNone;
  HandSegment segment = HandSegment::kNone;
};

/// A set of touching segments.
class GLISSADE_EXPORT TouchingSegments {
 public:
  void add(const SegmentMeaning& segment) { bits_ |= bit(segment); }
  bool has(const SegmentMeaning& segment) const { return (bits_ & bit(segment)) != 0; }
  bool has(Finger finger) const { return (bits_ & (0xfU << first(finger))) != 0; }
  bool has_palm() const { return has({Finger::kNone, HandSegment::kPalm}); }
  int count() const;
  bool is_empty() const { return bits_ == 0; }
  /// The bits of `hands::VisibleHand::touching`.
  std::int32_t bits() const { return static_cast<std::int32_t>(bits_); }
  static TouchingSegments from_bits(std::int32_t bits);
  /// The segment of each bit, from the lowest bit on; `HandSegment::kNone` for a bit without a segment.
  static std::array<SegmentMeaning, 24> meaning_of_bits();
  bool operator==(const TouchingSegments&) const = default;

 private:
  static unsigned first(Finger finger) { return 4U * static_cast<unsigned>(finger); }
  static std::uint32_t bit(const SegmentMeaning& segment) {
    return 1U << (first(segment.finger) + static_cast<unsigned>(segment.segment) - 1U);
  }

  std::uint32_t bits_ = 0;
};

/// The name of a segment, such as "the middle segment of the index".
GLISSADE_EXPORT std::string words_of(const SegmentMeaning& segment);

/// Every hand has the same links in the same order.
inline constexpr std::size_t kHandLinks = 25;

/// The root R is the end of the forearm at the wrist, where a tracker is worn. R has no mesh. The two joints of the
/// wrist connect the palm to R. With both wrist angles 0, the palm's frame is R. The x axis of R points along the
/// forearm towards the middle finger. The z axis points out of the back of the hand. So the y axis points to the
/// thumb's side of a right hand, and away from the thumb of a left hand. A left hand is the mirror image of a right
/// hand at y = 0.
///
/// In the frame L of each segment, the origin is the joint nearer to the wrist. The x axis points along the bone to the
/// next joint or to the tip, and the z axis out of the back (on the outer segments, out of the nail). Flexion is a
/// rotation about y.
///
/// The values have the order of `hands::kJointNames`. Positive flexions close the hand. Positive abductions spread
/// neighboring fingers. Positive values of `thumb_roll` bring the thumb in front of the palm. Positive values of
/// `palm_arch` bring ring and little finger towards the thumb. Positive values of `wrist_abduction` turn the hand
/// towards the thumb. With all values 0 the fingers are straight and parallel. Abductions are relative, so the
/// abduction of the ring finger also turns the little finger. The middle finger does not abduct.
struct HandModel {
  HandShape shape;
  KinematicChain chain;
  std::array<SegmentMeaning, kHandLinks> meaning;  ///< by link
  /// The links that the wrist joints turn, from the root on. A part in the hand moves with the last link, the palm.
  std::array<std::size_t, 2> wrist_links;
};

/// Throws std::invalid_argument for a length outside 0.05 ... 0.5 m, a breadth outside 0.3 ... 0.7 of the length, or a
/// side that is not known. Allocates 18 meshes of 150 to 400 triangles, in metres.
GLISSADE_EXPORT HandModel make_hand(const HandShape& shape = {});

}  // namespace glissade::grasping
