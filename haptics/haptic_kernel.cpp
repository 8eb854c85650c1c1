#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include <glissade/base/assert.h>
#include <glissade/contact/multi_part_sliding.h>
#include <glissade/contact/spring.h>
#include <glissade/haptics/haptic_kernel.h>

#include "loop/contact_force.h"
#include "loop/contact_projection.h"
#include "loop/fingers_of_hand.h"
#include "loop/hand_ledger.h"
#include "loop/holds.h"
#include "loop/usable_set.h"

namespace glissade::haptics {

namespace {

constexpr double kPatiencePeriods = 3.0;
constexpr int kGripStates = 3;
constexpr double kHeadroom = 1.05;  // contacts may demand a little more than the device gives: the envelope tells that

void check_count(std::size_t count, std::size_t most, const std::string& what) {
  if (count > 0 && count <= most) return;
  throw std::invalid_argument("a haptic loop for " + std::to_string(count) + " " + what +
                              " is not possible; it takes 1 to " + std::to_string(most));
}

/// How much of a wanted force is exerted: 0 to 1.
double share_of(const Eigen::Vector3d& exerted, const Eigen::Vector3d& wanted) {
  const double square = wanted.squaredNorm();
  return square > 0.0 ? std::clamp(exerted.dot(wanted) / square, 0.0, 1.0) : 0.0;
}

bool has_pose(const devices::GloveState& state) {
  return state.X_WH.matrix().allFinite() && state.v_WH.allFinite() && state.w_WH.allFinite();
}

}  // namespace

std::vector<KernelPart> kernel_parts(const contact::MultiPartSliding& sliding) {
  std::vector<KernelPart> parts;
  for (std::size_t p = 0; p < sliding.part_count(); ++p) {
    const contact::SlidingPart& part = sliding.part(p);
    parts.push_back({part.p_Vref(), part.radius(), sliding.stiffness(p), sliding.is_scripted(p)});
  }
  return parts;
}

/// A hand with its device.
struct HapticKernel::Hand {
  std::array<Coupling, contact::kMaxParts> couplings{};  // one for each part that can be held
  Coupling present{};
  double link_delay_s = 0.0;
  double lever_m = 0.0;  // from the hand to the reference point, smoothed
  ContactForce contacts;
  devices::SafetyEnvelope envelope;
  bool is_fading = false;                            // in the last tick
  std::optional<std::size_t> given;                  // the part for its first grip
  std::optional<std::size_t> last_part;              // that it held in the last tick
  Eigen::Vector3d p_Vref = Eigen::Vector3d::Zero();  // the reference point in the last tick
  Eigen::Vector3d p_Wref = Eigen::Vector3d::Zero();  // about which the contacts' wrench was in the last tick
  std::optional<std::int64_t> grip;                  // that the hand has followed
  std::int64_t told_grip = 0;                        // of the last states, so many in a row
  int told_states = 0;
  std::int64_t told_sequence = -1;
  std::int64_t sequence = 0;
  double owed = 0.0;     // J: work of the hand against force that was withheld, as far as it has not been lifted again
  double lifts = 1.0;    // J, for which the hand may be lifted; many interruptions use it up
  double taken = 0.0;    // `SafeCommand::taken` of the last command
  contact::Wrench pull;  // of other hands in the last command
  contact::Wrench solved;  // of the contacts when they last had a solution
  std::optional<FingersOfHand> fingers;

  /// A hand that sinks while the force of its contacts is withheld is lifted when it returns, as if it had sunk against
  /// the force. From the work against the withheld and the exerted force in this tick, the energy to lift it with.
  double lift(double against_withheld, double against_exerted, double dt) noexcept {
    constexpr double kMostLifts_J = 1.0;
    constexpr double kRecovery_W = 0.1;
    owed = std::max(0.0, owed + against_withheld);
    lifts = std::min(kMostLifts_J, lifts + kRecovery_W * dt);
    const double lifted = std::clamp(-against_exerted, 0.0, std::min(owed, lifts));
    owed -= lifted;
    lifts -= lifted;
    return lifted;
  }

  /// Adapts the present coupling to the delay of the link and to the distance of the part's reference point. Returns
  /// the share of the coupling's force that is left: force and torque shrink alike, so that the wrench stays a sum of
  /// contact normals. It applies to what is wanted from now on: a force that is there falls from where it is.
  double soften(const Coupling& coupling, std::chrono::nanoseconds period, std::chrono::nanoseconds link_delay,
                double distance, bool is_new, double dt) noexcept {
    constexpr double kTime_s = 0.1;
    constexpr double kMost_s = 1.0;
    constexpr double kFastest_m_per_s = 10.0;
    const double delay_s = std::clamp(std::chrono::duration<double>(link_delay).count(), 0.0, kMost_s);
    link_delay_s += std::min(1.0, dt / kTime_s) * (delay_s - link_delay_s);
    if (std::isfinite(distance)) {
      // A state that is wrong for a moment moves it little.
      const double most = is_new ? distance + lever_m : kFastest_m_per_s * dt;
      lever_m += std::clamp((is_new ? 1.0 : std::min(1.0, dt / kTime_s)) * (distance - lever_m), -most, most);
    }
    const auto delay =
        std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(link_delay_s));
    present = coupling_within_limits(envelope.descriptor(), coupling.stiffness, period, delay, lever_m);
    if (fingers) fingers->set_link_delay(delay);
    return std::min(present.stiffness.translational / coupling.stiffness.translational,
                    present.stiffness.rotational / coupling.stiffness.rotational);
  }
};

HapticKernel::HapticKernel(std::vector<KernelPart> parts, const std::vector<KernelHand>& hands,
                           std::chrono::nanoseconds period)
    : parts_(std::move(parts)), period_(period) {
  check_count(hands.size(), hands::kMaxHands, "hands");
  check_count(parts_.size(), contact::kMaxParts, "parts");
  std::vector<std::array<contact::CouplingStiffness, contact::kMaxParts>> stiffness;
  for (const KernelHand& hand : hands) {
    std::array<Coupling, contact::kMaxParts> couplings{};
    std::array<contact::CouplingStiffness, contact::kMaxParts>& of_hand = stiffness.emplace_back();
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      couplings[p] = coupling_for(hand.device, parts_[p].stiffness, period);
      of_hand[p] = couplings[p].stiffness;
    }
    ContactForce contacts(parts_.front().radius, couplings.front().stiffness, kHeadroom * hand.device.max_force);
    std::optional<FingersOfHand> fingers;
    if (hand.fingers) fingers.emplace(*hand.fingers, hand.device, period);
    hands_.push_back(
        std::make_unique<Hand>(Hand{.couplings = couplings,
                                    .present = couplings.front(),
                                    .contacts = contacts,
                                    .envelope = devices::SafetyEnvelope(hand.device, kPatiencePeriods, period),
                                    .fingers = std::move(fingers)}));
  }
  contacts_ = std::make_unique<ContactProjection>(parts_.size());
  ledger_ = std::make_unique<HandLedger>();
  holds_ = std::make_unique<Holds>(parts_.size(), std::move(stiffness));
  for (std::size_t h = 0; h < hands.size(); ++h) {
    if (!hands[h].part) continue;
    if (hands[h].fingers)
      throw std::invalid_argument("hand " + std::to_string(h) + " has fingers, so it is given no part: it takes hold");
    const bool can_hold = grasp(h, *hands[h].part);
    hands_[h]->given = hands[h].part;
    if (can_hold) continue;
    throw std::invalid_argument("hand " + std::to_string(h) + " cannot hold part " + std::to_string(*hands[h].part));
  }
}

HapticKernel::~HapticKernel() = default;

bool HapticKernel::can_grasp(std::size_t hand, std::size_t part) const noexcept {
  return hand < hands_.size() && !hands_[hand]->fingers && part < parts_.size() && !parts_[part].is_scripted;
}

bool HapticKernel::grasp(std::size_t hand, std::size_t part) noexcept {
  if (!can_grasp(hand, part)) return false;
  hands_[hand]->given.reset();
  holds_->grasp(hand, part);
  return true;
}

void HapticKernel::release(std::size_t hand) noexcept {
  if (hand >= hands_.size() || hands_[hand]->fingers) return;
  hands_[hand]->given.reset();
  holds_->release(hand);
}

void HapticKernel::stop() noexcept {
  for (const std::unique_ptr<Hand>& hand : hands_)
    hand->envelope.stop();
}

const Coupling& HapticKernel::coupling(std::size_t hand, std::size_t part) const {
  GLISSADE_ASSERT(hand < hands_.size() && part < parts_.size());
  return hands_[hand]->couplings[part];
}

const Coupling& HapticKernel::present_coupling(std::size_t hand) const {
  GLISSADE_ASSERT(hand < hands_.size());
  return hands_[hand]->present;
}

const ContactSet& HapticKernel::usable(const ContactSet& set) noexcept {
  const std::span<const PartAnswer> parts{set.parts.data(), parts_.size()};
  const std::span<const HandAnswer> hands{set.hands.data(), hands_.size()};
  if (!is_usable(parts, set.rows(), hands)) return last_poses_;
  std::copy(parts.begin(), parts.end(), last_poses_.parts.begin());
  for (std::size_t h = 0; h < hands.size(); ++h) {
    HandAnswer& last = last_poses_.hands[h];
    last.visible = hands[h].visible;
    last.part = hands[h].part;
    last.decision = hands[h].decision;
  }
  return set;
}

HapticTick HapticKernel::tick(std::span<const devices::GloveState* const> states, const ContactSet& newest,
                              std::chrono::nanoseconds now) noexcept {
  GLISSADE_ASSERT(states.size() == hands_.size());
  const ContactSet& set = usable(newest);
  const double dt = seconds_since_last_tick(now);
  std::array<HandPose, hands::kMaxHands> poses;
  for (std::size_t h = 0; h < hands_.size(); ++h) {
    if (states[h] == nullptr) continue;
    // Judged before the pose can move anything that another hand feels.
    Hand& hand = *hands_[h];
    const bool is_trusted = hand.envelope.trusts(*states[h], now) && has_pose(*states[h]) &&
                            !(hand.fingers && !FingersOfHand::have_angles(*states[h]));
    poses[h].is_fading = hand.is_fading || !is_trusted;
    if (!is_trusted) continue;
    if (hand.fingers) {
      hand.fingers->move_palm(*states[h], dt);
      poses[h].X_WH = &hand.fingers->X_WP();
      follow_decision(h, set.hands[h]);
    } else {
      poses[h].X_WH = &states[h]->X_WH;
      follow_grip(h, *states[h], set);
    }
  }
  holds_->update({poses.data(), hands_.size()}, set, dt);
  const std::chrono::nanoseconds age = set.sequence == 0 ? std::chrono::nanoseconds(0) : now - set.time;
  contacts_->update(set, age, holds_->led(), dt);
  ledger_->begin_tick(dt);

  HapticTick tick;
  tick.ghosts.time = now;
  for (std::size_t p = 0; p < parts_.size(); ++p)
    tick.ghosts.parts[p] = holds_->ghost(p);
  for (std::size_t h = 0; h < hands_.size(); ++h) {
    if (states[h] != nullptr) tick.hands[h] = render(h, *states[h], set, age, now, dt);
    if (!hands_[h]->fingers) continue;
    const bool is_trusted = poses[h].X_WH != nullptr;
    hands_[h]->fingers->note(is_trusted ? states[h] : nullptr, tick.hands[h].part, dt);
    tick.ghosts.hands[h] = hands_[h]->fingers->ghost();
  }
  return tick;
}

/// What the contacts say counts, and no grip.
void HapticKernel::follow_decision(std::size_t number, const HandAnswer& answer) noexcept {
  if (!hands_[number]->fingers->is_new(answer.decision)) return;
  const auto part = static_cast<std::size_t>(answer.part);
  if (answer.part >= 0 && part < parts_.size() && !parts_[part].is_scripted) {
    holds_->grasp(number, part);
  } else {
    holds_->release(number);
  }
}

/// One state alone may be wrong, and one while the force fades too.
void HapticKernel::follow_grip(std::size_t number, const devices::GloveState& state, const ContactSet& set) noexcept {
  Hand& hand = *hands_[number];
  const bool is_closed = state.grip % 2 == 1;
  const bool is_first = hand.told_sequence < 0;
  if (state.sequence < hand.told_sequence) hand.grip.reset();  // the glove was started again, and counts anew
  if (state.sequence != hand.told_sequence) {
    hand.told_states = !is_first && state.grip == hand.told_grip ? hand.told_states + 1 : 1;
    hand.told_grip = state.grip;
    hand.told_sequence = state.sequence;
  }
  if (is_first && !is_closed) holds_->release(number);  // it does not take the part that it was given
  if (hand.told_states < kGripStates || hand.is_fading || hand.grip == state.grip) return;
  const bool counts_anew = !hand.grip;
  hand.grip = state.grip;
  if (counts_anew && is_closed) {
    if (hand.given && !holds_->part_of(number)) grasp(number, *hand.given);
    return;
  }
  release(number);
  if (!is_closed) return;
  if (const auto part = nearest_part(state.X_WH.translation(), set)) grasp(number, *part);
}

std::optional<std::size_t> HapticKernel::nearest_part(const Eigen::Vector3d& p_WH,
                                                      const ContactSet& set) const noexcept {
  std::optional<std::size_t> nearest;
  double least = kGripReach_m;
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const double distance = (set.parts[p].X_WV * parts_[p].p_Vref - p_WH).norm() - parts_[p].radius;
    if (parts_[p].is_scripted || !(distance <= least)) continue;
    least = distance;
    nearest = p;
  }
  return nearest;
}

HandTick HapticKernel::render(std::size_t number, const devices::GloveState& state, const ContactSet& set,
                              std::chrono::nanoseconds age, std::chrono::nanoseconds now, double dt) noexcept {
  Hand& hand = *hands_[number];
  HandTick tick;
  tick.part = holds_->part_of(number);
  const std::size_t p = tick.part.value_or(0);
  const KernelPart& part = parts_[p];
  const Coupling& coupling = hand.couplings[p];
  const bool is_finite = has_pose(state);
  const Eigen::Vector3d p_WH = is_finite ? Eigen::Vector3d(state.X_WH.translation()) : hand.p_Wref;
  const Eigen::Vector3d& p_Vref = set.parts[p].p_Vref;
  const double lever = part.radius + (p_Vref - part.p_Vref).norm();  // no point of the part is farther from p_Vref
  const Eigen::Vector3d p_Wref = tick.part ? Eigen::Vector3d(holds_->ghost_of_hand(number) * p_Vref) : p_WH;
  const double softness =
      hand.soften(coupling, period_, state.link_delay, (p_Wref - p_WH).norm(), tick.part != hand.last_part, dt);
  if (tick.part != hand.last_part || p_Vref != hand.p_Vref) {
    hand.contacts.move_reference(hand.p_Wref, p_Wref);
    hand.owed = 0.0;
    hand.pull = {};
    hand.solved = {};
  }
  hand.last_part = tick.part;
  hand.p_Vref = p_Vref;
  hand.p_Wref = p_Wref;

  PartContacts contacts;
  double motion = 0.0;
  if (tick.part) {
    hand.contacts.hold(lever, {softness * coupling.stiffness.translational, softness * coupling.stiffness.rotational});
    contacts = contacts_->of_part(p);
    contacts.wrench = scaled(holds_->on_hand(number, contacts.wrench), softness);
    motion = holds_->ghost_motion(p, lever);
    tick.pull = scaled(holds_->pull_on(number), softness);
    const double pull = tick.pull.f.norm();
    const double most = kHeadroom * hand.envelope.descriptor().max_force;
    if (pull > most) tick.pull = scaled(tick.pull, most / pull);
  }
  tick.contacts = hand.contacts.update(contacts, age, motion, dt);
  tick.contact_share = hand.contacts.share();
  tick.is_unsolved = contacts.is_unsolved;
  if (!contacts.is_unsolved) {
    hand.solved = {tick.contacts.f + hand.contacts.withheld().f, tick.contacts.t + hand.contacts.withheld().t};
  }
  if (hand.solved.f.isZero(0.0) && hand.solved.t.isZero(0.0)) hand.owed = 0.0;
  const double against_exerted = holds_->work_against(number, tick.contacts);
  // Without a solution, what the contacts exerted before stands for what they would exert.
  const double against_withheld = contacts.is_unsolved ? holds_->work_against(number, hand.solved) - against_exerted
                                                       : holds_->work_against(number, hand.contacts.withheld());
  const double share = softness * share_of(tick.contacts.f, contacts.wrench.f) * holds_->supply_share(number);
  // The pull of the last tick acted on this way.
  const double of_pull = -holds_->work_against(number, std::exchange(hand.pull, tick.pull));
  const double lifted = hand.lift(against_withheld, against_exerted, dt);

  devices::GloveCommand command;
  command.sequence = ++hand.sequence;
  command.state_sequence = state.sequence;
  command.state_time = state.time;
  command.time = now;
  ledger_->collect(number, state.taken.value_or(hand.taken));
  command.supply = ledger_->book(number, {.from_hands = of_pull + share * contacts.from_hands,
                                          .from_elsewhere = lifted + share * contacts.from_movers});
  if (is_finite) {
    const Velocity ghost{state.v_WH + state.w_WH.cross(p_Wref - p_WH), state.w_WH};
    const contact::Wrench damping = damper_wrench(hand.present.damping, tick.contacts, ghost);
    const contact::Wrench on_hand = contact::about_point(
        {tick.contacts.f + damping.f + tick.pull.f, tick.contacts.t + damping.t + tick.pull.t}, p_Wref, p_WH);
    command.f_H_W = on_hand.f;
    command.t_H_W = on_hand.t;
  }
  if (hand.fingers) {
    const FingerLoad::Load load{tick.part ? static_cast<std::int32_t>(p) : -1,
                                {tick.contacts.f + tick.pull.f, tick.contacts.t + tick.pull.t},
                                p_Wref,
                                lever};
    command.joint_torques = hand.fingers->torques(state, set.hands[number], age, load, dt);
  }
  tick.command = hand.envelope.limit(command, state, now);
  hand.is_fading = tick.command.reasons().is_fading();
  hand.taken = tick.command.taken();
  return tick;
}

double HapticKernel::seconds_since_last_tick(std::chrono::nanoseconds now) noexcept {
  // A pause is no reason for a jump.
  const std::chrono::nanoseconds passed = last_tick_ ? now - *last_tick_ : kTickPeriod;
  last_tick_ = now;
  return std::chrono::duration<double>(
             std::clamp<std::chrono::nanoseconds>(passed, std::chrono::nanoseconds(0), kLongestTickPeriod))
      .count();
}

}  // namespace glissade::haptics
