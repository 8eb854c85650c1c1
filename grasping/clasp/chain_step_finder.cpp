#include "clasp/chain_step_finder.h"

#include <algorithm>
#include <cmath>

#include <glissade/contact/sliding_rules.h>

#include "clasp/slide_past.h"

namespace glissade::grasping {
namespace {

// Shorter steps are not worth their proof. Near an edge, contacts say truly how gaps change for some micrometres only,
// so a flex value may have many short steps before it.
constexpr double kBracket_m = 1e-6;
// Steps so short do not tell how far to look. In a call there are so many, then the next call goes on.
constexpr double kShort_m = 5e-6;
constexpr int kShortSteps = 2;
// A way of one flex value grazes its contacts if it keeps the least clearance over this length. A shorter way may lead
// into them.
constexpr double kGrazing_m = 0.1e-3;
// Of the margin of the hand: a step of one value alone takes no more of a wider margin either.
constexpr double kTakenAlone = 1.0 - contact::kMinClearanceOfMargin;
constexpr int kRetries = 4;  // with the contacts that a proof has missed
constexpr int kHalvings = 6;
constexpr double kSame = 0.01;
// Of the length of a slide: one that gains less on the target may be the rounding of its search, and goes to and fro.
constexpr double kLeastGain = 0.01;
constexpr std::int64_t kWorkOfInterpolation = 5000;  // rough, as all work

double greatest_radius(const KinematicChain& chain, std::span<const std::size_t> movers) {
  double radius = 0.0;
  for (const std::size_t link : movers)
    radius = std::max(radius, 0.5 * chain.reach(link, 0));
  return radius;
}

}  // namespace

ChainStepFinder::ChainStepFinder(const KinematicChain& chain, std::span<const std::size_t> movers,
                                 contact::CertifiedBodies& bodies, double touching)
    : movers_(movers),
      bodies_(bodies),
      sight_(movers.size(), bodies.greatest_margin() + touching),
      motion_(chain, movers),
      rows_(chain),
      interpolation_(chain),
      radius_(greatest_radius(chain, movers)) {}

void ChainStepFinder::begin_call() {
  short_steps_ = 0;
}

bool ChainStepFinder::is_slow() const {
  return short_steps_ >= kShortSteps;
}

std::int64_t ChainStepFinder::work() const {
  return bodies_.work() + interpolations_ * kWorkOfInterpolation;
}

const std::vector<contact::Contact>& ChainStepFinder::contacts() {
  if (!is_found_here_) {
    sight_.choose_least();
    bodies_.look(sight_.reach());
    bodies_.find_contacts(found_);
    is_found_here_ = true;
  }
  return found_;
}

bool ChainStepFinder::find(const Posture& from, const Posture& target, Posture& next) {
  from_ = from;
  step_between(from_, target, wanted_);
  motion_.set(from_, wanted_);
  if (motion_.longest() == 0.0) return false;
  sight_.choose(motion_, bodies_.margin());
  bodies_.look(sight_.reach());
  sight_.note_found(bodies_);
  bodies_.find_contacts(found_);
  is_found_here_ = true;
  rows_.set(from_, wanted_, found_, movers_);
  failures_.clear();
  is_in_doubt_ = false;
  is_alone_ = false;
  const bool goes_on =
      go(false) || (slides_ && go(true)) || go_without_failures() || (is_in_doubt_ && go_alone(target));
  if (goes_on && motion_.longest() < kShort_m) {
    ++short_steps_;
  } else {
    sight_.note_taken(goes_on ? &motion_ : nullptr);
  }
  if (goes_on) grasping::advance(from_, step_, 1.0, next);
  return goes_on;
}

bool ChainStepFinder::find_alone(const Posture& from, const Posture& target, Posture& next) {
  const std::size_t count = from.values.size();
  is_alone_ = true;
  from_ = from;
  for (std::size_t tried = 0; tried < count; ++tried, alone_ = (alone_ + 1) % count) {
    want_alone(alone_, target);
    if (motion_.longest() < kBracket_m) continue;
    if (graze() || go_as_near_as_the_nearest()) {
      sight_.note_taken(&motion_);
      grasping::advance(from_, step_, 1.0, next);
      return true;
    }
    break;
  }
  alone_ = (alone_ + 1) % count;
  return false;
}

/// The longest way of the wanted value that grazes its contacts, found by halves.
bool ChainStepFinder::graze() {
  step_ = wanted_;
  scale(step_, sight_.share_of(motion_));
  motion_.set(from_, step_);
  if (motion_.longest() < kGrazing_m) return false;
  while (!prove()) {
    const double share = kGrazing_m / motion_.longest();
    if (share > 1.0 - kSame) return false;  // this was the shortest way
    scale(step_, std::max(0.5, share));
    motion_.set(from_, step_);
  }
  return true;
}

/// A step on which every contact of a link may come as near, for its margin, as the nearest one of that link is now.
bool ChainStepFinder::go_as_near_as_the_nearest() {
  rows_.set(from_, wanted_, contacts(), movers_);
  rows_.share_shortfalls();
  return go(false);
}

bool ChainStepFinder::prove() {
  return is_alone_ ? bodies_.certify_taking(kTakenAlone * bodies_.margin(), motion_, failures_)
                   : bodies_.certify(motion_, failures_);
}

/// Finds and certifies a step: by the interpolation, or by a slide of the whole chain. Returns whether it is long
/// enough to be worth it.
bool ChainStepFinder::go(bool slides) {
  double last = 0.0;
  for (int retry = 0; retry < kRetries; ++retry) {
    if (!slides) find_shares();
    if (slides && !find_slide()) return false;
    motion_.set(from_, step_);
    if (motion_.longest() < kBracket_m) return false;
    if (const double share = sight_.share_of(motion_); share < 1.0) scale(step_, share);
    motion_.set(from_, step_);
    if (std::abs(motion_.longest() - last) < kSame * last) break;  // the proof has missed no contact
    last = motion_.longest();
    if (prove()) return true;
    if (failures_.empty()) break;
    is_in_doubt_ = true;
    for (const contact::Contact& failure : failures_)
      rows_.add(failure, movers_[static_cast<std::size_t>(failure.part)]);
  }
  return go_on_by_halves();
}

bool ChainStepFinder::go_on_by_halves() {
  for (int halving = 0; halving < kHalvings; ++halving) {
    scale(step_, 0.5);
    motion_.set(from_, step_);
    if (motion_.longest() < kBracket_m) return false;
    if (prove()) return true;
  }
  return false;
}

/// Leaves out the links whose motion cannot be proven free, so that they do not hold up the others.
bool ChainStepFinder::go_without_failures() {
  for (int retry = 0; retry < kRetries && !failures_.empty(); ++retry) {
    for (const contact::Contact& failure : failures_)
      rows_.bar(movers_[static_cast<std::size_t>(failure.part)]);
    failures_.clear();
    if (go(false)) return true;
  }
  return false;
}

/// Moves the first flex value that can go on by itself, where the steps of several could not be proven free.
bool ChainStepFinder::go_alone(const Posture& target) {
  for (std::size_t v = 0; v < from_.values.size(); ++v) {
    want_alone(v, target);
    if (motion_.longest() < kBracket_m) continue;
    rows_.set(from_, wanted_, found_, movers_);
    if (go(false) || go_a_little()) return true;
  }
  return false;
}

/// Wants one flex value at its target, and nothing else.
void ChainStepFinder::want_alone(std::size_t value, const Posture& target) {
  wanted_.root = {};
  wanted_.values.assign(from_.values.size(), 0.0);
  wanted_.values[value] = target.values[value] - from_.values[value];
  motion_.set(from_, wanted_);
}

/// A short step that the contacts in sight allow. The contacts that a proof has missed may forbid it: as a row, a
/// contact with less than its margin left allows no closing at all, although a proof has room for a little.
bool ChainStepFinder::go_a_little() {
  rows_.set(from_, wanted_, found_, movers_);
  find_shares();
  motion_.set(from_, step_);
  if (motion_.longest() < kBracket_m) return false;
  scale(step_, std::min(1.0, 2.0 * kShort_m / motion_.longest()));
  return go_on_by_halves();
}

void ChainStepFinder::find_shares() {
  ++interpolations_;
  const std::vector<double>& shares = interpolation_.find(rows_, kBracket_m);
  step_.root = wanted_.root.scaled(shares[0]);
  step_.values = wanted_.values;
  for (std::size_t v = 0; v < step_.values.size(); ++v)
    step_.values[v] *= shares[1 + v];
  slides_ = shares[0] < 1.0;
}

/// Returns whether the slide gains on the target.
bool ChainStepFinder::find_slide() {
  const auto dot = [&](const geometry::Displacement& a, const geometry::Displacement& b) {
    return a.v.dot(b.v) + radius_ * radius_ * a.w.dot(b.w);
  };
  step_.root = slide_past(wanted_.root, rows_.planes(), radius_, forces_);
  step_.values.assign(step_.values.size(), 0.0);
  const double length = std::sqrt(dot(step_.root, step_.root));
  const double gain = dot(wanted_.root, step_.root);
  return gain > 0.5 * length * length && gain > kLeastGain * length * std::sqrt(dot(wanted_.root, wanted_.root));
}

}  // namespace glissade::grasping
