#include "loop/holds.h"

#include <algorithm>

#include <glissade/contact/spring.h>
#include <glissade/geometry/displacement.h>

#include "loop/loop_settings.h"

namespace glissade::haptics {

Holds::Holds(std::size_t parts, std::vector<std::array<contact::CouplingStiffness, contact::kMaxParts>> stiffness)
    : stiffness_(std::move(stiffness)), hands_(stiffness_.size()), parts_(parts), led_(parts) {}

std::size_t Holds::holders_of(std::size_t part) const noexcept {
  return static_cast<std::size_t>(
      std::count_if(hands_.begin(), hands_.end(), [part](const Hand& hand) { return hand.part == part; }));
}

void Holds::let_go(Hand& hand) noexcept {
  if (!hand.part) return;
  const std::size_t number = *hand.part;
  Part& part = parts_[number];
  hand.part.reset();
  hand.pull = {};
  if (holders_of(number) > 0) {
    keep_target(number);
    return;
  }
  ++part.ghost.hold;
  part.X_WT_kept.reset();
  part.X_GT_kept.reset();
  part.ghost.is_held = false;
  part.ghost.release = part.ghost.hold;
}

/// The hands that hold the part have changed: its target stays until the simulation has answered.
void Holds::keep_target(std::size_t number) noexcept {
  Part& part = parts_[number];
  const LedPart& led = led_[number];
  ++part.ghost.hold;
  part.X_WT_kept.reset();
  part.X_GT_kept.reset();
  if (led.acts) part.X_WT_kept = led.X_WG * led.X_GT;
}

void Holds::take(Hand& hand, std::size_t number, const Eigen::Isometry3d& X_WH, const ContactSet& set) noexcept {
  let_go(hand);
  Part& part = parts_[number];
  const bool is_first = holders_of(number) == 0;
  hand.X_HG = X_WH.inverse() * set.parts[number].X_WV;
  hand.part = number;
  hand.weight = is_first ? 1.0 : 0.0;
  hand.is_lost = false;
  if (!is_first) {
    keep_target(number);
    return;
  }
  ++part.ghost.hold;
  part.ghost.is_held = true;
}

void Holds::update(std::span<const HandPose> poses, const ContactSet& set, double dt) noexcept {
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    parts_[p].X_WG_before = parts_[p].ghost.X_WG;
    parts_[p].p_Vref = set.parts[p].p_Vref;
  }
  for (std::size_t h = 0; h < hands_.size(); ++h) {
    Hand& hand = hands_[h];
    if (!hand.wanted || poses[h].X_WH == nullptr) continue;
    take(hand, *hand.wanted, *poses[h].X_WH, set);
    hand.wanted.reset();
    hand.lets_go = false;
  }
  for (std::size_t h = 0; h < hands_.size(); ++h) {
    Hand& hand = hands_[h];
    const Eigen::Isometry3d* const X_WH = poses[h].X_WH;
    if (hand.lets_go) let_go(hand);
    hand.lets_go = false;
    if (!hand.part) continue;
    weigh(hand, poses[h], dt);
    if (X_WH != nullptr) hand.X_WG = *X_WH * hand.X_HG;
  }
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    if (!parts_[p].ghost.is_held) {
      parts_[p].ghost.X_WG = set.parts[p].X_WV;
    } else {
      combine(p);
    }
    aim(p, set);
    parts_[p].is_set_anew = parts_[p].ghost.hold != parts_[p].hold_told;
    parts_[p].hold_told = parts_[p].ghost.hold;
  }
}

void Holds::weigh(Hand& hand, const HandPose& pose, double dt) noexcept {
  if (holders_of(*hand.part) == 1) {
    hand.weight = 1.0;
    hand.is_lost = false;
    return;
  }
  if (pose.is_fading) {
    hand.weight = std::max(0.0, hand.weight - dt / kLoop.leaves_s);
    hand.is_lost = hand.is_lost || hand.weight == 0.0;
    return;
  }
  if (hand.is_lost && pose.X_WH != nullptr) {
    hand.X_HG = pose.X_WH->inverse() * parts_[*hand.part].ghost.X_WG;
    hand.is_lost = false;
  }
  hand.weight = std::min(1.0, hand.weight + dt / kLoop.joins_s);
}

/// Finds the ghost of a part that is held, and what each hand has of it.
void Holds::combine(std::size_t number) noexcept {
  const Eigen::Vector3d& p_Vref = parts_[number].p_Vref;
  LedPart& led = led_[number];
  // Rotations differ from those of the hand with the greatest weight: a lost hand may be half a turn away from the
  // others.
  const Hand* base = nullptr;
  contact::CouplingStiffness sum{0.0, 0.0};
  geometry::Displacement mean{};  // from the ghost of `base`
  for (std::size_t h = 0; h < hands_.size(); ++h) {
    const Hand& hand = hands_[h];
    if (hand.part != number || (base != nullptr && hand.weight <= base->weight)) continue;
    base = &hand;
    led.X_WG = hand.X_WG;
    led.stiffness = stiffness_[h][number];
  }
  for (std::size_t h = 0; h < hands_.size(); ++h) {
    const Hand& hand = hands_[h];
    if (hand.part != number) continue;
    const contact::CouplingStiffness& k = stiffness_[h][number];
    if (&hand != base) {
      const geometry::Displacement d = geometry::displacement_between(base->X_WG, hand.X_WG, p_Vref);
      mean.v += hand.weight * k.translational * d.v;
      mean.w += hand.weight * k.rotational * d.w;
    }
    sum.translational += hand.weight * k.translational;
    sum.rotational += hand.weight * k.rotational;
  }
  const bool is_shared = holders_of(number) > 1 && sum.translational > 0.0;
  if (holders_of(number) > 1 && !is_shared) led.X_WG = parts_[number].X_WG_before;  // all are lost: nobody moves it
  if (is_shared) {
    mean.v /= sum.translational;
    mean.w /= sum.rotational;
    led.X_WG = geometry::displaced(base->X_WG, p_Vref, mean);
    led.stiffness = sum;
  }
  parts_[number].ghost.X_WG = led.X_WG;
  for (std::size_t h = 0; h < hands_.size(); ++h) {
    Hand& hand = hands_[h];
    if (hand.part != number) continue;
    hand.force_share = 1.0;
    hand.torque_share = 1.0;
    hand.pull = {};
    if (!is_shared) continue;
    const contact::CouplingStiffness own{hand.weight * stiffness_[h][number].translational,
                                         hand.weight * stiffness_[h][number].rotational};
    hand.force_share = own.translational / sum.translational;
    hand.torque_share = own.rotational / sum.rotational;
    hand.pull = contact::spring_wrench(own, geometry::displacement_between(led.X_WG, hand.X_WG, p_Vref));
  }
}

/// Finds the target of a part in the frame of its ghost.
void Holds::aim(std::size_t number, const ContactSet& set) noexcept {
  Part& part = parts_[number];
  LedPart& led = led_[number];
  led.acts = false;
  if (!part.ghost.is_held) return;
  if (set.parts[number].hold == part.ghost.hold) {
    part.X_GT_kept.reset();
    led.X_GT = set.parts[number].X_GT;
    led.acts = true;
    return;
  }
  if (part.X_WT_kept) {
    part.X_GT_kept = led.X_WG.inverse() * *part.X_WT_kept;
    part.X_WT_kept.reset();
  }
  if (!part.X_GT_kept) return;
  led.X_GT = *part.X_GT_kept;
  led.acts = true;
}

contact::Wrench Holds::on_hand(std::size_t hand, const contact::Wrench& contacts) const {
  return {hands_[hand].force_share * contacts.f, hands_[hand].torque_share * contacts.t};
}

/// From the ghost in the last tick to that in this one.
geometry::Displacement Holds::ghost_way(std::size_t number) const {
  const Part& part = parts_[number];
  if (part.is_set_anew) return {};
  return geometry::displacement_between(part.X_WG_before, part.ghost.X_WG, part.p_Vref);
}

double Holds::ghost_motion(std::size_t number, double radius) const {
  return geometry::motion_bound(ghost_way(number), radius);
}

double Holds::work_against(std::size_t hand, const contact::Wrench& wrench) const {
  if (!hands_[hand].part) return 0.0;
  const geometry::Displacement way = ghost_way(*hands_[hand].part);
  return -wrench.f.dot(way.v) - wrench.t.dot(way.w);
}

}  // namespace glissade::haptics
