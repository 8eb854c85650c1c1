#include "life/grasping_hand.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <glissade/base/assert.h>
#include <glissade/geometry/displacement.h>

#include "clasp/chain_step.h"
#include "hand/hand_links.h"

namespace glissade::grasping {
namespace {

std::shared_ptr<const KinematicChain> chain_of(const std::shared_ptr<const HandModel>& model) {
  return {model, &model->chain};
}

bool is_usable(const Posture& target, std::size_t values) {
  return target.values.size() == values && geometry::rigid_pose(target.X_WR).has_value() &&
         std::all_of(target.values.begin(), target.values.end(), [](double value) { return std::isfinite(value); });
}

}  // namespace

GraspingHand::GraspingHand(std::shared_ptr<const HandModel> model, const std::vector<contact::Obstacle>& fixed,
                           std::vector<std::shared_ptr<const contact::SlidingPart>> parts, const ClaspRules& rules)
    : model_(std::move(model)),
      links_(links_that_touch(model_->chain)),
      first_part_(static_cast<std::int32_t>(fixed.size())),
      clasp_(chain_of(model_), fixed, std::move(parts), rules),
      analysis_(*model_, fixed.size()),
      now_(*model_, fixed.size()),
      held_(chain_of(model_), kPalmLink, kFlexionValues),
      speeds_(chain_of(model_), clasp_.bodies()),
      X_WL_(model_->chain.links().size()),
      X_WB_(links_.size()) {}

std::span<const Eigen::Isometry3d> GraspingHand::segments() {
  const Posture& posture = clasp_.posture();
  model_->chain.poses(posture.X_WR, posture.values, X_WL_);
  for (std::size_t i = 0; i < links_.size(); ++i)
    X_WB_[i] = X_WL_[links_[i]];
  return X_WB_;
}

Eigen::Isometry3d GraspingHand::palm(std::span<const double> values) {
  model_->chain.poses(Eigen::Isometry3d::Identity(), values, X_WL_);
  return X_WL_[kPalmLink];
}

void GraspingHand::aim(const std::optional<Posture>& target, double milliseconds) {
  const bool was_lost = is_lost();
  target_ = target;
  if (target_ && !is_usable(*target_, model_->chain.values().size())) target_.reset();
  if (!target_) {
    speeds_.forget();
    return;
  }
  std::vector<double>& values = target_->values;
  model_->chain.clamp(values);
  speeds_.follow(*target_, milliseconds);
  if (!part_ || was_lost) {
    fingers_.begin(values);
    return;
  }
  // The wrist moves the palm, and so the part, with the root.
  const std::array wrist{values[kWristFlexionValue], values[kWristAbductionValue]};
  const std::span<const double> smooth = fingers_.follow(values, milliseconds);
  std::copy(smooth.begin(), smooth.end(), values.begin());
  values[kWristFlexionValue] = wrist[0];
  values[kWristAbductionValue] = wrist[1];
}

void GraspingHand::vanish() {
  GLISSADE_ASSERT(!part_);
  clasp_.lose_track();
  is_late_ = true;
  analysis_.clear();
  now_.clear();
}

void GraspingHand::take(std::size_t part, const Eigen::Isometry3d& X_WV) {
  GLISSADE_ASSERT(is_present());
  const Posture& posture = clasp_.posture();
  part_ = part;
  is_late_ = false;
  held_.begin(clasp_.contacts(), first_part_ + static_cast<std::int32_t>(part), X_WV, posture);
  X_PV_ = (posture.X_WR * palm(posture.values)).inverse(Eigen::Isometry) * X_WV;
}

void GraspingHand::let_go() {
  left_ = part_;
  since_left_ms_ = 0.0;
  part_.reset();
}

std::optional<Eigen::Isometry3d> GraspingHand::ghost() {
  if (is_lost()) return std::nullopt;
  return target_->X_WR * palm(target_->values) * X_PV_;
}

void GraspingHand::follow(const Eigen::Isometry3d& X_WV) {
  posture_ = clasp_.posture();
  if (target_) {
    // The forearm goes where the glove's wrist has it: nothing on it touches.
    for (const std::size_t v : {kWristFlexionValue, kWristAbductionValue})
      posture_.values[v] = target_->values[v];
  }
  posture_.X_WR = X_WV * X_PV_.inverse(Eigen::Isometry) * palm(posture_.values).inverse(Eigen::Isometry);
  clasp_.carry(posture_);
}

void GraspingHand::advance() {
  if (is_lost()) return;
  posture_ = *target_;
  if (part_) posture_.X_WR = clasp_.posture().X_WR;
  clasp_.advance(posture_);
  if (!is_late_ || !is_present()) return;
  is_late_ = std::any_of(clasp_.contacts().begin(), clasp_.contacts().end(), [&](const LinkContact& touch) {
    return touch.contact.obstacle >= first_part_ && touch.depth > kResistance_m;
  });
}

std::span<const LinkContact> GraspingHand::contacts() const {
  const bool goes_on = part_ && !is_lost() && is_present();
  return goes_on ? held_.contacts() : clasp_.contacts();
}

void GraspingHand::analyze(double milliseconds, const Eigen::Vector3d& up_W, const Eigen::Isometry3d& X_WV) {
  constexpr double kAtOnce_ms = 1e6;
  since_left_ms_ += milliseconds;
  now_.clear();
  if (!is_present()) analysis_.clear();
  if (is_lost() || !is_present()) return;
  if (!part_) {
    analysis_.update(clasp_.contacts(), milliseconds, up_W);
    now_.update(clasp_.contacts(), kAtOnce_ms, up_W);
    return;
  }
  const std::int32_t body = first_part_ + static_cast<std::int32_t>(*part_);
  held_.update(clasp_.contacts(), body, X_WV, clasp_.posture(), posture_);
  for (const std::size_t link : held_.left())
    analysis_.forget(link, body);
  analysis_.update(held_.contacts(), milliseconds, up_W, body);
}

std::vector<GraspingHand> make_hands(const std::vector<std::shared_ptr<const HandModel>>& models,
                                     const std::vector<contact::Obstacle>& fixed,
                                     const std::vector<contact::HeldPart>& parts, const ClaspRules& rules) {
  std::vector<std::shared_ptr<const contact::SlidingPart>> bodies;
  for (const contact::HeldPart& part : parts)
    bodies.push_back(part.part_V);
  std::vector<GraspingHand> hands;
  hands.reserve(models.size());
  for (const auto& model : models) {
    if (model == nullptr) throw std::invalid_argument("a hand needs a model, not a null pointer");
    hands.emplace_back(model, fixed, bodies, rules);
  }
  return hands;
}

}  // namespace glissade::grasping
