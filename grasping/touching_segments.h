#pragma once

/// Which segments of a hand touch something.

#include <array>
#include <cstdint>
#include <string>

#include <glissade/grasping/hand_model.h>

namespace glissade::grasping {

/// Segments that touch, as a set.
class TouchingSegments {
 public:
  void add(const SegmentMeaning& segment) { bits_ |= bit(segment); }
  bool has(const SegmentMeaning& segment) const { return (bits_ & bit(segment)) != 0; }
  bool has(Finger finger) const { return (bits_ & (0xfU << first(finger))) != 0; }
  bool has_palm() const { return has({Finger::kNone, HandSegment::kPalm}); }
  int count() const;
  bool is_empty() const { return bits_ == 0; }
  /// As `devices::VisibleHand::touching`.
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

}  // namespace glissade::grasping
