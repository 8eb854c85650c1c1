#include "search/known_pairs.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <optional>
#include <utility>

#include <glissade/base/assert.h>

#include "search/blocks_of_pairs.h"
#include "search/round_down.h"

namespace glissade::contact {
namespace {

/// Work of the gap of a pair along a known direction, in the unit of `collision::WorkMeter`.
constexpr std::int64_t kWorkOfGap = 2;

constexpr float kInfinite = std::numeric_limits<float>::infinity();

/// Of a pair of boxes, and of triangles whose planes are of no use.
constexpr std::uint32_t kNoPlanes = std::numeric_limits<std::uint32_t>::max();

std::span<const float> pairs_of_blocks(const std::vector<float>& of_slots, std::size_t first, std::size_t end) {
  return std::span(of_slots).subspan(kPlanesAtOnce * first, kPlanesAtOnce * (end - first));
}

}  // namespace

void KnownPairs::within(double reach, std::vector<TrianglesOfBodies>& pairs) const {
  pairs.clear();
  search_.visit_within(search_.set.pairs, reach, [&](const NearPair& pair) {
    if (pair.may_yield_contact) pairs.push_back(pair);
  });
}

void KnownPairs::within(double reach, std::vector<PairToCertify>& pairs) const {
  pairs.clear();
  search_.visit_within(search_.set.boxes, reach, [&](const PairToCertify& pair) { pairs.push_back(pair); });
  search_.visit_within(search_.set.pairs, reach, [&](const NearPair& pair) {
    if (pair.is_to_certify) pairs.push_back(to_certify(pair));
  });
}

void KnownPairs::take(TrackedSearch& next, std::span<const Eigen::Isometry3d> X_WB) {
  std::swap(search_, next);
  next.is_there = false;
  clock_ = 0.0;
  X_WB_of_clock_.assign(X_WB.begin(), X_WB.end());
  known_.assign(search_.set.pairs.size(), {});
  of_bodies_.resize(search_.set.planes.size());
  for (std::size_t i = 0; i < of_bodies_.size(); ++i)
    take_pairs_of(search_.set.planes[i], of_bodies_[i]);
}

/// The pairs of a block are in the order of the search, the nearest first.
void KnownPairs::take_pairs_of(const PlanesOfBodies& planes, OfBodies& known) const {
  const auto unless = [](bool is_asked_for) { return is_asked_for ? -kInfinite : kInfinite; };
  known.contacts.assign(kPlanesAtOnce * planes.block_count(), kInfinite);
  known.to_certify.assign(kPlanesAtOnce * planes.block_count(), kInfinite);
  known.blocks_of_contacts.clear();
  for (std::size_t slot = 0; slot < planes.numbers().size(); ++slot) {
    const NearPair& pair = search_.set.pairs[planes.numbers()[slot]];
    known.contacts[slot] = unless(pair.may_yield_contact);
    known.to_certify[slot] = unless(pair.is_to_certify);
    if (slot % kPlanesAtOnce == 0) known.blocks_of_contacts.push_back(pair.distance - search_.drift);
  }
  known.blocks_to_certify = known.blocks_of_contacts;
}

void KnownPairs::moved(std::span<const Eigen::Isometry3d> X_WB) {
  if (!search_.is_there) return;
  search_.follow(scene_, X_WB);
  clock_ += approach(scene_, X_WB_of_clock_, X_WB, motions_of_clock_);
  X_WB_of_clock_.assign(X_WB.begin(), X_WB.end());
}

std::size_t KnownPairs::find_gaps(double reach, std::vector<GapsBySlot>& gaps) {
  std::size_t count = 0;
  const float clock = round_up(clock_);
  gaps.resize(search_.set.planes.size());
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    const PlanesOfBodies& planes = search_.set.planes[i];
    const PlaneMaps maps =
        planes.maps(relative_pose(scene_.bodies()[static_cast<std::size_t>(planes.bodies().obstacle)].X_WB,
                                  scene_.bodies()[static_cast<std::size_t>(planes.bodies().part)].X_WB));
    OfBodies& known = of_bodies_[i];
    std::vector<float>& of_slots = gaps[i].gaps;
    std::vector<float>& of_blocks = gaps[i].of_blocks;
    of_slots.resize(kPlanesAtOnce * planes.block_count());
    of_blocks.assign(planes.block_count(), kInfinite);
    const auto is_near = [&](double gap) { return gap - clock_ <= reach; };
    visit_runs_of_blocks(known.blocks_of_contacts, is_near, [&](std::size_t first, std::size_t end) {
      planes.find_gaps(maps, first, end, of_slots);
      raise_gaps(pairs_of_blocks(known.contacts, first, end), clock, of_slots.data() + kPlanesAtOnce * first,
                 of_blocks.data() + first);
      for (std::size_t block = first; block < end; ++block) {
        known.blocks_of_contacts[block] =
            std::max(known.blocks_of_contacts[block], static_cast<double>(of_blocks[block]) + clock_);
        if (static_cast<double>(of_blocks[block]) > reach) continue;
        const PairsOfBlock pairs = find_pairs_within(round_down(reach), of_slots.data() + kPlanesAtOnce * block);
        count += static_cast<std::size_t>(std::popcount(pairs));
      }
    });
  }
  return count;
}

KnownFeatures KnownPairs::known_features(std::uint32_t number, double reach) const {
  const KnownFeatures& known = known_[number];
  return known.left_out > reach + clock_ ? KnownFeatures{known.features, known.left_out - clock_} : KnownFeatures{};
}

void KnownPairs::note_gaps(std::span<const PlaceOfPair> pairs, std::span<const GapsOfPair> gaps) {
  GLISSADE_ASSERT(pairs.size() == gaps.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    float& gap = of_bodies_[pairs[i].planes].contacts[pairs[i].slot];
    gap = std::max(gap, round_down(gaps[i].least + clock_));
    if (gaps[i].left_out > 0.0) known_[pairs[i].number] = {gaps[i].features, gaps[i].left_out + clock_};
  }
}

void KnownPairs::unproved_within(double reach, PathCertificate& certificate, std::vector<PairToCertify>& unproved,
                                 WorkBudget& budget) {
  unproved.clear();
  places_.clear();
  search_.visit_within(search_.set.boxes, reach, [&](const PairToCertify& boxes) {
    unproved.push_back(boxes);
    places_.push_back({.number = 0, .planes = kNoPlanes, .slot = 0});
  });
  for (std::uint32_t i = 0; i < search_.set.planes.size(); ++i) {
    const PlanesOfBodies& planes = search_.set.planes[i];
    if (const std::optional<PathOfBodies> path = certificate.path_of(planes.bodies(), planes.ball())) {
      add_unproved(*path, i, unproved, budget);
      continue;
    }
    for (const std::uint32_t number : planes.numbers()) {
      const NearPair& pair = search_.set.pairs[number];
      if (pair.distance > reach + search_.drift) break;  // as are all that follow
      if (!pair.is_to_certify || search_.still_apart(pair.bodies, pair.distance, pair.n_W) > reach) continue;
      unproved.push_back(to_certify(pair));
      places_.push_back({.number = number, .planes = kNoPlanes, .slot = 0});
    }
  }
}

/// Adds the pairs of two bodies whose planes do not keep them apart on this path.
void KnownPairs::add_unproved(const PathOfBodies& path, std::uint32_t number_of_planes,
                              std::vector<PairToCertify>& unproved, WorkBudget& budget) {
  const PlanesOfBodies& planes = search_.set.planes[number_of_planes];
  OfBodies& known = of_bodies_[number_of_planes];
  const PlaneMaps at_begin = planes.maps(path.X_OV_begin);
  const PlaneMaps at_end = planes.maps(path.X_OV_end);
  const NeededGaps needed{round_up(path.needed), round_up(path.needed_turning), round_down(path.far)};
  least_gaps_.resize(planes.block_count());
  const auto is_near = [&](double gap) { return gap - clock_ <= path.far; };
  visit_runs_of_blocks(known.blocks_to_certify, is_near, [&](std::size_t first, std::size_t end) {
    planes.find_gaps(at_begin, first, end, gaps_at_begin_);
    planes.find_gaps(at_end, first, end, gaps_at_end_);
    raise_gaps(pairs_of_blocks(known.to_certify, first, end), 0.0F, gaps_at_begin_.data() + kPlanesAtOnce * first,
               least_gaps_.data() + first);
    budget.spend(2 * kWorkOfGap * static_cast<std::int64_t>(kPlanesAtOnce * (end - first)));
    for (std::size_t block = first; block < end; ++block) {
      known.blocks_to_certify[block] =
          std::max(known.blocks_to_certify[block], static_cast<double>(least_gaps_[block]) + clock_);
      const std::size_t slot = kPlanesAtOnce * block;
      const PairsOfBlock pairs =
          find_unproved(planes.block(block), needed, gaps_at_begin_.data() + slot, gaps_at_end_.data() + slot);
      for_each_pair(block, pairs, [&](std::size_t of_pair) {
        const std::uint32_t number = planes.numbers()[of_pair];
        unproved.push_back(to_certify(search_.set.pairs[number]));
        places_.push_back({number, number_of_planes, static_cast<std::uint32_t>(of_pair)});
      });
    }
  });
}

void KnownPairs::note_planes(std::span<const SeparatedPair> separated) {
  for (const SeparatedPair& pair : separated) {
    const PlaceOfPair& place = places_[pair.place];
    if (place.planes == kNoPlanes) continue;
    search_.set.planes[place.planes].turn(place.slot, pair.direction, scene_.bodies());
  }
}

}  // namespace glissade::contact
