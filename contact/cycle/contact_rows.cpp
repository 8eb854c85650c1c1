#include "cycle/contact_rows.h"

#include <algorithm>
#include <utility>

#include "cycle/sliding_constants.h"
#include "features/contact_motion.h"
#include "features/contact_search.h"

namespace glissade::contact {
namespace {

// Work of a candidate pair and of the contacts of one that may have some, in the unit of `collision::WorkMeter`: rough.
// Steps take 0.4 ns a unit.
constexpr std::int64_t kWorkOfCandidate = 2;
constexpr std::int64_t kWorkOfWay = 2;
constexpr std::int64_t kWorkOfContacts = 300;

/// In margins: the gap up to which all contacts are found at once. Those at rims depend on each other up to two
/// margins, by a difference of a tenth.
constexpr double kReachOfRims = 2.2;
/// In margins: the gap up to which all contacts are found at the end. Up to three margins, a contact that touched keeps
/// its number.
constexpr double kReachOfTouching = 3.2;
/// Numbers of pairs that are looked at together.
constexpr std::size_t kNearestAtOnce = 64;
constexpr std::size_t kViolatedAtOnce = 64;
constexpr std::size_t kNearestAhead = 256;

/// In minimum clearances: the gap down to which parts may use the room where it is too narrow for their margins. A seat
/// begins with 1.08 of them.
constexpr double kLeastGap = 1.04;

/// The pair as the other body sees it.
UncertifiedPair swapped(const UncertifiedPair& pair) {
  return {{{pair.bodies.part, pair.bodies.obstacle}, pair.part_triangle, pair.obstacle_triangle}, -pair.n_W};
}

}  // namespace

bool ContactRows::Situation::operator==(const Situation& other) const {
  const auto are_alike = [](const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
    return a.matrix() == b.matrix();
  };
  return searches == other.searches && is_held == other.is_held && p_Vref == other.p_Vref &&
         std::equal(X_WB.begin(), X_WB.end(), other.X_WB.begin(), other.X_WB.end(), are_alike);
}

void ContactRows::note_situation() {
  situation_.searches = shared_.candidates.statistics().searches;
  situation_.X_WB.clear();
  for (std::size_t mover = 0; mover < shared_.scene.movers().size(); ++mover)
    situation_.X_WB.push_back(shared_.scene.bodies()[shared_.scene.body_of_mover(mover)].X_WB);
  situation_.p_Vref.clear();
  situation_.is_held.clear();
  for (const HeldPartState& part : shared_.states) {
    situation_.p_Vref.push_back(part.p_Vref);
    situation_.is_held.push_back(part.is_held() ? 1 : 0);
  }
}

void ContactRows::find(double reach, double reach_ahead, WorkBudget& budget) {
  uses_room_ = {};
  note_situation();
  if (may_be_kept_ && reach <= reach_ && reach_ahead <= reach_ahead_ && situation_ == found_in_) {
    add_rows_of_ahead();
    return;
  }
  std::swap(situation_, found_in_);
  may_be_kept_ = true;
  reach_ = reach;
  reach_ahead_ = reach_ahead;
  looked_at_.clear();
  contacts_.clear();
  is_of_failure_.clear();
  contacts_ahead_.clear();
  rows_.clear();
  pairs_.look(reach_ahead_);
  budget.spend(kWorkOfCandidate * static_cast<std::int64_t>(shared_.candidates.pairs().pair_count()));
  complete_ = std::min(pairs_.take_nearest(kReachOfRims * shared_.largest_margin, kNearestAtOnce, reach),
                       shared_.candidates.covered());
  find_contacts_of_taken(budget);
}

bool ContactRows::find_violated(const Displacements& displacements, WorkBudget& budget) {
  budget.spend(kWorkOfWay * static_cast<std::int64_t>(pairs_.left_count()));
  pairs_.find_too_near(displacements, reach_);
  while (true) {
    pairs_.take_too_near(kViolatedAtOnce);
    if (pairs_.taken().empty()) return false;
    const std::size_t known = rows_.size();
    find_contacts_of_taken(budget);
    const auto of_parts = shared_.of_parts(displacements);
    if (std::any_of(rows_.begin() + static_cast<std::ptrdiff_t>(known), rows_.end(),
                    [&](const CoupledRow& row) { return row.velocity(of_parts) < row.bound; })) {
      return true;
    }
  }
}

/// Finds the contacts within reach of the pairs that were taken, with their rows.
void ContactRows::find_contacts_of_taken(WorkBudget& budget) {
  find_contacts_of(pairs_.taken(), pairs_.places(), reach_, budget);
  for (std::size_t i = 0; i < gaps_.size(); ++i)
    looked_at_.push_back({pairs_.places()[i], gaps_[i].beyond});
  for (const Contact& contact : found_)
    add(contact);
}

/// Gives a row to those contacts ahead that are within reach: their pairs count as looked at.
void ContactRows::add_rows_of_ahead() {
  for (const Contact& contact : contacts_ahead_) {
    if (contact.gap <= reach_) add(contact);
  }
  contacts_ahead_.clear();
}

double ContactRows::find_ahead(WorkBudget& budget) {
  if (reach_ahead_ > reach_) find_beyond(budget);
  const double complete = pairs_.take_nearest(kReachOfTouching * shared_.largest_margin, kNearestAhead, reach_ahead_);
  if (!pairs_.taken().empty()) {
    find_contacts_of(pairs_.taken(), pairs_.places(), reach_ahead_, budget);
    contacts_ahead_.insert(contacts_ahead_.end(), found_.begin(), found_.end());
    // Those beyond the reach are to be found again if the rows are kept.
    for (const PlaceOfPair& place : pairs_.places())
      looked_at_.push_back({place, 0.0});
  }
  return std::min(complete, shared_.candidates.covered());
}

/// Finds the contacts ahead of pairs whose contacts within reach are known. Most have no more.
void ContactRows::find_beyond(WorkBudget& budget) {
  std::erase_if(looked_at_, [&](const LookedAt& pair) { return pair.beyond > reach_ahead_; });
  candidates_.clear();
  places_.clear();
  for (const LookedAt& pair : looked_at_) {
    candidates_.push_back(shared_.candidates.pairs().triangles(pair.pair));
    places_.push_back(pair.pair);
  }
  find_contacts_of(candidates_, places_, reach_ahead_, budget);
  for (const Contact& contact : found_) {
    if (contact.gap > reach_) contacts_ahead_.push_back(contact);
  }
}

void ContactRows::find_contacts_of(std::span<const TrianglesOfBodies> pairs, std::span<const PlaceOfPair> places,
                                   double reach, WorkBudget& budget) {
  const ContactScene& scene = shared_.scene;
  budget.spend(kWorkOfContacts * std::ssize(pairs));
  known_.clear();
  for (const PlaceOfPair& pair : places)
    known_.push_back(shared_.candidates.pairs().known_features(pair.number, reach));
  find_contacts(scene.bodies(), scene.obstacles().size(), pairs, reach, shared_.largest_margin, found_, &gaps_, known_);
  shared_.candidates.pairs().note_gaps(places, gaps_);
  for (Contact& contact : found_) {
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
  keep_contacts([&](std::size_t row) { return !is_of_failure_[row] || contacts_[row].force > 0.0; });
  all_contacts_ = contacts_;
  all_contacts_.insert(all_contacts_.end(), contacts_ahead_.begin(), contacts_ahead_.end());
  return all_contacts_;
}

void ContactRows::keep_contacts_only() {
  keep_contacts([&](std::size_t row) { return !is_of_failure_[row]; });
}

/// Drops all other rows and their contacts.
void ContactRows::keep_contacts(const std::function<bool(std::size_t row)>& is_kept) {
  if (std::find(is_of_failure_.begin(), is_of_failure_.end(), true) == is_of_failure_.end()) return;
  may_be_kept_ = false;
  std::size_t kept = 0;
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    if (!is_kept(row)) continue;
    rows_[kept] = rows_[row];
    contacts_[kept] = contacts_[row];
    is_of_failure_[kept++] = is_of_failure_[row];
  }
  rows_.resize(kept);
  contacts_.erase(contacts_.begin() + static_cast<std::ptrdiff_t>(kept), contacts_.end());
  is_of_failure_.resize(kept);
}

/// A contact closer than its margin demands it back: as a whole where there was not enough room before, else a part.
void ContactRows::add(const Contact& contact) {
  const double missing = contact.margin - contact.gap;
  add(contact, missing);
  CoupledRow& row = rows_.back();
  if (belongs_to(row, uses_room_)) {
    give_up_margin(rows_.size() - 1);
  } else if (missing > 0.0 && !belongs_to(row, lacks_room_) && row.bound != -kUnbounded) {
    row.bound = 0.7 * missing;
  }
}

void ContactRows::add(const Contact& contact, double bound, bool is_of_failure) {
  const std::vector<HeldPartState>& states = shared_.states;
  const Eigen::Vector3d& p_W = contact.p_W;
  contacts_.push_back(contact);
  is_of_failure_.push_back(is_of_failure);
  CoupledRow& row = rows_.emplace_back();
  row.n = contact.n_W;
  row.part = contact.part;
  row.r = p_W - states[static_cast<std::size_t>(row.part)].p_Wref();
  row.bound = bound;
  bool is_held_by_any = states[static_cast<std::size_t>(row.part)].is_held();
  row.other = shared_.scene.leader(contact.obstacle);
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
      Contact contact{ContactKind::kVertexFace,
                      pair.part_triangle,
                      pair.bodies.obstacle,
                      pair.obstacle_triangle,
                      pair.n_W,
                      x_W,
                      gap};
      contact.part = number;
      contact.rider = scene.rider(pair.bodies.part);
      contact.margin = margin;
      add(contact, std::min(0.0, margin - gap), true);
    }
  }
}

void ContactRows::use_room(const std::array<bool, kMaxParts>& parts) {
  may_be_kept_ = false;
  for (std::size_t p = 0; p < kMaxParts; ++p) {
    uses_room_[p] = uses_room_[p] || parts[p];
    lacks_room_[p] = lacks_room_[p] || parts[p];
  }
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (!belongs_to(rows_[i], uses_room_)) continue;
    if (is_of_failure_[i]) {
      rows_[i].bound = std::min(rows_[i].bound, 0.0);
    } else {
      give_up_margin(i);
    }
  }
}

void ContactRows::margins_fit() {
  for (std::size_t p = 0; p < kMaxParts; ++p)
    lacks_room_[p] = uses_room_[p];
}

/// Whether one of these parts touches there.
bool ContactRows::belongs_to(const CoupledRow& row, const std::array<bool, kMaxParts>& parts) const {
  return parts[static_cast<std::size_t>(row.part)] || (row.other >= 0 && parts[static_cast<std::size_t>(row.other)]);
}

/// The contact stops the parts at a smaller gap from now on, and where the gap is smaller still, as they are.
void ContactRows::give_up_margin(std::size_t row) {
  Contact& contact = contacts_[row];
  contact.margin = std::min(contact.margin, least_gap(contact));
  rows_[row].bound = std::min({rows_[row].bound, 0.0, contact.margin - contact.gap});
}

/// The gap to which a contact may close where there is no room for its margin.
double ContactRows::least_gap(const Contact& contact) const {
  const ContactScene& scene = shared_.scene;
  const auto mover = contact.rider < 0 ? static_cast<std::size_t>(contact.part)
                                       : scene.first_rider() + static_cast<std::size_t>(contact.rider);
  const auto [first, second] = std::minmax({contact.obstacle, static_cast<std::int32_t>(scene.body_of_mover(mover))});
  return kLeastGap * scene.min_clearance(first, second);
}

void ContactRows::take_forces(std::span<const RowForce> forces) {
  for (Contact& contact : contacts_) {
    contact.force = 0.0;
    contact.friction_W.setZero();
  }
  for (const RowForce& force : forces) {
    Contact& contact = contacts_[static_cast<std::size_t>(force.row)];
    contact.force = force.normal;
    contact.friction_W = force.across_W;
  }
}

}  // namespace glissade::contact
