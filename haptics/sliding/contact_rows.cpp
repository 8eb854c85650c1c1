#include "sliding/contact_rows.h"

#include <algorithm>

#include "contact/contact_motion.h"
#include "contact/contact_search.h"
#include "sliding/sliding_constants.h"

namespace glissade::haptics {
namespace {

// Work of a candidate pair and of the contacts of one that may have some, in the unit of `collision::WorkMeter`: rough.
// Steps take 0.4 ns a unit.
constexpr std::int64_t kWorkOfCandidate = 8;
constexpr std::int64_t kWorkOfContacts = 300;

/// In margins: contacts at rims are left out up to this gap. Beyond it, contacts do not depend on each other.
constexpr double kReachOfRims = 2.0;

/// The pair as the other body sees it.
UncertifiedPair swapped(const UncertifiedPair& pair) {
  return {{{pair.bodies.part, pair.bodies.obstacle}, pair.part_triangle, pair.obstacle_triangle}, -pair.n_W};
}

}  // namespace

void ContactRows::find(double reach, WorkBudget& budget) {
  reach_ = reach;
  contacts_ahead_.clear();
  shared_.candidates.with_contacts(reach, pairs_, numbers_, known_);
  find_among_pairs(reach, contacts_, budget);
  gaps_beyond_.assign(shared_.candidates.pair_count(), 0.0);
  for (std::size_t i = 0; i < numbers_.size(); ++i)
    gaps_beyond_[numbers_[i]] = gaps_[i].beyond;
  rows_.clear();
  for (const Contact& contact : contacts_) {
    // A contact closer than its margin demands part of it back.
    const double missing = contact.margin - contact.gap;
    const double bound = missing > 0.0 ? 0.7 * missing : missing;
    add(contact.obstacle, static_cast<std::size_t>(contact.part), contact.n_W, contact.p_W, bound);
  }
}

/// Most pairs have no more contacts than those that are found already.
void ContactRows::find_ahead(double reach_ahead, WorkBudget& budget) {
  shared_.candidates.with_contacts(reach_ahead, pairs_, numbers_, known_);
  if (reach_ >= kReachOfRims * shared_.largest_margin) leave_out_complete(reach_ahead);
  find_among_pairs(reach_ahead, contacts_ahead_, budget);
  std::erase_if(contacts_ahead_, [this](const Contact& contact) { return contact.gap <= reach_; });
}

/// Leaves out the pairs all of whose contacts within `reach_ahead` are found.
void ContactRows::leave_out_complete(double reach_ahead) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    if (gaps_beyond_[numbers_[i]] > reach_ahead) continue;
    pairs_[kept] = pairs_[i];
    known_[kept] = known_[i];
    numbers_[kept++] = numbers_[i];
  }
  pairs_.resize(kept);
  numbers_.resize(kept);
  known_.resize(kept);
}

/// Finds the contacts of `pairs_`.
void ContactRows::find_among_pairs(double reach, std::vector<Contact>& contacts, WorkBudget& budget) {
  const ContactScene& scene = shared_.scene;
  budget.spend(kWorkOfCandidate * static_cast<std::int64_t>(shared_.candidates.pair_count()) +
               kWorkOfContacts * std::ssize(pairs_));
  find_contacts(scene.bodies(), scene.obstacles().size(), pairs_, reach, shared_.largest_margin, contacts, &gaps_,
                known_);
  shared_.candidates.note_gaps(numbers_, gaps_);
  for (Contact& contact : contacts) {
    const auto body = static_cast<std::int32_t>(scene.body_of_mover(static_cast<std::size_t>(contact.part)));
    contact.margin = scene.margin(contact.obstacle, body);
    // A rider that stands is an obstacle of the parts, though its number is higher.
    const bool is_obstacle = scene.leader(body) == ContactScene::kStands;
    const std::int32_t own_body = is_obstacle ? contact.obstacle : body;
    if (is_obstacle) contact = mirrored(contact, body);
    contact.part = scene.leader(own_body);
    contact.rider = scene.rider(own_body);
  }
}

std::vector<Contact>& ContactRows::all_contacts() {
  contacts_.insert(contacts_.end(), contacts_ahead_.begin(), contacts_ahead_.end());
  contacts_ahead_.clear();
  return contacts_;
}

void ContactRows::keep_contacts_only() {
  rows_.resize(contacts_.size());
  failure_contacts_.clear();
}

void ContactRows::add(std::int32_t obstacle, std::size_t part, const Eigen::Vector3d& n_W, const Eigen::Vector3d& p_W,
                      double bound) {
  const std::vector<HeldPartState>& states = shared_.states;
  CoupledRow& row = rows_.emplace_back();
  row.n = n_W;
  row.r = p_W - states[part].p_Wref();
  row.bound = bound;
  row.part = static_cast<std::int32_t>(part);
  bool is_held_by_any = states[part].is_held();
  row.other = shared_.scene.leader(obstacle);
  if (row.other != ContactScene::kStands) {
    const auto other = static_cast<std::size_t>(row.other);
    row.r_other = p_W - states[other].p_Wref();
    is_held_by_any = is_held_by_any || states[other].is_held();
  }
  // Two released parts give no margin back.
  if (!is_held_by_any) row.bound = -kUnbounded;
}

void ContactRows::add_failures(std::span<const UncertifiedPair> failures) {
  const ContactScene& scene = shared_.scene;
  for (const UncertifiedPair& failure : failures) {
    const double margin = scene.margin(failure.bodies.obstacle, failure.bodies.part);
    const UncertifiedPair pair =
        scene.leader(failure.bodies.part) == ContactScene::kStands ? swapped(failure) : failure;
    const PlacedBody& obstacle = scene.bodies()[static_cast<std::size_t>(pair.bodies.obstacle)];
    const PlacedBody& part = scene.bodies()[static_cast<std::size_t>(pair.bodies.part)];
    const std::int32_t number = scene.leader(pair.bodies.part);
    double top = -kUnbounded;
    for (const Eigen::Vector3d& y_W : obstacle.triangle_W(pair.obstacle_triangle))
      top = std::max(top, pair.n_W.dot(y_W));
    for (const Eigen::Vector3d& x_W : part.triangle_W(pair.part_triangle)) {
      const double gap = pair.n_W.dot(x_W) - top;
      add(pair.bodies.obstacle, static_cast<std::size_t>(number), pair.n_W, x_W, std::min(0.0, margin - gap));
      Contact& contact =
          failure_contacts_.emplace_back(Contact{ContactKind::kVertexFace, pair.part_triangle, pair.bodies.obstacle,
                                                 pair.obstacle_triangle, pair.n_W, x_W, gap});
      contact.part = number;
      contact.rider = scene.rider(pair.bodies.part);
      contact.margin = margin;
    }
  }
}

void ContactRows::allow_standing_still() {
  for (CoupledRow& row : rows_)
    row.bound = std::min(row.bound, 0.0);
}

void ContactRows::take_forces(std::span<const RowForce> forces) {
  const std::size_t found = contacts_.size();
  pushed_.clear();
  for (const RowForce& force : forces) {
    const auto row = static_cast<std::size_t>(force.row);
    Contact& contact = row < found ? contacts_[row] : contacts_.emplace_back(failure_contacts_[row - found]);
    contact.force = force.normal;
    contact.friction_W = force.across_W;
    if (shared_.rules.friction.is_on()) pushed_.push_back(contact);
  }
}

void ContactRows::recall_forces(std::vector<RowForce>& forces) const {
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Contact& contact = contacts_[i];
    if (rows_[i].bound == -kUnbounded) continue;  // two released parts
    for (const Contact& before : pushed_) {
      if (before.part != contact.part || before.rider != contact.rider || before.obstacle != contact.obstacle ||
          before.kind != contact.kind || before.part_feature != contact.part_feature ||
          before.obstacle_feature != contact.obstacle_feature) {
        continue;
      }
      forces.push_back({static_cast<std::int32_t>(i), before.force, before.friction_W});
      break;
    }
  }
}

}  // namespace glissade::haptics
