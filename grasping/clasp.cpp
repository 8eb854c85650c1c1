#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>

#include <glissade/contact/certified_bodies.h>
#include <glissade/geometry/displacement.h>
#include <glissade/grasping/clasp.h>

#include "clasp/chain_step.h"
#include "clasp/chain_step_finder.h"
#include "clasp/sight.h"

namespace glissade::grasping {
namespace {

constexpr double kDeeper_m = 5e-6;  // a target that is so much deeper lies deeper
// While the hand moves or rests, one flex value tries to go on alone in so many calls.
constexpr int kCallsOfOne = 8;

std::vector<std::shared_ptr<const contact::SlidingPart>> bodies_of(const KinematicChain& chain,
                                                                   std::span<const std::size_t> links) {
  std::vector<std::shared_ptr<const contact::SlidingPart>> bodies;
  for (const std::size_t link : links)
    bodies.push_back(std::make_shared<const contact::SlidingPart>(chain.links()[link].mesh));
  return bodies;
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
  Iteration(std::shared_ptr<const KinematicChain> chain, std::vector<contact::Obstacle> fixed,
            std::vector<std::shared_ptr<const contact::SlidingPart>> objects, const ClaspRules& rules)
      : chain_(std::move(chain)),
        rules_(rules),
        movers_(links_that_touch(checked(chain_))),
        link_bodies_(bodies_of(*chain_, movers_)),
        bodies_(std::move(fixed), std::move(objects), link_bodies_, rules.margin),
        finder_(*chain_, movers_, bodies_, rules.touching),
        X_WL_(chain_->links().size()),
        X_WL_target_(chain_->links().size()),
        touching_(chain_->links().size(), 0) {
    posture_.values.resize(chain_->values().size());
    chain_->clamp(posture_.values);
    target_ = posture_;
    if (rules.most_steps < 1) throw std::invalid_argument("a call of the clasp needs at least one step");
    if (rules.work_budget && *rules.work_budget < 1)
      throw std::invalid_argument("the work budget of a clasp must be positive");
    if (rules.touching > Sight::kLeast_m) throw std::invalid_argument("a link that touches is at most 0.2 mm away");
    way_.assign(static_cast<std::size_t>(rules.most_steps), posture_);
  }

  const KinematicChain& chain() const { return *chain_; }
  const std::vector<std::shared_ptr<const contact::SlidingPart>>& bodies() const { return link_bodies_; }
  ClaspState state() const { return state_; }
  const Posture& posture() const { return posture_; }
  const Posture& target() const { return target_; }
  std::span<const char> touching() const { return touching_; }
  const std::vector<LinkContact>& contacts() const { return link_contacts_; }
  std::span<const Posture> way() const { return {way_.data(), static_cast<std::size_t>(steps_)}; }

  void place_free_object(std::size_t object, const Eigen::Isometry3d& X_WB) {
    bodies_.place_object(object, X_WB);
    finder_.note_placed();
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
    was_free_ = false;
  }

  void forget_contacts() {
    std::fill(touching_.begin(), touching_.end(), char{0});
    link_contacts_.clear();
  }

  void lose_track() {
    was_free_ = was_free_ || state_ == ClaspState::kClasping;
    wait();
    state_ = ClaspState::kLost;
  }

  void advance(const Posture& target) {
    steps_ = 0;
    if (!take(target)) return;
    if (state_ != ClaspState::kClasping && !begin()) return;
    finder_.begin_call();
    begin_ = finder_.work();
    while (steps_ < rules_.most_steps && !finder_.is_slow() && !is_worked_off() &&
           finder_.find(posture_, target_, next_))
      go();
    quiet_calls_ = steps_ == 0 ? quiet_calls_ + 1 : 0;
    if (is_turn_of_one_value() && finder_.find_alone(posture_, target_, next_)) {
      go();
      quiet_calls_ = 0;
    }
    note_touching();
    is_carried_ = false;
  }

 private:
  bool is_worked_off() const { return rules_.work_budget && finder_.work() - begin_ >= *rules_.work_budget; }

  /// Where the hand stands still, until each value has tried in vain. Then, as things may change, and while the hand
  /// moves, because a target that trembles lets it never stand still, in some calls.
  bool is_turn_of_one_value() {
    if (quiet_calls_ > 0 && quiet_calls_ <= std::ssize(posture_.values)) return true;
    return ++other_calls_ % kCallsOfOne == 0 && steps_ < rules_.most_steps && !is_worked_off();
  }

  void go() {
    std::swap(posture_, next_);
    place_links();
    way_[static_cast<std::size_t>(steps_++)] = posture_;
  }

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

  /// Begins at the target if it is free. Where it is not, a chain that was lost goes on from where it was.
  bool begin() {
    std::swap(posture_, target_);
    place_links();
    const bool begins_at_target = bodies_.is_free();
    if (begins_at_target) {
      target_ = posture_;
    } else {
      std::swap(posture_, target_);
      place_links();
    }
    const bool begins = begins_at_target || (was_free_ && bodies_.is_free());
    state_ = begins ? ClaspState::kClasping : ClaspState::kWaiting;
    if (begins) was_free_ = false;
    return begins;
  }

  void place_links() {
    chain_->poses(posture_.X_WR, posture_.values, X_WL_);
    bodies_.place_movers(X_WL_, movers_);
    finder_.note_placed();
  }

  /// A link touches if it is near an object and its target lies deeper; if it is carried, also if it stays.
  void note_touching() {
    std::fill(touching_.begin(), touching_.end(), char{0});
    link_contacts_.clear();
    chain_->poses(target_.X_WR, target_.values, X_WL_target_);
    for (const contact::Contact& contact : finder_.contacts()) {
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
  std::vector<std::size_t> movers_;                                       // links with meshes
  std::vector<std::shared_ptr<const contact::SlidingPart>> link_bodies_;  // of the movers
  contact::CertifiedBodies bodies_;
  ChainStepFinder finder_;
  ClaspState state_ = ClaspState::kWaiting;
  bool was_free_ = false;  // when the track was lost
  Posture posture_;
  Posture target_;
  Posture next_;
  std::int64_t begin_ = 0;  // of the call: the work before it
  int steps_ = 0;
  std::ptrdiff_t quiet_calls_ = 0;  // without a step, one after another
  int other_calls_ = 0;
  std::vector<Posture> way_;
  std::vector<Eigen::Isometry3d> X_WL_;
  std::vector<Eigen::Isometry3d> X_WL_target_;
  bool is_carried_ = false;  // by an object, since the last call of `advance`
  std::vector<char> touching_;
  std::vector<LinkContact> link_contacts_;
};

Clasp::Clasp(std::shared_ptr<const KinematicChain> chain, std::vector<contact::Obstacle> fixed,
             std::vector<std::shared_ptr<const contact::SlidingPart>> objects, const ClaspRules& rules)
    : iteration_(std::make_unique<Iteration>(std::move(chain), std::move(fixed), std::move(objects), rules)) {}

Clasp::Clasp(Clasp&&) noexcept = default;
Clasp& Clasp::operator=(Clasp&&) noexcept = default;
Clasp::~Clasp() = default;

const KinematicChain& Clasp::chain() const {
  return iteration_->chain();
}

const std::vector<std::shared_ptr<const contact::SlidingPart>>& Clasp::bodies() const {
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

const Posture& Clasp::target() const {
  return iteration_->target();
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
