#include <glissade/apps/run/force_reason.h>
#include <glissade/haptics/contact_set.h>

namespace glissade::apps {

namespace {

/// The limits that a user can do something about. A force returns softly, and changes no faster than its rate, at every
/// contact.
devices::LimitReasons limits_to_tell(devices::LimitReasons reasons) noexcept {
  reasons.is_returning = false;
  reasons.rate_limited = false;
  return reasons;
}

}  // namespace

std::size_t ForceReason::kind() const noexcept {
  constexpr std::size_t kReasons = devices::kLimitReasons.size();
  std::size_t first = 0;
  while (first < kReasons && !(reasons.*devices::kLimitReasons[first].flag))
    ++first;
  return cause == Cause::kNone ? 0 : static_cast<std::size_t>(cause) * (kReasons + 1) + first;
}

ForceReason force_reason(const devices::HapticState& state, std::size_t number) noexcept {
  using Cause = ForceReason::Cause;
  const devices::HapticHandState& hand = state.hands[number];
  if (hand.reasons.is_fading()) return {Cause::kEnvelope, hand.reasons, hand.state_age};
  if (state.contact_set_age > haptics::kFullForce) return {Cause::kOldContacts, {}, state.contact_set_age};
  if (hand.glove_reasons.is_fading()) return {Cause::kGlove, hand.glove_reasons, hand.command_age};
  if (hand.are_contacts_unsolved) return {.cause = Cause::kUnsolved};
  if (hand.part >= 0 && hand.contact_share < 0.5) return {.cause = Cause::kLagging};
  if (limits_to_tell(hand.reasons).any()) return {Cause::kLimit, limits_to_tell(hand.reasons), hand.state_age};
  if (!limits_to_tell(hand.glove_reasons).any()) return {};
  return {Cause::kLimitAtGlove, limits_to_tell(hand.glove_reasons), hand.command_age};
}

ForceReason recorded_reason(const devices::HapticState& state, std::size_t number) noexcept {
  using Cause = ForceReason::Cause;
  const ForceReason told = force_reason(state, number);
  const devices::HapticHandState& hand = state.hands[number];
  if (told.cause != Cause::kNone) return told;
  if (hand.reasons.any()) return {Cause::kLimit, hand.reasons, hand.state_age};
  if (hand.glove_reasons.any()) return {Cause::kLimitAtGlove, hand.glove_reasons, hand.command_age};
  return {};
}

ForceReason force_reason(const devices::SafeCommand& command) noexcept {
  using Cause = ForceReason::Cause;
  const devices::LimitReasons& reasons = command.reasons();
  if (reasons.is_fading())
    return {Cause::kEnvelope, reasons, reasons.is_state_old ? command.state_age() : command.age()};
  if (!limits_to_tell(reasons).any()) return {};
  return {Cause::kLimit, limits_to_tell(reasons), command.age()};
}

std::string to_text(const ForceReason& reason) {
  using Cause = ForceReason::Cause;
  switch (reason.cause) {
    case Cause::kNone:
      break;
    case Cause::kEnvelope:
    case Cause::kLimit:
      return devices::to_text(reason.reasons, reason.age);
    case Cause::kOldContacts:
      return "reduced force: the simulation's contacts are " +
             std::to_string(reason.age / std::chrono::milliseconds(1)) + " ms old";
    case Cause::kGlove:
      if (reason.reasons.is_stopped) return "no force: the glove has ended or was stopped for good";
      // The glove tells the age of the command only.
      if (reason.reasons.is_state_old) return "at the glove: no force: the glove's state is old";
      return "at the glove: " + devices::to_text(reason.reasons, reason.age);
    case Cause::kLimitAtGlove:
      return "at the glove: " + devices::to_text(reason.reasons, reason.age);
    case Cause::kUnsolved:
      return "reduced force: no pose of the part satisfies all contacts";
    case Cause::kLagging:
      return "reduced force: the part lags behind the hand or has just caught up";
  }
  return {};
}

}  // namespace glissade::apps
