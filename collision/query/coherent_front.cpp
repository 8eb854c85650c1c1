#include "query/coherent_front.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "kernels/front_kernels.h"
#include "kernels/round_up.h"
#include "tree/tree_nodes.h"

namespace glissade::collision {
namespace {

constexpr float kExpired = -1.0F;
constexpr float kNever = std::numeric_limits<float>::infinity();  // beyond any clock, which has a bound
// A front that has grown to this many times its first size is mostly out of date. Its first size is unknown as long as
// all queries end early; until then it may have as many entries as the trees have leaves.
constexpr std::size_t kMostGrowth = 2;
constexpr std::size_t kSmallFront = 64;
// If more than one entry in this many has expired, restarting at the roots costs no more. The sum of motions is bounded
// as well, because it is compared in single precision.
constexpr std::size_t kMostExpired = 2;
constexpr double kMostMotion = 0.25;

}  // namespace

void CoherentFront::clear() {
  base_id_ = 0;
  other_id_ = 0;
  of_distance_.clear();
}

void CoherentFront::start_afresh(const DopTree& base, const DopTree& other) {
  entries_.clear();
  expiry_.clear();
  complete_ = false;
  most_entries_ = leaves_of(base).size() + leaves_of(other).size();
  moved_ = 0.0;
  add({0, 0, kAllPairs}, false, 0);
}

void CoherentFront::add(const NodePair& pair, bool is_leaf, std::size_t parent) {
  if (entries_.size() == expiry_.size()) {
    expiry_.resize(expiry_.size() + kFrontPadding, kNever);
    expired_.resize(expiry_.size());
  }
  expiry_[entries_.size()] = kExpired;
  entries_.push_back({pair, is_leaf ? 0 : kAllPairs & ~pair.pairs, static_cast<std::uint32_t>(parent), is_leaf});
}

void CoherentFront::take_last_hit(std::size_t entry, int pair) {
  last_hit_.emplace(entries_[entry].pair.node_M, entries_[entry].pair.node_N, pair);
  while (entry != 0 && !last_hit_->is_full()) {
    entry = entries_[entry].parent;
    last_hit_->add_above(entries_[entry].pair);
  }
}

void CoherentFront::holds_for(std::size_t entry, double gap) {
  expiry_[entry] = static_cast<float>((moved_ + gap) * (1.0 - 0x1p-23));  // rounded down if positive
}

// Advances the clock to this pose.
void CoherentFront::follow(const DopTree& base, const DopTree& other, const QueryFrame& frame,
                           const VisitSelection& selection) {
  if (base_id_ != base.id() || other_id_ != other.id() || selection_ids_ != selection.ids()) {
    base_id_ = base.id();
    other_id_ = other.id();
    selection_ids_ = selection.ids();
    last_hit_.reset();
    start_afresh(base, other);
  } else {
    // Two rotations by an angle θ apart differ by 2√2 sin(θ/2) in the Frobenius norm and move a point at radius 1 by at
    // most 2 sin(θ/2).
    const double turned = (frame.R_MN - R_MN_).norm() * std::sqrt(0.5) + 2.0 * frame.rotation_defect;
    const double moved = (frame.p_MN - p_MN_).norm() + frame.ratio * turned;
    moved_ += moved * (1.0 + 1e-12) + 2.0 * frame.uncertainty;
    if (!(moved_ < kMostMotion) || entries_.size() > most_entries_) start_afresh(base, other);
  }
  R_MN_ = frame.R_MN;
  p_MN_ = frame.p_MN;
}

bool CoherentFront::query(Goal goal, const DopTree& base, const DopTree& other, const QueryFrame& frame,
                          double distance, DopAlignment& alignment, QueryCounters& counters, TriangleVisitor& visitor,
                          const VisitSelection& selection, WorkMeter* meter) {
  follow(base, other, frame, selection);
  if (frame.spheres_apart(distance)) return false;
  DopVisit step(base, other, frame, distance, alignment, selection, meter);
  if (goal == Goal::kAnyPair && last_hit_) {
    if (last_hit_->still_answers(visitor)) return true;
    // This search finds crossings only, which do not suffice for a distance greater than 0.
    if (!step.has_distance() && last_hit_->wander(step, counters, visitor)) return true;
    last_hit_.reset();
  }

  const float clock = round_up_to_float(std::min(moved_ + frame.in_base_radii(distance), 1e30));
  const std::size_t expired = find_expired(expiry_, clock, expired_);
  if (expired == 0) return false;
  if (entries_.size() > kSmallFront && kMostExpired * expired > entries_.size()) {
    start_afresh(base, other);
    open_.assign(1, 0);
  } else {
    open_.assign(expired_.begin(), expired_.begin() + static_cast<std::ptrdiff_t>(expired));
  }
  VisitedLeaves leaves;
  while (!open_.empty()) {
    const std::size_t entry = open_.back();
    open_.pop_back();
    if (!entries_[entry].is_leaf) {
      visit_nodes(entry, step, counters);
    } else if (visit_leaves(entry, frame, step, leaves, counters, visitor)) {
      return true;  // entries that are still open remain expired
    }
  }
  if (!complete_) most_entries_ = kMostGrowth * entries_.size() + kSmallFront;
  complete_ = true;
  return false;
}

// Pairs of children that have come near get entries of their own; the others determine the expiry.
void CoherentFront::visit_nodes(std::size_t entry, DopVisit& step, QueryCounters& counters) {
  const NodePair nodes = entries_[entry].pair;
  PairOverlaps overlaps;
  PairMask near = step.nodes(nodes, overlaps, counters);
  near = step.thin_slabs(nodes, near, overlaps) & ~entries_[entry].opened;
  entries_[entry].opened |= near;

  const PairMask apart = step.pairs_of(nodes) & ~entries_[entry].opened;
  if (apart == 0) {
    expiry_[entry] = kNever;
  } else {
    holds_for(entry, step.least_gap(overlaps, apart));
  }

  // The pair that overlaps most comes last, because the last entry is visited first.
  const std::size_t first = open_.size();
  while (near != 0) {
    const int pair = step.deepest(overlaps, near);
    const Descent descent = step.descend(nodes, near, pair);
    open_.push_back(static_cast<std::uint32_t>(entries_.size()));
    add(descent.next, descent.is_leaf, entry);
    near &= ~descent.including;
  }
  std::reverse(open_.begin() + static_cast<std::ptrdiff_t>(first), open_.end());
}

bool CoherentFront::visit_leaves(std::size_t entry, const QueryFrame& frame, DopVisit& step, VisitedLeaves& leaves,
                                 QueryCounters& counters, TriangleVisitor& visitor) {
  const auto [leaf_M, leaf_N, all] = entries_[entry].pair;
  step.prepare(leaf_M, leaf_N, leaves);
  const double gap_of_all = step.leaf_gap(leaves, counters);
  if (step.beyond(gap_of_all)) {
    holds_for(entry, gap_of_all);
    return false;
  }
  PairMask near = step.leaves(leaves, counters);
  const CertainPairs certain = near == 0 ? CertainPairs{} : step.cross(leaves);
  // Pairs that answer the query at once come first; work needed only without an answer comes last.
  const auto answers = [&](int pair, const PairOutcome& outcome) {
    if (outcome.stop) take_last_hit(entry, pair);
    return outcome.stop;
  };
  const PairMask intersecting = near & certain.intersect;
  for (PairMask rest = intersecting; rest != 0; rest &= rest - 1) {
    const int pair = std::countr_zero(rest);
    if (answers(pair, visitor.found(leaf_M, leaf_N, pair))) return true;
  }
  near = step.edges(leaves, near & ~intersecting);
  std::array<double, kWidth * kWidth> distances;
  for (PairMask rest = near; rest != 0; rest &= rest - 1) {
    const int pair = std::countr_zero(rest);
    const PairOutcome outcome = visitor.visit(leaf_M, leaf_N, pair);
    if (answers(pair, outcome)) return true;
    distances[static_cast<std::size_t>(pair)] = outcome.distance;
  }
  double least_gap = intersecting != 0 ? -1.0 : step.least_gap(leaves, leaves.of_interest() & ~near);
  for (PairMask rest = near; rest != 0 && least_gap > 0.0; rest &= rest - 1) {
    const int pair = std::countr_zero(rest);
    double distance = distances[static_cast<std::size_t>(pair)];
    if (distance < 0.0) distance = visitor.distance(leaf_M, leaf_N, pair);
    const double gap =
        std::isfinite(distance) ? distance / frame.base_radius * (1.0 - 1e-9) - 4.0 * frame.uncertainty : 0.0;
    least_gap = std::min(least_gap, gap);
  }
  holds_for(entry, least_gap);
  return false;
}

}  // namespace glissade::collision
