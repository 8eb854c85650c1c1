#include <glissade/apps/reason_teller.h>
#include <glissade/haptics/contact_set.h>

namespace glissade::apps {

namespace {

/// Number of the most serious reason.
std::size_t first_reason(const devices::LimitReasons& reasons) {
  std::size_t i = 0;
  while (i < devices::kLimitReasons.size() && !(reasons.*devices::kLimitReasons[i].flag))
    ++i;
  return i;
}

}  // namespace

void ReasonTeller::note(const devices::HapticState& sample, std::size_t number) noexcept {
  const devices::HapticHandState& hand = sample.hands[number];
  Fading fading;
  if (hand.reasons.is_fading()) {
    fading = {Cause::kEnvelope, hand.reasons, hand.state_age};
  } else if (sample.contact_set_age > haptics::kFullForce) {
    fading = {Cause::kOldContacts, {}, sample.contact_set_age};
  } else if (hand.glove_reasons.is_fading()) {
    fading = {Cause::kGlove, hand.glove_reasons, hand.command_age};
  } else if (hand.are_contacts_unsolved) {
    fading.cause = Cause::kUnsolved;
  } else if (hand.part >= 0 && hand.contact_share < 0.5) {
    fading.cause = Cause::kLagging;
  }
  note(fading);
}

void ReasonTeller::note(const devices::SafeCommand& command) noexcept {
  Fading fading;
  if (command.reasons().is_fading()) fading = {Cause::kEnvelope, command.reasons(), command.age()};
  note(fading);
}

void ReasonTeller::note(const Fading& fading) noexcept {
  const bool is_fading = fading.cause != Cause::kNone;
  if (is_fading) fading_.publish(fading);
  is_fading_.store(is_fading, std::memory_order_release);
}

std::string ReasonTeller::news() {
  const bool is_fading = is_fading_.load(std::memory_order_acquire);
  if (fading_.update()) {
    const Fading& newest = fading_.value();
    const std::pair reason(newest.cause, first_reason(newest.reasons));
    if (told_ == reason) return {};
    told_ = reason;
    return text(newest);
  }
  if (is_fading || !told_) return {};
  told_.reset();
  return "the force returns";
}

std::string ReasonTeller::text(const Fading& fading) {
  switch (fading.cause) {
    case Cause::kNone:
      break;
    case Cause::kEnvelope:
      return to_text(fading.reasons, fading.age);
    case Cause::kOldContacts:
      return "reduced force: the simulation's contacts are " +
             std::to_string(fading.age / std::chrono::milliseconds(1)) + " ms old";
    case Cause::kGlove:
      return "at the glove, " + to_text(fading.reasons, fading.age);
    case Cause::kUnsolved:
      return "reduced force: no pose of the part satisfies all contacts";
    case Cause::kLagging:
      return "reduced force: the part lags behind the hand, or has just caught up";
  }
  return {};
}

}  // namespace glissade::apps
