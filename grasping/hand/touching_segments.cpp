#include <bit>
#include <string_view>

#include <glissade/grasping/hand_model.h>

namespace glissade::grasping {

int TouchingSegments::count() const {
  return std::popcount(bits_);
}

TouchingSegments TouchingSegments::from_bits(std::int32_t bits) {
  TouchingSegments segments;
  segments.bits_ = static_cast<std::uint32_t>(bits);
  return segments;
}

std::array<SegmentMeaning, 24> TouchingSegments::meaning_of_bits() {
  std::array<SegmentMeaning, 24> meaning;
  meaning[0] = {Finger::kNone, HandSegment::kPalm};
  for (const Finger finger : {Finger::kThumb, Finger::kIndex, Finger::kMiddle, Finger::kRing, Finger::kLittle}) {
    for (const HandSegment kind : {HandSegment::kInner, HandSegment::kMiddle, HandSegment::kOuter})
      meaning[first(finger) + static_cast<unsigned>(kind) - 1U] = {finger, kind};
  }
  return meaning;
}

std::string_view name_of(Finger finger) {
  constexpr std::array<std::string_view, 6> kNames{
      "", "thumb", "index", "middle finger", "ring finger", "little finger"};
  return kNames[static_cast<std::size_t>(finger)];
}

std::string words_of(const SegmentMeaning& segment) {
  constexpr std::array<std::string_view, 5> kSegments{"", "palm", "inner segment", "middle segment", "outer segment"};
  const std::string words = "the " + std::string(kSegments[static_cast<std::size_t>(segment.segment)]);
  if (segment.finger == Finger::kNone) return words;
  return words + " of the " + std::string(name_of(segment.finger));
}

}  // namespace glissade::grasping
