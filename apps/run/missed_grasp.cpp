#include <tuple>

#include <glissade/apps/run/missed_grasp.h>
#include <glissade/apps/text.h>

namespace glissade::apps {

namespace {

using grasping::Finger;
using grasping::GraspLack;
using grasping::TouchingSegments;

/// Such as "the thumb alone" or "the palm and inner segments alone".
std::string pushers(const TouchingSegments& segments) {
  if (segments.has_palm()) return segments.count() == 1 ? "the palm alone" : "the palm and inner segments alone";
  std::vector<std::string> fingers;
  for (const Finger finger : {Finger::kThumb, Finger::kIndex, Finger::kMiddle, Finger::kRing, Finger::kLittle}) {
    if (segments.has(finger)) fingers.push_back("the " + std::string(grasping::name_of(finger)));
  }
  const std::string last = fingers.back();
  fingers.pop_back();
  return (fingers.empty() ? last : joined(fingers) + " and " + last) + " alone";
}

}  // namespace

void MissedGrasp::note(double time_s, const grasping::Grasp& grasp, bool holds) {
  has_held_ = has_held_ || holds;
  const GraspLack lack = grasp.lack();
  if (lack == GraspLack::kTouch) {
    present_.reset();
    return;
  }
  if (!present_ || present_->object != grasp.object || present_->lack != lack)
    present_ = {grasp.object, lack, {}, time_s, time_s};
  present_->last_s = time_s;
  present_->segments = TouchingSegments::from_bits(present_->segments.bits() | grasp.segments.bits());
  if (!longest_ || is_worth_more(*present_, *longest_)) longest_ = present_;
}

/// An object that is not known counts as one that hands can hold, until they grasp it in vain.
bool MissedGrasp::can_be_held(const Touch& touch) const {
  if (touch.lack == GraspLack::kNothing) return false;
  return touch.object < 0 || can_be_held_[static_cast<std::size_t>(touch.object)];
}

bool MissedGrasp::is_worth_more(const Touch& touch, const Touch& other) const {
  const auto rank = [&](const Touch& one) { return std::tuple(can_be_held(one), one.last_s - one.first_s); };
  return rank(touch) >= rank(other);
}

std::string MissedGrasp::text() const {
  if (has_held_) return "";
  if (!longest_) return "it touched nothing for more than a moment";
  const Touch& touch = *longest_;
  const bool is_known = touch.object >= 0;
  const std::string object = is_known ? in_quotes(names_[static_cast<std::size_t>(touch.object)]) : "something";
  const std::string when = " from " + fixed_text(touch.first_s, 3) + " to " + fixed_text(touch.last_s, 3) + " s";
  if (!can_be_held(touch)) return "it touched " + object + when + ", which no hand can hold";
  return pushers(touch.segments) + (is_known ? " pushed " : " touched ") + object + when + ": " +
         std::string(grasping::words_of(touch.lack));
}

}  // namespace glissade::apps
