#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include <glissade/grasping/grasp_analysis.h>

namespace glissade::grasping {
namespace {

// A level is the low-pass filtered fact that a segment touches.
constexpr double kFilter_ms = 30.0;
constexpr double kCounts = 0.5;
constexpr double kCountsNoMore = 0.1;
constexpr double kOpposed = -0.7;  // cosine of the angle between two normals
constexpr double kOpposedStill = -0.4;
constexpr double kAlike = 0.6;      // the same for normals on one side
constexpr double kFromBelow = 0.6;  // cosine of the angle to the vertical

constexpr std::array<Finger, 5> kAllFingers{Finger::kThumb, Finger::kIndex, Finger::kMiddle, Finger::kRing,
                                            Finger::kLittle};

GraspType type_of(const TouchingSegments& segments) {
  if (segments.is_empty()) return GraspType::kNone;
  if (segments.count() == 1) return GraspType::kPush;
  const auto any = [&](HandSegment kind) {
    return std::any_of(kAllFingers.begin(), kAllFingers.end(), [&](Finger finger) {
      return segments.has({finger, kind});
    });
  };
  if (segments.has_palm()) {
    return any(HandSegment::kMiddle) || any(HandSegment::kOuter) ? GraspType::kPower : GraspType::kPush;
  }
  const bool has_finger =
      std::any_of(kAllFingers.begin() + 1, kAllFingers.end(), [&](Finger finger) { return segments.has(finger); });
  return segments.has(Finger::kThumb) && has_finger ? GraspType::kPrecision : GraspType::kPush;
}

/// Whether of all fingers exactly these touch, and only with their outer segments.
bool are_tips_of(const TouchingSegments& segments, std::span<const Finger> fingers) {
  TouchingSegments tips;
  for (const Finger finger : fingers)
    tips.add({finger, HandSegment::kOuter});
  return segments == tips;
}

}  // namespace

std::string_view words_of(GraspLack lack) {
  constexpr std::array<std::string_view, kGraspLacks> kWords{
      "", "a grasp needs thumb and finger, or palm and a middle or outer segment",
      "a grasp needs a finger as well, or the palm and a middle or outer segment",
      "a grasp needs the thumb as well, or the palm and a middle or outer segment",
      "a grasp needs a middle or outer segment as well"};
  return kWords[static_cast<std::size_t>(lack)];
}

GraspLack Grasp::lack() const {
  if (holds()) return GraspLack::kNothing;
  if (segments.is_empty()) return GraspLack::kTouch;
  if (segments.has_palm()) return GraspLack::kSegmentFartherOut;
  return segments.has(Finger::kThumb) ? GraspLack::kFinger : GraspLack::kThumbOrPalm;
}

Grasp grasp_of(const hands::VisibleHand& hand) {
  return {.type = hand.grasp, .form = hand.form, .segments = TouchingSegments::from_bits(hand.touching)};
}

std::string reason_of(const Grasp& grasp) {
  if (grasp.type == GraspType::kNone) return "none: nothing touches";
  std::vector<std::string> touching;
  for (const SegmentMeaning& segment : TouchingSegments::meaning_of_bits()) {
    if (segment.segment != HandSegment::kNone && grasp.segments.has(segment)) touching.push_back(words_of(segment));
  }
  std::string text(name_of(grasp.type));
  if (grasp.form != GraspForm::kNone) text += ", " + std::string(name_of(grasp.form));
  text += ": ";
  for (std::size_t i = 0; i < touching.size(); ++i) {
    if (i > 0) text += i + 1 < touching.size() ? ", " : " and ";
    text += touching[i];
  }
  return text + (touching.size() == 1 ? " touches" : " touch");
}

const Grasp& GraspAnalysis::update(std::span<const LinkContact> contacts, double milliseconds,
                                   const Eigen::Vector3d& up_W, std::int32_t held) {
  follow(contacts, milliseconds);
  if (held >= 0) {
    grasp_ = analyze(held, up_W);
    if (grasp_.holds()) return grasp_;
  }
  Grasp firmest;
  for (const TouchesOfLink& touches : touches_) {
    for (const Touch& touch : touches) {
      if (!touch.counts || touch.object == firmest.object) continue;
      const Grasp grasp = analyze(touch.object, up_W);
      if (is_firmer(grasp, firmest)) firmest = grasp;
    }
  }
  grasp_ = firmest;
  return grasp_;
}

bool GraspAnalysis::is_firmer(const Grasp& grasp, const Grasp& other) const {
  const auto rank = [&](const Grasp& one) {
    return std::tuple(one.holds() && one.object >= first_part_, one.type, one.segments.count());
  };
  return rank(grasp) > rank(other);
}

void GraspAnalysis::clear() {
  touches_ = {};
  grasp_ = {};
}

void GraspAnalysis::forget(std::size_t link, std::int32_t object) {
  for (Touch& touch : touches_[link]) {
    if (touch.object == object) touch = {};
  }
}

void GraspAnalysis::follow(std::span<const LinkContact> contacts, double milliseconds) {
  const double share = 1.0 - std::exp(-milliseconds / kFilter_ms);
  std::array<std::array<Eigen::Vector3d, kBodiesOfLink>, kHandLinks> sums;
  for (auto& sums_of_link : sums)
    sums_of_link.fill(Eigen::Vector3d::Zero());
  for (const LinkContact& contact : contacts) {
    TouchesOfLink& touches = touches_[contact.link];
    const std::int32_t object = contact.contact.obstacle;
    auto place =
        std::find_if(touches.begin(), touches.end(), [&](const Touch& touch) { return touch.object == object; });
    if (place == touches.end())
      place = std::find_if(touches.begin(), touches.end(), [](const Touch& touch) { return touch.object < 0; });
    if (place == touches.end()) continue;  // until the link has left one of the others
    place->object = object;
    sums[contact.link][static_cast<std::size_t>(place - touches.begin())] += contact.contact.n_W;
  }
  for (std::size_t link = 0; link < kHandLinks; ++link) {
    for (std::size_t i = 0; i < kBodiesOfLink; ++i)
      touches_[link][i].follow(sums[link][i], share);
  }
}

void GraspAnalysis::Touch::follow(const Eigen::Vector3d& sum_W, double share) {
  const bool touches_now = !sum_W.isZero(1e-12);
  level += share * ((touches_now ? 1.0 : 0.0) - level);
  if (level >= kCounts) counts = true;
  if (!touches_now && level < kCountsNoMore) *this = {};
  if (touches_now) n_W = ((1.0 - share) * n_W + share * sum_W.normalized()).normalized();
}

const GraspAnalysis::Touch* GraspAnalysis::touch(std::size_t link, std::int32_t object) const {
  for (const Touch& touch : touches_[link]) {
    if (touch.counts && touch.object == object) return &touch;
  }
  return nullptr;
}

Grasp GraspAnalysis::analyze(std::int32_t object, const Eigen::Vector3d& up_W) const {
  Grasp grasp;
  grasp.object = object;
  for (std::size_t link = 0; link < kHandLinks; ++link) {
    if (touch(link, object) != nullptr && meaning_[link].segment != HandSegment::kNone)
      grasp.segments.add(meaning_[link]);
  }
  grasp.type = type_of(grasp.segments);
  grasp.form = form_of(grasp, up_W);
  return grasp;
}

GraspForm GraspAnalysis::form_of(const Grasp& grasp, const Eigen::Vector3d& up_W) const {
  if (grasp.type == GraspType::kPrecision) return precision_form(grasp);
  if (carries(grasp, up_W)) return GraspForm::kGravity;
  if (grasp.type == GraspType::kPush && are_opposed(grasp)) return GraspForm::kCigarette;
  return GraspForm::kNone;
}

/// Whether two fingers at least, or the palm and a finger, carry the object, and all other contacts do as well: from
/// one finger alone it would fall. What is being carried may be touched from the side.
bool GraspAnalysis::carries(const Grasp& grasp, const Eigen::Vector3d& up_W) const {
  const double least = had(GraspForm::kGravity, grasp.object) ? -kFromBelow : kFromBelow;
  std::array<bool, 6> carrying{};  // by finger, the palm first
  for (std::size_t link = 0; link < kHandLinks; ++link) {
    const Touch* const contact = touch(link, grasp.object);
    if (contact == nullptr) continue;
    const double from_below = -contact->n_W.dot(up_W);
    if (from_below < least) return false;
    if (from_below > kFromBelow) carrying[static_cast<std::size_t>(meaning_[link].finger)] = true;
  }
  return std::count(carrying.begin(), carrying.end(), true) >= 2;
}

GraspForm GraspAnalysis::precision_form(const Grasp& grasp) const {
  const auto normal_of = [&](Finger finger, HandSegment kind) { return normal(grasp.object, {finger, kind}); };
  if (are_tips_of(grasp.segments, std::array{Finger::kThumb, Finger::kIndex})) return GraspForm::kTipPinch;
  for (std::size_t a = 1; a < kAllFingers.size(); ++a) {
    for (std::size_t b = a + 1; b < kAllFingers.size(); ++b) {
      if (!are_tips_of(grasp.segments, std::array{Finger::kThumb, kAllFingers[a], kAllFingers[b]})) continue;
      const auto n_a = normal_of(kAllFingers[a], HandSegment::kOuter);
      const auto n_b = normal_of(kAllFingers[b], HandSegment::kOuter);
      const bool one_side = n_a && n_b && n_a->dot(*n_b) > kAlike;
      if (!one_side) return GraspForm::kThreePoint;
      if (kAllFingers[a] == Finger::kIndex && kAllFingers[b] == Finger::kMiddle) return GraspForm::kThreeJaw;
    }
  }
  // The thumb's pad presses the object on the index, not on its tip.
  const bool has_only_index = !grasp.segments.has(Finger::kMiddle) && !grasp.segments.has(Finger::kRing) &&
                              !grasp.segments.has(Finger::kLittle);
  const bool on_side = grasp.segments.has({Finger::kIndex, HandSegment::kMiddle}) ||
                       grasp.segments.has({Finger::kIndex, HandSegment::kInner});
  if (has_only_index && on_side && grasp.segments.has({Finger::kThumb, HandSegment::kOuter})) return GraspForm::kKey;
  return GraspForm::kNone;
}

/// Whether exactly two neighboring fingers, none of them the thumb, touch the object from opposite sides.
bool GraspAnalysis::are_opposed(const Grasp& grasp) const {
  std::array<Eigen::Vector3d, 6> sums;
  sums.fill(Eigen::Vector3d::Zero());
  for (std::size_t link = 0; link < kHandLinks; ++link) {
    if (const Touch* const contact = touch(link, grasp.object))
      sums[static_cast<std::size_t>(meaning_[link].finger)] += contact->n_W;
  }
  const auto has = [&](Finger finger) { return grasp.segments.has(finger); };
  if (has(Finger::kNone) || has(Finger::kThumb)) return false;
  const auto first = std::find_if(kAllFingers.begin(), kAllFingers.end(), has);
  if (std::count_if(first, kAllFingers.end(), has) != 2 || !has(*(first + 1))) return false;
  const auto n_W = [&](Finger finger) { return sums[static_cast<std::size_t>(finger)].normalized(); };
  const double limit = had(GraspForm::kCigarette, grasp.object) ? kOpposedStill : kOpposed;
  return n_W(*first).dot(n_W(*(first + 1))) < limit;
}

std::optional<Eigen::Vector3d> GraspAnalysis::normal(std::int32_t object, const SegmentMeaning& segment) const {
  for (std::size_t link = 0; link < kHandLinks; ++link) {
    if (meaning_[link].finger != segment.finger || meaning_[link].segment != segment.segment) continue;
    if (const Touch* const contact = touch(link, object)) return contact->n_W;
  }
  return std::nullopt;
}

}  // namespace glissade::grasping
