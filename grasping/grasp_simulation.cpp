#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include <glissade/base/assert.h>
#include <glissade/grasping/grasp_simulation.h>

#include "life/grasping_hand.h"
#include "life/loose_parts.h"

namespace glissade::grasping {
namespace {

constexpr double kUnitTolerance = 1e-6;

ClaspRules rules_of_hands(const GraspRules& rules) {
  ClaspRules of_hands = rules.clasp;
  if (!of_hands.work_budget) of_hands.work_budget = work_of_hand(rules.sliding);
  return of_hands;
}

std::vector<contact::Metaphor> metaphors_of(const std::vector<contact::HeldPart>& parts) {
  std::vector<contact::Metaphor> metaphors;
  for (const contact::HeldPart& part : parts)
    metaphors.push_back(part.metaphor);
  return metaphors;
}

std::vector<contact::RiderChain> chains_of(const std::vector<GraspingHand>& hands, double margin) {
  std::vector<contact::RiderChain> chains;
  for (const GraspingHand& hand : hands)
    chains.push_back({hand.clasp().bodies(), margin});
  return chains;
}

hands::HandActivity activity_of(const GraspingHand& hand) {
  if (hand.part()) return hands::HandActivity::kHolding;
  if (hand.is_lost()) return hands::HandActivity::kLost;
  return hand.is_present() ? hands::HandActivity::kFree : hands::HandActivity::kWaiting;
}

}  // namespace

class GraspSimulation::Life {
 public:
  Life(const std::vector<contact::Obstacle>& fixed, const std::vector<contact::HeldPart>& parts,
       const std::vector<std::shared_ptr<const HandModel>>& hands, const GraspRules& rules)
      : up_W_(rules.up_W),
        hands_(make_hands(hands, fixed, parts, rules_of_hands(rules))),
        parts_(fixed, parts, rules.sliding, chains_of(hands_, rules.clasp.margin)),
        X_WG_(parts.size(), Eigen::Isometry3d::Identity()),
        loose_parts_(metaphors_of(parts)),
        is_led_(parts.size(), hands.empty() ? 1 : 0),
        decisions_(hands.size()) {
    if (hands.size() > hands::kMaxHands)
      throw std::invalid_argument("at most " + std::to_string(hands::kMaxHands) + " hands can grasp, not " +
                                  std::to_string(hands.size()));
    if (!(std::abs(up_W_.norm() - 1.0) <= kUnitTolerance))
      throw std::invalid_argument("the direction against gravity must be a unit vector");
    for (std::size_t p = 0; p < parts.size() && !hands_.empty(); ++p) {
      if (!parts_.is_scripted(p)) parts_.release(p);
      for (GraspingHand& hand : hands_)
        hand.clasp().place_free_object(p, parts_.result(p).X_WV);
    }
  }

  std::size_t hand_count() const { return hands_.size(); }
  const GraspingHand& hand(std::size_t number) const {
    GLISSADE_ASSERT(number < hands_.size());
    return hands_[number];
  }
  const contact::MultiPartSliding& parts() const { return parts_; }

  void advance(std::span<const std::optional<Posture>> targets, double milliseconds) {
    GLISSADE_ASSERT(targets.size() == hands_.size());
    for (std::size_t h = 0; h < hands_.size(); ++h) {
      if (aim(h, targets[h], milliseconds) && hands_[h].part()) settle(*hands_[h].part());
    }
    for (std::size_t p = 0; p < X_WG_.size(); ++p)
      X_WG_[p] = is_held(p) ? wish(p).value_or(X_WG_[p])
                            : loose_parts_.push(p, milliseconds, parts_);  // held: where it was if all hands are lost
    move(milliseconds);
    for (std::size_t h = 0; h < hands_.size(); ++h) {
      const std::optional<std::size_t> before = hands_[h].part();
      if (!hold(h, wanted_part(h))) continue;
      if (before) settle(*before);
      if (hands_[h].part()) settle(*hands_[h].part());
    }
    for (std::size_t p = 0; p < X_WG_.size(); ++p) {
      if (!is_held(p)) loose_parts_.look(p, hands_, parts_);
    }
  }

  void move_cart(std::size_t h, const Posture& posture) {
    GLISSADE_ASSERT(h < hands_.size());
    const std::optional<std::size_t> held = hands_[h].part();
    if (hold(h, std::nullopt)) settle(*held);
    vanish(h);
    hands_[h].clasp().move_cart(posture);
  }

  void advance(std::span<const Eigen::Isometry3d> X_WG, std::span<const HandTarget> targets, double milliseconds) {
    GLISSADE_ASSERT(X_WG.size() == X_WG_.size() && targets.size() == hands_.size());
    for (std::size_t h = 0; h < hands_.size(); ++h) {
      aim(h, targets[h].posture, milliseconds);
      hold(h, targets[h].part);
    }
    for (std::size_t p = 0; p < X_WG_.size(); ++p)
      X_WG_[p] = is_led_[p] ? X_WG[p] : loose_parts_.push(p, milliseconds, parts_);
    move(milliseconds);
    for (std::size_t h = 0; h < hands_.size(); ++h) {
      if (!hands_[h].is_lost()) decide(h, grasped_part(hands_[h]));
    }
    for (std::size_t p = 0; p < X_WG_.size(); ++p) {
      if (!is_led_[p]) loose_parts_.look(p, hands_, parts_);  // a hand without fingers may hold it
    }
  }

  void take_part(std::size_t p, const Eigen::Isometry3d& X_WG) {
    is_led_[p] = 1;
    loose_parts_.end_push(p, parts_);
    parts_.grasp(p, X_WG, grip(p, [&](std::size_t h) { return decisions_[h].part == p; }));
  }

  void leave_part(std::size_t p) {
    is_led_[p] = 0;
    loose_parts_.end_push(p, parts_);
    parts_.release(p);
  }

  bool is_led(std::size_t p) const { return is_led_[p] != 0; }

  const HoldDecision& decision(std::size_t h) const { return decisions_[h]; }

 private:
  bool is_held(std::size_t part) const {
    return std::any_of(hands_.begin(), hands_.end(), [&](const GraspingHand& hand) { return hand.part() == part; });
  }

  /// A hand that is found again may be anywhere: a free one begins there, and a held part goes there slowly. Returns
  /// whether the hand was lost or found.
  bool aim(std::size_t h, const std::optional<Posture>& target, double milliseconds) {
    GraspingHand& hand = hands_[h];
    const bool was_lost = hand.is_lost();
    hand.aim(target, milliseconds);
    if (hand.is_lost() == was_lost) return false;
    if (hand.is_lost() && hand.part()) {
      hand.clasp().forget_contacts();
    } else if (hand.is_lost()) {
      vanish(h);
    }
    return true;
  }

  /// Moves parts, then hands. While the parts are within a step, hands only go along with what they hold: moving by
  /// themselves, they would change what the step is about.
  void move(double milliseconds) {
    parts_.advance(X_WG_, milliseconds);
    waited_ms_ += milliseconds;
    for (std::size_t h = 0; h < hands_.size(); ++h)
      carry_hand(h);
    if (parts_.is_within_cycle()) return;
    for (std::size_t h = 0; h < hands_.size(); ++h)
      move_hand(h);
    for (GraspingHand& hand : hands_)
      hand.analyze(waited_ms_, up_W_, parts_.result(hand.part().value_or(0)).X_WV);
    waited_ms_ = 0.0;
  }

  /// The mean of what the hands that hold a part want of it; none while none of them has a target.
  std::optional<Eigen::Isometry3d> wish(std::size_t part) {
    const Eigen::Isometry3d& X_WV = parts_.result(part).X_WV;
    const Eigen::Vector3d& p_Vref = parts_.p_Vref(part);
    geometry::Displacement sum;
    int count = 0;
    for (GraspingHand& hand : hands_) {
      if (hand.part() != part) continue;
      const std::optional<Eigen::Isometry3d> X_WG = hand.ghost();
      if (!X_WG) continue;
      const geometry::Displacement d = geometry::displacement_between(X_WV, *X_WG, p_Vref);
      sum = {sum.v + d.v, sum.w + d.w};
      ++count;
    }
    if (count == 0) return std::nullopt;
    return geometry::displaced(X_WV, p_Vref, sum.scaled(1.0 / count));
  }

  void carry_hand(std::size_t h) {
    GraspingHand& hand = hands_[h];
    for (std::size_t p = 0; p < X_WG_.size(); ++p)
      hand.clasp().place_free_object(p, parts_.result(p).X_WV);
    if (hand.part()) hand.follow(parts_.result(*hand.part()).X_WV);
  }

  void move_hand(std::size_t h) {
    GraspingHand& hand = hands_[h];
    hand.advance();
    if (hand.is_present()) parts_.place_riders(h, hand.segments());
  }

  /// A hand that is lost and holds nothing is nowhere. What was decided about it is withdrawn: the haptic thread, which
  /// may not have followed yet, would take hold with a hand that touches nothing.
  void vanish(std::size_t h) {
    if (hands_[h].is_present()) parts_.remove_riders(h);
    hands_[h].vanish();
    decide(h, std::nullopt);
  }

  /// The part that the grasp of a hand holds.
  std::optional<std::size_t> grasped_part(const GraspingHand& hand) const {
    const Grasp& grasp = hand.grasp();
    const std::int64_t number = grasp.object - static_cast<std::int64_t>(parts_.obstacle_count());
    if (!grasp.holds() || number < 0) return std::nullopt;
    const auto part = static_cast<std::size_t>(number);
    if (parts_.is_scripted(part) || hand.has_just_left(part)) return std::nullopt;
    return part;
  }

  /// What the hand is to hold. One without a target keeps what it has.
  std::optional<std::size_t> wanted_part(std::size_t h) const {
    const GraspingHand& hand = hands_[h];
    return hand.is_lost() ? hand.part() : grasped_part(hand);
  }

  /// Returns whether the hand holds something else than before. A hand that is nowhere takes hold of nothing. The
  /// haptic thread learns it from the withdrawn decision.
  bool hold(std::size_t h, std::optional<std::size_t> part) {
    GraspingHand& hand = hands_[h];
    if (!hand.is_present()) part.reset();
    if (part == hand.part()) return false;
    if (hand.part()) {
      hand.let_go();
      parts_.detach(h);
    }
    if (part) {
      hand.take(*part, parts_.result(*part).X_WV);
      parts_.attach(h, *part);
    } else if (hand.is_lost()) {
      vanish(h);
    }
    return true;
  }

  void decide(std::size_t h, std::optional<std::size_t> part) {
    if (part != decisions_[h].part) decisions_[h] = {part, decisions_[h].number + 1};
  }

  /// After another hand has taken hold of a part or let go of it, or is lost or found again. The part approaches its
  /// new ghost slowly: its own pose while nobody knows where it should go.
  void settle(std::size_t p) {
    if (!is_held(p)) {
      leave_part(p);
    } else {
      X_WG_[p] = wish(p).value_or(parts_.result(p).X_WV);
      loose_parts_.end_push(p, parts_);
      parts_.grasp(p, X_WG_[p], grip(p, [&](std::size_t h) { return hands_[h].part() == p; }));
    }
  }

  /// The compliance point of a part that hands take: the middle of where those that hold it touch it, unless the scene
  /// says another; where it is, if they do not touch it.
  template <typename Holds>
  Eigen::Vector3d grip(std::size_t p, const Holds& holds) const {
    if (parts_.part(p).has_chosen_point()) return parts_.part(p).p_Vref();
    const auto body = static_cast<std::int32_t>(parts_.obstacle_count() + p);
    Eigen::Vector3d sum_W = Eigen::Vector3d::Zero();
    int count = 0;
    for (std::size_t h = 0; h < hands_.size(); ++h) {
      if (!holds(h)) continue;
      for (const LinkContact& touch : hands_[h].contacts()) {
        if (touch.contact.obstacle != body) continue;
        sum_W += touch.contact.q_W();
        ++count;
      }
    }
    if (count == 0) return parts_.p_Vref(p);
    return parts_.result(p).X_WV.inverse(Eigen::Isometry) * (sum_W / count);
  }

  Eigen::Vector3d up_W_;
  std::vector<GraspingHand> hands_;
  contact::MultiPartSliding parts_;
  std::vector<Eigen::Isometry3d> X_WG_;  // of each part
  LooseParts loose_parts_;
  double waited_ms_ = 0.0;  // since the hands moved
  // Where someone else decides what is held:
  std::vector<char> is_led_;             // whether someone holds the part
  std::vector<HoldDecision> decisions_;  // for each hand
};

GraspSimulation::GraspSimulation(const std::vector<contact::Obstacle>& fixed,
                                 const std::vector<contact::HeldPart>& parts,
                                 const std::vector<std::shared_ptr<const HandModel>>& hands, const GraspRules& rules)
    : life_(std::make_unique<Life>(fixed, parts, hands, rules)) {}

GraspSimulation::GraspSimulation(GraspSimulation&&) noexcept = default;
GraspSimulation& GraspSimulation::operator=(GraspSimulation&&) noexcept = default;
GraspSimulation::~GraspSimulation() = default;

void GraspSimulation::advance(std::span<const std::optional<Posture>> targets, double milliseconds) {
  life_->advance(targets, milliseconds);
}

void GraspSimulation::move_cart(std::size_t hand, const Posture& posture) {
  life_->move_cart(hand, posture);
}

std::size_t GraspSimulation::hand_count() const {
  return life_->hand_count();
}

std::size_t GraspSimulation::part_count() const {
  return life_->parts().part_count();
}

hands::HandActivity GraspSimulation::activity(std::size_t hand) const {
  return activity_of(life_->hand(hand));
}

const Posture& GraspSimulation::posture(std::size_t hand) const {
  return life_->hand(hand).clasp().posture();
}

const Clasp& GraspSimulation::clasp(std::size_t hand) const {
  return life_->hand(hand).clasp();
}

hands::VisibleHand GraspSimulation::visible(std::size_t hand) const {
  const Posture& at = posture(hand);
  hands::VisibleHand visible{.activity = activity(hand),
                             .grasp = grasp(hand).type,
                             .form = grasp(hand).form,
                             .touching = grasp(hand).segments.bits(),
                             .X_WH = at.X_WR};
  std::copy(at.values.begin(), at.values.end(), visible.angles.begin());
  return visible;
}

const std::shared_ptr<const HandModel>& GraspSimulation::model(std::size_t hand) const {
  return life_->hand(hand).model();
}

std::span<const LinkContact> GraspSimulation::contacts(std::size_t hand) const {
  return life_->hand(hand).contacts();
}

const HoldDecision& GraspSimulation::decision(std::size_t hand) const {
  GLISSADE_ASSERT(hand < hand_count());
  return life_->decision(hand);
}

const Grasp& GraspSimulation::grasp(std::size_t hand) const {
  return life_->hand(hand).grasp();
}

std::optional<std::size_t> GraspSimulation::held_part(std::size_t hand) const {
  return life_->hand(hand).part();
}

const contact::MultiPartSliding& GraspSimulation::parts() const {
  return life_->parts();
}

void GraspSimulation::take_part(std::size_t part, const Eigen::Isometry3d& X_WG) {
  GLISSADE_ASSERT(part < part_count());
  life_->take_part(part, X_WG);
}

bool GraspSimulation::is_led(std::size_t part) const {
  GLISSADE_ASSERT(part < part_count());
  return life_->is_led(part);
}

void GraspSimulation::leave_part(std::size_t part) {
  GLISSADE_ASSERT(part < part_count());
  life_->leave_part(part);
}

void GraspSimulation::advance(std::span<const Eigen::Isometry3d> X_WG, std::span<const HandTarget> targets,
                              double milliseconds) {
  life_->advance(X_WG, targets, milliseconds);
}

}  // namespace glissade::grasping
