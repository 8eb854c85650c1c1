#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>

#include <glissade/geometry/rigid_pose.h>
#include <glissade/grasping/clasp.h>
#include <glissade/haptics/certified_bodies.h>

#include "clasp/chain_step.h"
#include "clasp/closing_rows.h"
#include "clasp/interpolation.h"
#include "clasp/sight.h"
#include "clasp/slide_past.h"

namespace glissade::grasping {
namespace {

// Shorter steps are not worth their proof. Near an edge, contacts say truly how gaps change for some micrometres only,
// so a flex value may have many short steps before it.
constexpr double kBracket_m = 1e-6;
// Steps so short do not tell how far to look. In a call there are so many, then the next call goes on.
constexpr double kShort_m = 5e-6;
constexpr int kShortSteps = 2;
constexpr double kDeeper_m = 5e-6;  // a target that is so much deeper lies deeper
constexpr int kRetries = 4;         // with the contacts that a proof has missed
constexpr int kHalvings = 6;
constexpr double kSame = 0.01;
constexpr std::int64_t kWorkOfInterpolation = 5000;  // rough, as all work

std::vector<std::shared_ptr<const haptics::SlidingPart>> bodies_of(const KinematicChain& chain,
                                                                   std::span<const std::size_t> links) {
  std::vector<std::shared_ptr<const haptics::SlidingPart>> bodies;
  for (const std::size_t link : links)
    bodies.push_back(std::make_shared<const haptics::SlidingPart>(chain.links()[link].mesh));
  return bodies;
}

double greatest_margin(const std::vector<haptics::Obstacle>& fixed, double margin) {
  for (const haptics::Obstacle& obstacle : fixed)
    margin = std::max(margin, obstacle.margin.value_or(margin));
  return margin;
}

const KinematicChain& checked(const std::shared_ptr<const KinematicChain>& chain) {
  if (chain == nullptr) throw std::invalid_argument("a clasp needs a chain, not a null pointer");
  if (links_that_touch(*chain).empty()) throw std::invalid_argument("no link of the chain has a mesh");
  return *chain;
}

}  // namespace

std::string_view name_of(ClaspState state) {
  constexpr std::array<std::string_view, 3> kNames{"clasping", "waiting", "lost"};
  return kNames[static_cast<std::size_t>(state)];
}

class Clasp::Iteration {
 public:
  Iteration(std::shared_ptr<const KinematicChain> chain, std::vector<haptics::Obstacle> fixed,
            std::vector<std::shared_ptr<const haptics::SlidingPart>> objects, const ClaspRules& rules)
      : chain_(std::move(chain)),
        rules_(rules),
        movers_(links_that_touch(checked(chain_))),
        sight_(movers_.size(), greatest_margin(fixed, rules.margin) + rules.touching),
        link_bodies_(bodies_of(*chain_, movers_)),
        bodies_(std::move(fixed), std::move(objects), link_bodies_, rules.margin),
        motion_(*chain_, movers_),
        rows_(*chain_),
        interpolation_(*chain_),
        X_WL_(chain_->links().size()),
        X_WL_target_(chain_->links().size()),
        touching_(chain_->links().size(), 0) {
    for (const std::size_t link : movers_)
      radius_ = std::max(radius_, 0.5 * chain_->reach(link, 0));
    posture_.values.resize(chain_->values().size());
    chain_->clamp(posture_.values);
    if (rules.most_steps < 1) throw std::invalid_argument("a call of the clasp needs at least one step");
    if (rules.work_budget && *rules.work_budget < 1)
      throw std::invalid_argument("the work budget of a clasp must be positive");
    if (rules.touching > Sight::kLeast_m) throw std::invalid_argument("a link that touches is at most 0.2 mm away");
    way_.assign(static_cast<std::size_t>(rules.most_steps), posture_);
  }

  const KinematicChain& chain() const { return *chain_; }
  const std::vector<std::shared_ptr<const haptics::SlidingPart>>& bodies() const { return link_bodies_; }
  ClaspState state() const { return state_; }
  const Posture& posture() const { return posture_; }
  std::span<const char> touching() const { return touching_; }
  const std::vector<LinkContact>& contacts() const { return link_contacts_; }
  std::span<const Posture> way() const { return {way_.data(), static_cast<std::size_t>(steps_)}; }

  void place_free_object(std::size_t object, const Eigen::Isometry3d& X_WB) {
    bodies_.place_object(object, X_WB);
    is_found_here_ = false;
  }

  void carry(const Posture& posture) {
    if (state_ != ClaspState::kClasping || !take(posture)) return;
    posture_ = target_;
    place_links();
    is_carried_ = true;
  }

  void place_object(std::size_t object, const Eigen::Isometry3d& X_WB) {
    place_free_object(object, X_WB);
    if (state_ == ClaspState::kClasping && !bodies_.is_free()) wait();
  }

  void move_cart(const Posture& target) {
    if (!take(target)) return;
    posture_ = target_;
    place_links();
    wait();
  }

  void forget_contacts() {
    std::fill(touching_.begin(), touching_.end(), char{0});
    link_contacts_.clear();
  }

  void lose_track() {
    wait();
    state_ = ClaspState::kLost;
  }

  void advance(const Posture& target) {
    steps_ = 0;
    if (!take(target)) return;
    if (state_ != ClaspState::kClasping && !begin()) return;
    short_steps_ = 0;
    begin_ = work();
    while (steps_ < rules_.most_steps && short_steps_ < kShortSteps && !is_worked_off() && take_step())
      way_[static_cast<std::size_t>(steps_++)] = posture_;
    note_touching();
    is_carried_ = false;
  }

 private:
  std::int64_t work() const { return bodies_.work() + interpolations_ * kWorkOfInterpolation; }
  bool is_worked_off() const { return rules_.work_budget && work() - begin_ >= *rules_.work_budget; }

  /// Checks and keeps the target.
  bool take(const Posture& target) {
    const std::optional<Eigen::Isometry3d> X_WR = geometry::rigid_pose(target.X_WR);
    const bool is_finite =
        std::all_of(target.values.begin(), target.values.end(), [](double value) { return std::isfinite(value); });
    if (!X_WR || !is_finite || target.values.size() != posture_.values.size()) return false;
    target_.X_WR = *X_WR;
    target_.values = target.values;
    chain_->clamp(target_.values);
    return true;
  }

  void wait() {
    state_ = ClaspState::kWaiting;
    forget_contacts();
  }

  /// Begins at the target if it is free.
  bool begin() {
    std::swap(posture_, target_);
    place_links();
    if (bodies_.is_free()) {
      state_ = ClaspState::kClasping;
      target_ = posture_;
      return true;
    }
    std::swap(posture_, target_);
    place_links();
    state_ = ClaspState::kWaiting;
    return false;
  }

  void place_links() {
    chain_->poses(posture_.X_WR, posture_.values, X_WL_);
    bodies_.place_movers(X_WL_, movers_);
    is_found_here_ = false;
  }

  /// Moves the chain by one step. Returns whether another one may be worth it.
  bool take_step() {
    step_between(posture_, target_, wanted_);
    motion_.set(posture_, wanted_);
    if (motion_.longest() == 0.0) return false;
    sight_.choose(motion_, rules_.margin);
    bodies_.look(sight_.reach());
    sight_.note_found(bodies_);
    bodies_.find_contacts(found_);
    is_found_here_ = true;
    rows_.set(posture_, wanted_, found_, movers_);
    failures_.clear();
    is_in_doubt_ = false;
    const bool goes_on = go(false) || (slides_ && go(true)) || go_without_failures() || (is_in_doubt_ && go_alone());
    if (goes_on && motion_.longest() < kShort_m) {
      ++short_steps_;
      return true;
    }
    sight_.note_taken(goes_on ? &motion_ : nullptr);
    return goes_on;
  }

  /// Finds, certifies and takes a step: by the interpolation, or by a slide of the whole chain. Returns whether it was
  /// long enough to be worth another one.
  bool go(bool slides) {
    double last = 0.0;
    for (int retry = 0; retry < kRetries; ++retry) {
      slides ? find_slide() : find_shares();
      motion_.set(posture_, step_);
      if (motion_.longest() < kBracket_m) return false;
      if (const double share = sight_.share_of(motion_); share < 1.0) scale(step_, share);
      motion_.set(posture_, step_);
      if (std::abs(motion_.longest() - last) < kSame * last) break;  // the proof has missed no contact
      last = motion_.longest();
      if (bodies_.certify(motion_, failures_)) return move();
      if (failures_.empty()) break;
      is_in_doubt_ = true;
      for (const haptics::Contact& failure : failures_)
        rows_.add(failure, movers_[static_cast<std::size_t>(failure.part)]);
    }
    return go_on_by_halves();
  }

  bool go_on_by_halves() {
    for (int halving = 0; halving < kHalvings; ++halving) {
      scale(step_, 0.5);
      motion_.set(posture_, step_);
      if (motion_.longest() < kBracket_m) return false;
      if (bodies_.certify(motion_, failures_)) return move();
    }
    return false;
  }

  /// Leaves out the links whose motion cannot be proven free, so that they do not hold up the others.
  bool go_without_failures() {
    for (int retry = 0; retry < kRetries && !failures_.empty(); ++retry) {
      for (const haptics::Contact& failure : failures_)
        rows_.bar(movers_[static_cast<std::size_t>(failure.part)]);
      failures_.clear();
      if (go(false)) return true;
    }
    return false;
  }

  /// Moves the first flex value that can go on by itself, where the steps of several could not be proven free.
  bool go_alone() {
    const ChainStep all = wanted_;
    for (std::size_t v = 0; v < all.values.size(); ++v) {
      wanted_.root = {};
      wanted_.values.assign(all.values.size(), 0.0);
      wanted_.values[v] = all.values[v];
      motion_.set(posture_, wanted_);
      if (motion_.longest() < kBracket_m) continue;
      rows_.set(posture_, wanted_, found_, movers_);
      if (go(false) || go_a_little()) return true;
    }
    return false;
  }

  /// A short step that the contacts in sight allow. The contacts that a proof has missed may forbid it: as a row, a
  /// contact with less than its margin left allows no closing at all, although a proof has room for a little.
  bool go_a_little() {
    rows_.set(posture_, wanted_, found_, movers_);
    find_shares();
    motion_.set(posture_, step_);
    if (motion_.longest() < kBracket_m) return false;
    scale(step_, std::min(1.0, 2.0 * kShort_m / motion_.longest()));
    return go_on_by_halves();
  }

  void find_shares() {
    ++interpolations_;
    const std::vector<double>& shares = interpolation_.find(rows_, kBracket_m);
    step_.root = wanted_.root.scaled(shares[0]);
    step_.values = wanted_.values;
    for (std::size_t v = 0; v < step_.values.size(); ++v)
      step_.values[v] *= shares[1 + v];
    slides_ = shares[0] < 1.0;
  }

  void find_slide() {
    step_.root = slide_past(wanted_.root, rows_.planes(), radius_, forces_);
    step_.values.assign(step_.values.size(), 0.0);
  }

  bool move() {
    grasping::advance(posture_, step_, 1.0, next_);
    std::swap(posture_, next_);
    place_links();
    return true;
  }

  /// A link touches if it is near an object and its target lies deeper; if it is carried, also if it stays.
  void note_touching() {
    std::fill(touching_.begin(), touching_.end(), char{0});
    link_contacts_.clear();
    if (!is_found_here_) {
      sight_.choose_least();
      bodies_.look(sight_.reach());
      bodies_.find_contacts(found_);
    }
    chain_->poses(target_.X_WR, target_.values, X_WL_target_);
    for (const haptics::Contact& contact : found_) {
      if (contact.gap > std::max(rules_.touching, contact.margin + rules_.touching - rules_.margin)) continue;
      const std::size_t link = movers_[static_cast<std::size_t>(contact.part)];
      const Eigen::Vector3d p_target_W = X_WL_target_[link] * (X_WL_[link].inverse(Eigen::Isometry) * contact.p_W);
      const double depth = -contact.n_W.dot(p_target_W - contact.p_W);
      if (depth < (is_carried_ ? -kDeeper_m : kDeeper_m)) continue;
      touching_[link] = 1;
      link_contacts_.push_back({link, contact, std::max(0.0, depth)});
    }
  }

  std::shared_ptr<const KinematicChain> chain_;
  ClaspRules rules_;
  std::vector<std::size_t> movers_;  // links with meshes
  Sight sight_;
  std::vector<std::shared_ptr<const haptics::SlidingPart>> link_bodies_;  // of the movers
  haptics::CertifiedBodies bodies_;
  ChainMotion motion_;
  ClosingRows rows_;
  Interpolation interpolation_;
  double radius_ = 0.0;  // metres: what a turn of the root counts
  ClaspState state_ = ClaspState::kWaiting;
  Posture posture_;
  Posture target_;
  Posture next_;
  ChainStep wanted_;
  ChainStep step_;
  bool slides_ = false;       // the root did not arrive
  bool is_in_doubt_ = false;  // in this step, a proof has failed
  std::int64_t interpolations_ = 0;
  std::int64_t begin_ = 0;  // of the call: the work before it
  int steps_ = 0;
  int short_steps_ = 0;
  std::vector<Posture> way_;
  std::vector<Eigen::Isometry3d> X_WL_;
  std::vector<Eigen::Isometry3d> X_WL_target_;
  std::vector<haptics::Contact> found_;
  bool is_found_here_ = false;  // the contacts, at the present posture
  bool is_carried_ = false;     // by an object, since the last call of `advance`
  std::vector<haptics::Contact> failures_;
  std::vector<double> forces_;
  std::vector<char> touching_;
  std::vector<LinkContact> link_contacts_;
};

Clasp::Clasp(std::shared_ptr<const KinematicChain> chain, std::vector<haptics::Obstacle> fixed,
             std::vector<std::shared_ptr<const haptics::SlidingPart>> objects, const ClaspRules& rules)
    : iteration_(std::make_unique<Iteration>(std::move(chain), std::move(fixed), std::move(objects), rules)) {}

Clasp::Clasp(Clasp&&) noexcept = default;
Clasp& Clasp::operator=(Clasp&&) noexcept = default;
Clasp::~Clasp() = default;

const KinematicChain& Clasp::chain() const {
  return iteration_->chain();
}

const std::vector<std::shared_ptr<const haptics::SlidingPart>>& Clasp::bodies() const {
  return iteration_->bodies();
}

void Clasp::place_object(std::size_t object, const Eigen::Isometry3d& X_WB) {
  iteration_->place_object(object, X_WB);
}

void Clasp::place_free_object(std::size_t object, const Eigen::Isometry3d& X_WB) {
  iteration_->place_free_object(object, X_WB);
}

void Clasp::carry(const Posture& posture) {
  iteration_->carry(posture);
}

void Clasp::advance(const Posture& target) {
  iteration_->advance(target);
}

void Clasp::forget_contacts() {
  iteration_->forget_contacts();
}

void Clasp::lose_track() {
  iteration_->lose_track();
}

void Clasp::move_cart(const Posture& target) {
  iteration_->move_cart(target);
}

ClaspState Clasp::state() const {
  return iteration_->state();
}

const Posture& Clasp::posture() const {
  return iteration_->posture();
}

std::span<const char> Clasp::touching() const {
  return iteration_->touching();
}

const std::vector<LinkContact>& Clasp::contacts() const {
  return iteration_->contacts();
}

std::span<const Posture> Clasp::way() const {
  return iteration_->way();
}

}  // namespace glissade::grasping
