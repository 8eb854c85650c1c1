#include "pipeline/neighbor_stage.h"

#include <iterator>

namespace glissade::collision {
namespace {

// Estimated time of the first query of a pair.
constexpr float kFirstQuery_ns = 5'000.0F;
// If more than one object in this many has changed, all pairs are visited.
constexpr std::ptrdiff_t kMostMove = 4;

}  // namespace

NeighborStage::NeighborStage(const World& world, const PlacedObjects& placed, BroadPhase& broad_phase, PairTable& pairs,
                             MeetingList& meetings)
    : world_(world),
      placed_(placed),
      broad_phase_(broad_phase),
      pairs_(pairs),
      meetings_(meetings),
      has_changed_(static_cast<std::size_t>(world.capacity()), 0) {}

void NeighborStage::find(const QueueStage& queue, std::uint64_t frame, double distance,
                         std::vector<PairTable::Number>& candidates, StageReport& report) {
  const bool is_other_distance = distance != distance_;
  frame_ = static_cast<std::uint32_t>(frame);
  distance_ = distance;
  candidates_ = &candidates;
  considered_ = 0;

  broad_phase_.update();
  candidates.clear();
  for (const SlotPair& slots : broad_phase_.ended())
    forget(slots);
  for (const SlotPair& slots : broad_phase_.began())
    track(slots);
  if (queue.interest_changed()) pairs_.for_each([&](PairTable::Number number) { renew_interest(number); });
  if (is_other_distance) {
    pairs_.for_each([&](PairTable::Number number) { consider(number); });
  } else {
    consider_changed(queue);
  }
  report.in = std::ssize(queue.changed());
  report.out = considered_;
}

void NeighborStage::track(const SlotPair& slots) {
  const PairTable::Number number = pairs_.add(slots);
  pairs_[number].is_enabled = world_.is_enabled(slots.a, slots.b);
  pairs_[number].expected_ns = kFirstQuery_ns;
}

void NeighborStage::forget(const SlotPair& slots) {
  const PairTable::Number number = pairs_.number_of(slots);
  meetings_.part(pairs_[number], number);
  pairs_.remove(number);
}

void NeighborStage::renew_interest(PairTable::Number number) {
  TrackedPair& pair = pairs_[number];
  const bool was_enabled = pair.is_enabled;
  pair.is_enabled = world_.is_enabled(pair.slots.a, pair.slots.b);
  if (!pair.is_enabled) meetings_.part(pair, number);
  if (pair.is_enabled && !was_enabled) consider(number);
}

void NeighborStage::consider_changed(const QueueStage& queue) {
  if (kMostMove * std::ssize(queue.changed()) > queue.objects()) {
    consider_changed_in_order(queue);
    return;
  }
  for (const std::uint32_t slot : queue.changed()) {
    for (const PairTable::Number number : pairs_.of_object(slot))
      consider(number);
  }
}

// Visits each pair once, in the order of memory. If most objects move, this is twice as fast as visiting by objects.
void NeighborStage::consider_changed_in_order(const QueueStage& queue) {
  for (const std::uint32_t slot : queue.changed())
    has_changed_[slot] = 1;
  pairs_.for_each([&](PairTable::Number number) {
    const SlotPair& slots = pairs_[number].slots;
    if ((has_changed_[slots.a] | has_changed_[slots.b]) != 0) consider(number);
  });
  for (const std::uint32_t slot : queue.changed())
    has_changed_[slot] = 0;
}

void NeighborStage::consider(PairTable::Number number) {
  TrackedPair& pair = pairs_[number];
  if (!pair.is_enabled || pair.frame == frame_) return;
  pair.frame = frame_;
  ++considered_;
  if (placed_.gap(pair.slots.a, pair.slots.b, pair.separation) > certain_distance(distance_)) {
    meetings_.part(pair, number);  // it may have met at a greater distance
  } else {
    candidates_->push_back(number);
  }
}

}  // namespace glissade::collision
