#pragma once

/// A human hand as a kinematic chain of 22 flex values, scaled to a person, with a closed mesh for each segment.

#include <array>
#include <cstddef>
#include <vector>

#include <glissade/devices/glove_device.h>
#include <glissade/grasping/kinematic_chain.h>

namespace glissade::grasping {

/// Whose hand: its length from the crease of the wrist to the tip of the middle finger, and its breadth across the
/// knuckles. The defaults are a typical man's hand; 0.166 m and 0.075 m are a typical woman's.
struct HandShape {
  double length_m = 0.183;
  double breadth_m = 0.084;
  devices::HandSide side = devices::HandSide::kRight;
};

enum class Finger { kNone, kThumb, kIndex, kMiddle, kRing, kLittle };

/// Kinds of segments, named from the palm outwards. The inner segment of a finger is its proximal phalanx, that of the
/// thumb its metacarpal.
enum class HandSegment { kNone, kPalm, kInner, kMiddle, kOuter };

/// What a link is to the analysis of a grasp. The palm consists of three links, because its arch moves the metacarpals
/// of ring and little finger; their finger is `kNone`. Links without a mesh mean nothing: `kNone`.
struct SegmentMeaning {
  Finger finger = Finger::kNone;
  HandSegment segment = HandSegment::kNone;
};

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
/// The values are those of `devices::kGloveJointNames`, in that order. All flexions are positive where they close the
/// hand, `thumb_roll` where the thumb comes before the palm, abductions where neighboring fingers spread, `palm_arch`
/// where ring and little finger come towards the thumb, `wrist_abduction` towards the thumb. With all values 0 the
/// fingers are straight and parallel. Abductions are relative: the little finger turns with that of the ring finger.
/// The middle finger does not abduct.
struct HandModel {
  HandShape shape;
  KinematicChain chain;
  std::array<SegmentMeaning, kHandLinks> meaning;  ///< by link
};

/// Throws std::invalid_argument for a length outside 0.05 ... 0.5 m, a breadth outside 0.3 ... 0.7 of the length, or a
/// side that is not known. Allocates the meshes: 18 of 150 to 400 triangles, in metres.
HandModel make_hand(const HandShape& shape = {});

}  // namespace glissade::grasping
