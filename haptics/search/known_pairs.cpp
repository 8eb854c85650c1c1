#include "search/known_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <glissade/base/assert.h>

#include "search/round_down.h"

namespace glissade::haptics {
namespace {

/// Work of the gap of a pair along a known direction, in the unit of `collision::WorkMeter`.
constexpr std::int64_t kWorkOfGap = 2;

/// So many blocks of planes fit into the fastest cache.
constexpr std::ptrdiff_t kBlocksInCache = 16;

}  // namespace

void KnownPairs::within(double reach, std::vector<NearPair>& pairs) const {
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
  gaps_.assign(search_.set.pairs.size(), 0.0);
  known_.assign(search_.set.pairs.size(), {});
  gaps_of_contacts_ = gaps_at_search();
  gaps_to_certify_ = gaps_of_contacts_;
}

void KnownPairs::moved(std::span<const Eigen::Isometry3d> X_WB) {
  if (!search_.is_there) return;
  search_.follow(scene_, X_WB);
  clock_ += approach(scene_, X_WB_of_clock_, X_WB, motions_of_clock_);
  X_WB_of_clock_.assign(X_WB.begin(), X_WB.end());
}

/// The pairs of a block are in the order of the search, the nearest first.
KnownPairs::GapsOfBlocks KnownPairs::gaps_at_search() const {
  GapsOfBlocks gaps;
  for (const PlanesOfBodies& of_bodies : search_.set.planes) {
    std::vector<double>& of_blocks = gaps.emplace_back();
    for (std::size_t slot = 0; slot < of_bodies.numbers().size(); slot += kPlanesAtOnce)
      of_blocks.push_back(search_.set.pairs[of_bodies.numbers()[slot]].distance - search_.drift);
  }
  return gaps;
}

/// Visits the runs of blocks that may have gaps up to `reach`, by their beginnings and ends.
template <typename Visit>
void KnownPairs::visit_near_blocks(const std::vector<double>& gaps, double reach, const Visit& visit) const {
  const auto is_near = [&](double gap) { return gap - clock_ <= reach; };
  auto first = std::find_if(gaps.begin(), gaps.end(), is_near);
  while (first != gaps.end()) {
    const auto end = std::find_if_not(first, first + std::min(kBlocksInCache, gaps.end() - first), is_near);
    visit(static_cast<std::size_t>(first - gaps.begin()), static_cast<std::size_t>(end - gaps.begin()));
    first = std::find_if(end, gaps.end(), is_near);
  }
}

void KnownPairs::in_reach(double reach, std::vector<PairInReach>& pairs) {
  pairs.clear();
  for (std::uint32_t i = 0; i < search_.set.planes.size(); ++i) {
    const PlanesOfBodies& planes = search_.set.planes[i];
    const PlaneMaps maps =
        planes.maps(relative_pose(scene_.bodies()[static_cast<std::size_t>(planes.bodies().obstacle)].X_WB,
                                  scene_.bodies()[static_cast<std::size_t>(planes.bodies().part)].X_WB));
    const std::span<const std::uint32_t> numbers = planes.numbers();
    std::vector<double>& of_blocks = gaps_of_contacts_[i];
    visit_near_blocks(of_blocks, reach, [&](std::size_t first, std::size_t end) {
      planes.find_gaps(maps, first, end, gaps_at_begin_);
      for (std::size_t block = first; block < end; ++block) {
        double least = std::numeric_limits<double>::infinity();
        const std::size_t last = std::min(numbers.size(), kPlanesAtOnce * (block + 1));
        for (std::size_t slot = kPlanesAtOnce * block; slot < last; ++slot) {
          const auto along_plane = static_cast<double>(gaps_at_begin_[slot]);
          if (along_plane > reach) {
            least = std::min(least, along_plane);
            continue;
          }
          const std::uint32_t number = numbers[slot];
          const NearPair& pair = search_.set.pairs[number];
          if (!pair.may_yield_contact) continue;
          const double gap = std::max(along_plane, gaps_[number] - clock_);
          least = std::min(least, gap);
          if (gap > reach) continue;
          pairs.push_back({number, i, static_cast<std::uint32_t>(slot), round_down(gap)});
        }
        of_blocks[block] = std::max(of_blocks[block], least + clock_);
      }
    });
  }
  if (search_.set.planes.size() < 2) return;
  std::sort(pairs.begin(), pairs.end(), [](const PairInReach& a, const PairInReach& b) { return a.number < b.number; });
}

KnownFeatures KnownPairs::known_features(std::uint32_t number, double reach) const {
  const KnownFeatures& known = known_[number];
  return known.left_out > reach + clock_ ? KnownFeatures{known.features, known.left_out - clock_} : KnownFeatures{};
}

void KnownPairs::note_gaps(std::span<const std::uint32_t> numbers, std::span<const GapsOfPair> gaps) {
  GLISSADE_ASSERT(numbers.size() == gaps.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    double& gap = gaps_[numbers[i]];
    gap = std::max(gap, gaps[i].least + clock_);
    if (gaps[i].left_out > 0.0) known_[numbers[i]] = {gaps[i].features, gaps[i].left_out + clock_};
  }
}

void KnownPairs::unproved_within(double reach, PathCertificate& certificate, std::vector<PairToCertify>& unproved,
                                 WorkBudget& budget) {
  unproved.clear();
  places_.clear();
  search_.visit_within(search_.set.boxes, reach, [&](const PairToCertify& boxes) {
    unproved.push_back(boxes);
    places_.push_back({nullptr, 0, 0});
  });
  for (std::size_t i = 0; i < search_.set.planes.size(); ++i) {
    PlanesOfBodies& planes = search_.set.planes[i];
    const std::span<const std::uint32_t> numbers = planes.numbers();
    const std::optional<PathOfBodies> known_path = certificate.path_of(planes.bodies(), planes.ball());
    if (!known_path) {
      for (const std::uint32_t number : numbers) {
        const NearPair& pair = search_.set.pairs[number];
        if (pair.distance > reach + search_.drift) break;  // as are all that follow
        if (!pair.is_to_certify || search_.still_apart(pair.bodies, pair.distance, pair.n_W) > reach) continue;
        unproved.push_back(to_certify(pair));
        places_.push_back({nullptr, 0, number});
      }
      continue;
    }
    const PathOfBodies& path = *known_path;
    const PlaneMaps at_begin = planes.maps(path.X_OV_begin);
    const PlaneMaps at_end = planes.maps(path.X_OV_end);
    std::vector<double>& of_blocks = gaps_to_certify_[i];
    visit_near_blocks(of_blocks, path.far, [&](std::size_t first, std::size_t end) {
      planes.find_gaps(at_begin, first, end, gaps_at_begin_);
      planes.find_gaps(at_end, first, end, gaps_at_end_);
      budget.spend(2 * kWorkOfGap * static_cast<std::int64_t>(kPlanesAtOnce * (end - first)));
      for (std::size_t block = first; block < end; ++block) {
        double least = std::numeric_limits<double>::infinity();
        const std::size_t last = std::min(numbers.size(), kPlanesAtOnce * (block + 1));
        for (std::size_t slot = kPlanesAtOnce * block; slot < last; ++slot) {
          const auto gap = static_cast<double>(gaps_at_begin_[slot]);
          if (gap > path.far) {
            least = std::min(least, gap);
            continue;
          }
          const NearPair& pair = search_.set.pairs[numbers[slot]];
          if (!pair.is_to_certify) continue;
          least = std::min(least, gap);
          const double needed = planes.turns_with_part(slot) ? path.needed_turning : path.needed;
          if (std::min(gap, static_cast<double>(gaps_at_end_[slot])) >= needed) continue;
          unproved.push_back(to_certify(pair));
          places_.push_back({&planes, slot, numbers[slot]});
        }
        of_blocks[block] = std::max(of_blocks[block], least + clock_);
      }
    });
  }
}

void KnownPairs::note_planes(std::span<const SeparatedPair> separated) {
  for (const SeparatedPair& pair : separated) {
    const PlaceOfPair& place = places_[pair.place];
    if (place.planes == nullptr) continue;
    place.planes->turn(place.slot, search_.set.pairs[place.number], pair.direction, scene_.bodies());
  }
}

}  // namespace glissade::haptics
