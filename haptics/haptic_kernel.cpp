#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include <glissade/base/assert.h>
#include <glissade/contact/multi_part_sliding.h>
#include <glissade/contact/spring.h>
#include <glissade/haptics/haptic_kernel.h>

#include "loop/contact_projection.h"
#include "loop/half_spaces_of_hand.h"
#include "loop/hand_in_device.h"
#include "loop/hand_ledger.h"
#include "loop/holds.h"
#include "loop/loop_settings.h"
#include "loop/usable_set.h"

namespace glissade::haptics {

namespace {

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

bool takes_half_spaces(const HandInDevice& hand) {
  return hand.envelope.descriptor().tool_command == devices::ToolCommand::kHalfSpaces;
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

/// The tick of one hand, while it is computed.
struct HapticKernel::Rendering {
  std::size_t number;  // of the hand
  const devices::GloveState& state;
  const ContactSet& set;
  std::chrono::nanoseconds age;  // of the set
  double dt;                     // s
  bool has_pose;
  HandTick tick{};
  PartContacts contacts{};
  Eigen::Vector3d p_WH{};
  Eigen::Vector3d p_Wref{};
  double lever = 0.0;     // m
  double softness = 1.0;  // share of the coupling's force that is left

  /// The part in the hand; of a hand without one, the first.
  std::size_t part() const { return tick.part.value_or(0); }
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
    ContactForce contacts(parts_.front().radius, couplings.front().stiffness, kLoop.headroom * hand.device.max_force);
    std::optional<FingersOfHand> fingers;
    if (hand.fingers) fingers.emplace(*hand.fingers, hand.device, period);
    hands_.push_back(std::make_unique<HandInDevice>(
        HandInDevice{.couplings = couplings,
                     .present = couplings.front(),
                     .contacts = contacts,
                     .envelope = devices::SafetyEnvelope(hand.device, kLoop.patience_periods, period),
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
  for (const std::unique_ptr<HandInDevice>& hand : hands_)
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
    HandInDevice& hand = *hands_[h];
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
  HandInDevice& hand = *hands_[number];
  const bool is_closed = state.grip % 2 == 1;
  const bool is_first = hand.told_sequence < 0;
  if (state.sequence < hand.told_sequence) hand.grip.reset();  // the glove was started again, and counts anew
  if (state.sequence != hand.told_sequence) {
    hand.told_states = !is_first && state.grip == hand.told_grip ? hand.told_states + 1 : 1;
    hand.told_grip = state.grip;
    hand.told_sequence = state.sequence;
  }
  if (is_first && !is_closed) holds_->release(number);  // it does not take the part that it was given
  if (hand.told_states < kLoop.grip_states || hand.is_fading || hand.grip == state.grip) return;
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
  HandInDevice& hand = *hands_[number];
  Rendering r{.number = number, .state = state, .set = set, .age = age, .dt = dt, .has_pose = has_pose(state)};
  r.tick.part = holds_->part_of(number);
  refer(hand, r);
  exert(hand, r);
  devices::GloveCommand command;
  command.sequence = ++hand.sequence;
  command.state_sequence = state.sequence;
  command.state_time = state.time;
  command.time = now;
  command.supply = book(hand, r);
  fill(hand, r, command);
  r.tick.command = hand.envelope.limit(command, state, now);
  hand.is_fading = r.tick.command.reasons().is_fading();
  hand.taken = r.tick.command.taken();
  return r.tick;
}

/// Where the hand and its reference point are, and how soft the coupling is there.
void HapticKernel::refer(HandInDevice& hand, Rendering& r) noexcept {
  const std::size_t p = r.part();
  const KernelPart& part = parts_[p];
  const Eigen::Vector3d& p_Vref = r.set.parts[p].p_Vref;
  const bool is_new = r.tick.part != hand.last_part;
  r.p_WH = r.has_pose ? Eigen::Vector3d(r.state.X_WH.translation()) : hand.p_Wref;
  r.lever = part.radius + (p_Vref - part.p_Vref).norm();  // no point of the part is farther from p_Vref
  r.p_Wref = r.tick.part ? Eigen::Vector3d(holds_->ghost_of_hand(r.number) * p_Vref) : r.p_WH;
  r.softness = hand.soften(hand.couplings[p], period_, r.state.link_delay, (r.p_Wref - r.p_WH).norm(),
                           r.tick.part && contacts_->meets_led_part(p), is_new, r.dt);
  if (is_new || p_Vref != hand.p_Vref) {
    hand.contacts.move_reference(hand.p_Wref, r.p_Wref);
    hand.owed = 0.0;
    hand.pull = {};
    hand.solved = {};
  }
  hand.last_part = r.tick.part;
  hand.p_Vref = p_Vref;
  hand.p_Wref = r.p_Wref;
}

/// The force of the contacts, and the pull of other hands.
void HapticKernel::exert(HandInDevice& hand, Rendering& r) noexcept {
  double motion = 0.0;
  if (r.tick.part) {
    const std::size_t p = r.part();
    const contact::CouplingStiffness& stiffness = hand.couplings[p].stiffness;
    hand.contacts.hold(r.lever, {r.softness * stiffness.translational, r.softness * stiffness.rotational});
    r.contacts = contacts_->of_part(p);
    r.contacts.wrench = scaled(holds_->on_hand(r.number, r.contacts.wrench), r.softness);
    motion = holds_->ghost_motion(p, r.lever);
    r.tick.pull = scaled(holds_->pull_on(r.number), r.softness);
    const double pull = r.tick.pull.f.norm();
    const double most = kLoop.headroom * hand.envelope.descriptor().max_force;
    if (pull > most) r.tick.pull = scaled(r.tick.pull, most / pull);
    if (takes_half_spaces(hand)) r.tick.pull = {};
  }
  r.tick.contacts = hand.contacts.update(r.contacts, r.age, motion, r.dt);
  r.tick.contact_share = hand.contacts.share();
  r.tick.is_unsolved = r.contacts.is_unsolved;
}

/// The energy that this tick gives to the hand or takes from it. Returns the supply (`GloveCommand::supply`).
double HapticKernel::book(HandInDevice& hand, const Rendering& r) noexcept {
  const contact::Wrench& exerted = r.tick.contacts;
  const contact::Wrench& withheld = hand.contacts.withheld();
  if (!r.tick.is_unsolved) hand.solved = {exerted.f + withheld.f, exerted.t + withheld.t};
  if (hand.solved.f.isZero(0.0) && hand.solved.t.isZero(0.0)) hand.owed = 0.0;
  const double against_exerted = holds_->work_against(r.number, exerted);
  // Without a solution, what the contacts exerted before stands for what they would exert.
  const double against_withheld = r.tick.is_unsolved ? holds_->work_against(r.number, hand.solved) - against_exerted
                                                     : holds_->work_against(r.number, withheld);
  const double share = r.softness * share_of(exerted.f, r.contacts.wrench.f) * holds_->supply_share(r.number);
  // The pull of the last tick acted on this way.
  const double of_pull = -holds_->work_against(r.number, std::exchange(hand.pull, r.tick.pull));
  const double lifted = hand.lift(against_withheld, against_exerted, r.dt);
  ledger_->collect(r.number, r.state.taken.value_or(hand.taken));
  return ledger_->book(r.number, {.from_hands = of_pull + share * r.contacts.from_hands,
                                  .from_elsewhere = lifted + share * r.contacts.from_movers});
}

/// The wanted wrench or half-spaces of the hand root, and the torques or limits of the joints.
void HapticKernel::fill(HandInDevice& hand, const Rendering& r, devices::GloveCommand& command) noexcept {
  const HandTick& tick = r.tick;
  if (takes_half_spaces(hand)) {
    hold(hand, r);
    command.half_spaces = hand.half_spaces;
  } else if (r.has_pose) {
    const Eigen::Vector3d v_Wref = r.state.v_WH + r.state.w_WH.cross(r.p_Wref - r.p_WH);
    const contact::Wrench damping = damper_wrench(hand.present.damping, tick.contacts, v_Wref, r.state.w_WH);
    const contact::Wrench on_hand = contact::about_point(
        {tick.contacts.f + damping.f + tick.pull.f, tick.contacts.t + damping.t + tick.pull.t}, r.p_Wref, r.p_WH);
    command.f_H_W = on_hand.f;
    command.t_H_W = on_hand.t;
  }
  if (hand.fingers && hand.fingers->takes_limits()) {
    command.joint_limits = hand.fingers->limits(r.set.hands[r.number], r.age, r.dt);
  } else if (hand.fingers) {
    const FingerLoad::Load load{tick.part ? static_cast<std::int32_t>(*tick.part) : -1,
                                {tick.contacts.f + tick.pull.f, tick.contacts.t + tick.pull.t},
                                r.p_Wref,
                                r.lever};
    command.joint_torques = hand.fingers->torques(r.state, r.set.hands[r.number], r.age, load, r.dt);
  }
}

/// The half-spaces that exert the force of the contacts. Where this force is not yet or no longer that of the contacts,
/// it bounds the force of the half-spaces, as the share of an old set does.
void HapticKernel::hold(HandInDevice& hand, const Rendering& r) noexcept {
  const devices::DeviceDescriptor& device = hand.envelope.descriptor();
  const contact::CouplingStiffness& K = hand.couplings[r.part()].stiffness;
  const double exerted = spring_size(r.tick.contacts, K);
  const double demanded = spring_size(r.contacts.wrench, K);
  constexpr double kRounding = 1e-9;
  if (exerted > demanded * (1.0 + kRounding)) {  // contacts that vanished under the hand
    hand.half_spaces.max_force = exerted;
    return;
  }
  hand.half_spaces = {};
  if (!r.tick.part || !r.has_pose) return;
  std::array<contact::ConstraintRow, devices::kMaxHalfSpaces> rows;
  const std::size_t count = contacts_->constraints_of(*r.tick.part, rows);
  const Coupling coupling{{r.softness * K.translational, r.softness * K.rotational}, hand.present.damping};
  hand.half_spaces = half_spaces_of_hand(r.state.X_WH, holds_->ghost_of_hand(r.number), r.set.parts[*r.tick.part],
                                         {rows.data(), count}, coupling);
  const double most = r.tick.contact_share * device.max_force;
  hand.half_spaces.max_force = exerted < demanded * (1.0 - kRounding) ? std::min(exerted, most) : most;
  hand.half_spaces.max_torque = device.max_torque;
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
