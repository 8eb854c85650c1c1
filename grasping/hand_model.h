#pragma once

/// A human hand as a kinematic chain of 22 flex values, scaled to a person, with a closed mesh for each segment.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <glissade/grasping/kinematic_chain.h>
#include <glissade/hands/hand.h>

namespace glissade::grasping {

/// Whose hand: its length from the crease of the wrist to the tip of the middle finger, and its breadth across the
/// knuckles. The defaults are a typical man's hand; 0.166 m and 0.075 m are a typical woman's.
struct HandShape {
  double length_m = 0.183;
  double breadth_m = 0.084;
  hands::HandSide side = hands::HandSide::kRight;
};

enum class Finger { kNone, kThumb, kIndex, kMiddle, kRing, kLittle };

/// Such as "middle finger"; empty for `kNone`.
std::string_view name_of(Finger finger);

/// Kinds of segments, named from the palm outwards. The inner segment of a finger is its proximal phalanx, that of the
/// thumb its metacarpal.
enum class HandSegment { kNone, kPalm, kInner, kMiddle, kOuter };

/// What a link is to the analysis of a grasp. The palm consists of three links, because its arch moves the metacarpals
/// of ring and little finger; their finger is `kNone`. Links without a mesh mean nothing: `kNone`.
struct SegmentMeaning {
  Finger finger = Finger::kNone;
  HandSegment segment = HandSegment::kNone;
};

/// Segments that touch, as a set.
class TouchingSegments {
 public:
  void add(const SegmentMeaning& segment) { bits_ |= bit(segment); }
  bool has(const SegmentMeaning& segment) const { return (bits_ & bit(segment)) != 0; }
  bool has(Finger finger) const { return (bits_ & (0xfU << first(finger))) != 0; }
  bool has_palm() const { return has({Finger::kNone, HandSegment::kPalm}); }
  int count() const;
  bool is_empty() const { return bits_ == 0; }
  /// As `hands::VisibleHand::touching`.
  std::int32_t bits() const { return static_cast<std::int32_t>(bits_); }
  static TouchingSegments from_bits(std::int32_t bits);
  /// The segment of each bit, the lowest first; `HandSegment::kNone` where no segment has the bit.
  static std::array<SegmentMeaning, 24> meaning_of_bits();
  bool operator==(const TouchingSegments&) const = default;

 private:
  static unsigned first(Finger finger) { return 4U * static_cast<unsigned>(finger); }
  static std::uint32_t bit(const SegmentMeaning& segment) {
    return 1U << (first(segment.finger) + static_cast<unsigned>(segment.segment) - 1U);
  }

  std::uint32_t bits_ = 0;
};

/// The words for a segment, such as "the middle segment of the index".
std::string words_of(const SegmentMeaning& segment);

/// Every hand has the same links in the same order.
inline constexpr std::size_t kHandLinks = 25;

/// The root R is the end of the forearm at the wrist, where a tracker sits, without a mesh. The palm hangs on it by the
/// two joints of the wrist; with both wrist angles 0, the palm's frame is R. Axes of R: x points along the forearm
/// towards the middle finger, z out of the back of the hand. So y points to the thumb's side of a right hand, and away
/// from the thumb of a left hand, which is the mirror image of the right one at y = 0.
///
/// In the frame L of each segment, the origin is the joint nearer to the wrist, x points along the bone to the next
/// joint or to the tip, z out of the back (on the outer segments: of the nail), and bending about y is flexion.
///
/// The values are those of `hands::kJointNames`, in that order. All flexions are positive where they close the
/// hand, `thumb_roll` where the thumb comes before the palm, abductions where neighboring fingers spread, `palm_arch`
/// where ring and little finger come towards the thumb, `wrist_abduction` towards the thumb. With all values 0 the
/// fingers are straight and parallel. Abductions are relative: the little finger turns with that of the ring finger.
/// The middle finger does not abduct.
struct HandModel {
  HandShape shape;
  KinematicChain chain;
  std::array<SegmentMeaning, kHandLinks> meaning;  ///< by link
  /// The links that turn in the joints of the wrist, from the root on. A part in the hand moves with the last one, the
  /// palm.
  std::array<std::size_t, 2> wrist_links;
};

/// Throws std::invalid_argument for a length outside 0.05 ... 0.5 m, a breadth outside 0.3 ... 0.7 of the length, or a
/// side that is not known. Allocates the meshes: 18 of 150 to 400 triangles, in metres.
HandModel make_hand(const HandShape& shape = {});

}  // namespace glissade::grasping
