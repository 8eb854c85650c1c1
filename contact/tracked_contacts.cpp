#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include <glissade/contact/tracked_contacts.h>

#include "features/contact_motion.h"

namespace glissade::contact {
namespace {

constexpr double kCosOfSameNormal = 0.984807753012208;    // 10°
constexpr double kCosOfOneDirection = 0.999847695156391;  // 1°
constexpr std::int64_t kUnited = -1;                      // as an id: the contact is merged into another

auto features_of(const Contact& c) {
  return std::make_tuple(c.part, c.rider, c.obstacle, c.kind, c.part_feature, c.obstacle_feature, c.part_triangle,
                         c.obstacle_triangle);
}

/// Whether two contacts are one to the user: same obstacle, same place, same direction.
bool are_one(const Contact& a, const Contact& b, double margin) {
  return a.part == b.part && a.rider == b.rider && a.obstacle == b.obstacle && a.n_W.dot(b.n_W) >= kCosOfOneDirection &&
         (a.p_W - b.p_W).norm() <= margin && (a.q_W() - b.q_W()).norm() <= margin;
}

/// A total order: contacts with the same features are ordered by place.
bool comes_before(const Contact& a, const Contact& b) {
  const auto place = [](const Contact& c) {
    return std::make_tuple(c.p_W.x(), c.p_W.y(), c.p_W.z(), c.n_W.x(), c.n_W.y(), c.n_W.z(), c.force);
  };
  const auto features_a = features_of(a);
  const auto features_b = features_of(b);
  return features_a != features_b ? features_a < features_b : place(a) < place(b);
}

enum class FeatureKind : std::uint8_t { kNone, kFace, kEdge, kVertex };

struct FeatureKinds {
  FeatureKind part;
  FeatureKind obstacle;
};

FeatureKinds kinds_of(ContactKind kind) {
  using enum FeatureKind;
  switch (kind) {
    case ContactKind::kVertexFace:
      return {kVertex, kFace};
    case ContactKind::kFaceVertex:
      return {kFace, kVertex};
    case ContactKind::kEdgeEdge:
      return {kEdge, kEdge};
    case ContactKind::kVertexEdge:
      return {kVertex, kEdge};
    case ContactKind::kEdgeVertex:
      return {kEdge, kVertex};
    case ContactKind::kVertexVertex:
      return {kVertex, kVertex};
    case ContactKind::kOverlap:
      break;
  }
  return {kNone, kNone};
}

bool has_common_feature(const Contact& a, const Contact& b) {
  const FeatureKinds of_a = kinds_of(a.kind);
  const FeatureKinds of_b = kinds_of(b.kind);
  return (of_a.part == of_b.part && of_a.part != FeatureKind::kNone && a.part_feature == b.part_feature) ||
         (of_a.obstacle == of_b.obstacle && of_a.obstacle != FeatureKind::kNone &&
          a.obstacle_feature == b.obstacle_feature);
}

}  // namespace

std::span<const TrackedContact> ContactTracker::update(const SlidingResult& result, double obstacle_travel) {
  std::swap(before_, now_);
  take(result);
  match_features();
  match_places(result.X_WV, obstacle_travel);
  number_new_ones();
  X_WV_ = result.X_WV;
  return touching_;
}

void ContactTracker::take(const SlidingResult& result) {
  const bool moves = result.X_WV.matrix() != result.X_WV_of_contacts.matrix();
  const Eigen::Isometry3d part_motion_W = result.X_WV * result.X_WV_of_contacts.inverse(Eigen::Isometry);
  now_.clear();
  for (const Contact& contact : result.contacts) {
    TrackedContact tracked{0, 0, moves ? carried(contact, part_motion_W) : contact};
    if (lasts(tracked.contact)) now_.push_back(tracked);
  }
  std::sort(now_.begin(), now_.end(),
            [](const TrackedContact& a, const TrackedContact& b) { return comes_before(a.contact, b.contact); });
  unite_coincident();
}

void ContactTracker::unite_coincident() {
  const auto x_of = [&](std::int32_t i) { return now_[static_cast<std::size_t>(i)].contact.p_W.x(); };
  by_x_.resize(now_.size());
  std::iota(by_x_.begin(), by_x_.end(), 0);
  std::sort(by_x_.begin(), by_x_.end(),
            [&](std::int32_t a, std::int32_t b) { return x_of(a) != x_of(b) ? x_of(a) < x_of(b) : a < b; });
  for (std::size_t i = 0; i < now_.size(); ++i) {
    TrackedContact& first = now_[i];
    if (first.id == kUnited) continue;
    const double x = first.contact.p_W.x();
    auto near = std::partition_point(by_x_.begin(), by_x_.end(), [&](std::int32_t j) { return x_of(j) < x - margin_; });
    for (; near != by_x_.end() && x_of(*near) <= x + margin_; ++near) {
      TrackedContact& other = now_[static_cast<std::size_t>(*near)];
      if (&other == &first || other.id == kUnited || !are_one(first.contact, other.contact, margin_)) continue;
      first.contact.force += other.contact.force;
      first.contact.friction_W += other.contact.friction_W;
      other.id = kUnited;
    }
  }
  std::erase_if(now_, [](const TrackedContact& contact) { return contact.id == kUnited; });
}

/// Both lists are sorted, so one pass along them finds the contacts that are in both.
void ContactTracker::match_features() {
  ended_.clear();
  auto now = now_.begin();
  for (std::size_t i = 0; i < before_.size(); ++i) {
    const auto features = features_of(before_[i].contact);
    while (now != now_.end() && features_of(now->contact) < features)
      ++now;
    if (now != now_.end() && features_of(now->contact) == features) {
      now->id = before_[i].id;
      now->age = before_[i].age + 1;
      ++now;
    } else {
      ended_.push_back({static_cast<std::int32_t>(i), 0.0, false});
    }
  }
}

void ContactTracker::match_places(const Eigen::Isometry3d& X_WV, double obstacle_travel) {
  if (ended_.empty()) return;
  const Eigen::Isometry3d part_motion_W = X_WV * X_WV_.inverse(Eigen::Isometry);
  double widest = 0.0;
  for (Ended& ended : ended_) {
    const Eigen::Vector3d& p_W = before_[static_cast<std::size_t>(ended.index)].contact.p_W;
    ended.travel = (part_motion_W * p_W - p_W).norm() + obstacle_travel + 3.0 * margin_;
    widest = std::max(widest, ended.travel);
  }
  std::sort(ended_.begin(), ended_.end(), [&](const Ended& a, const Ended& b) {
    const double x_a = before_[static_cast<std::size_t>(a.index)].contact.p_W.x();
    const double x_b = before_[static_cast<std::size_t>(b.index)].contact.p_W.x();
    return x_a != x_b ? x_a < x_b : a.index < b.index;
  });
  for (TrackedContact& now : now_) {
    if (now.id != 0) continue;
    const std::int32_t found = predecessor_of(now.contact, widest);
    if (found < 0) continue;
    Ended& ended = ended_[static_cast<std::size_t>(found)];
    ended.continued = true;
    now.id = before_[static_cast<std::size_t>(ended.index)].id;
    now.age = before_[static_cast<std::size_t>(ended.index)].age + 1;
  }
}

/// The index of the ended contact that `contact` continues, −1 if there is none; `widest` (metres) is the largest
/// travel of any of them.
std::int32_t ContactTracker::predecessor_of(const Contact& contact, double widest) const {
  const auto candidate = [&](const Ended& ended) -> const TrackedContact& {
    return before_[static_cast<std::size_t>(ended.index)];
  };
  auto at = std::partition_point(ended_.begin(), ended_.end(), [&](const Ended& ended) {
    return candidate(ended).contact.p_W.x() < contact.p_W.x() - widest;
  });
  std::int32_t best = -1;
  std::tuple<bool, double, std::int64_t> least;
  for (; at != ended_.end() && candidate(*at).contact.p_W.x() <= contact.p_W.x() + widest; ++at) {
    const Contact& old = candidate(*at).contact;
    if (at->continued || old.part != contact.part || old.rider != contact.rider || old.obstacle != contact.obstacle ||
        old.n_W.dot(contact.n_W) < kCosOfSameNormal)
      continue;
    const double distance = (old.p_W - contact.p_W).norm();
    if (distance > at->travel || (old.q_W() - contact.q_W()).norm() > at->travel) continue;
    const auto rank = std::make_tuple(!has_common_feature(old, contact), distance, candidate(*at).id);
    if (best >= 0 && rank >= least) continue;
    best = static_cast<std::int32_t>(at - ended_.begin());
    least = rank;
  }
  return best;
}

/// A new contact that does not touch yet gets no number and is not reported.
void ContactTracker::number_new_ones() {
  std::erase_if(now_, [&](const TrackedContact& now) { return now.id == 0 && !touches(now.contact); });
  touching_.clear();
  for (TrackedContact& now : now_) {
    if (now.id == 0) now.id = ++last_id_;
    if (touches(now.contact)) touching_.push_back(now);
  }
}

}  // namespace glissade::contact
