#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

// Boost 1.74 includes one of its own deprecated headers.
#define BOOST_ALLOW_DEPRECATED_HEADERS
#include <boost/geometry/algorithms/covered_by.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>

#include <glissade/base/assert.h>

#include "pipeline/broad_phase.h"

namespace glissade::collision {
namespace {

// Measured: larger boxes save more time here than their additional pairs cost (docs/collision.md).
constexpr double kFatOfSize = 0.1;     // of the mean edge
constexpr double kFramesAhead = 32.0;  // of the last frame's step
constexpr double kLongestAhead = 1.0;  // of the mean edge, because a leap does not predict motion

Eigen::AlignedBox3d grown(const Eigen::AlignedBox3d& box, double by) {
  const Eigen::Vector3d border = Eigen::Vector3d::Constant(by);
  return {box.min() - border, box.max() + border};
}

Eigen::AlignedBox3d fattened(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& step) {
  const double edge = box.sizes().mean();
  const double longest = kLongestAhead * edge;
  const Eigen::Vector3d ahead = (kFramesAhead * step).cwiseMax(-longest).cwiseMin(longest);
  Eigen::AlignedBox3d fat = grown(box, kFatOfSize * edge);
  fat.min() += ahead.cwiseMin(0.0);
  fat.max() += ahead.cwiseMax(0.0);
  return fat;
}

SlotPair pair_of(std::uint32_t a, std::uint32_t b) {
  return a < b ? SlotPair{a, b} : SlotPair{b, a};
}

}  // namespace

// Boost's R-tree.
class BroadPhase::BoxTree {
 public:
  void insert(std::uint32_t slot, const Eigen::AlignedBox3d& box) { tree_.insert(Entry(boost_box(box), slot)); }

  void remove(std::uint32_t slot, const Eigen::AlignedBox3d& box) {
    [[maybe_unused]] const std::size_t removed = tree_.remove(Entry(boost_box(box), slot));
    GLISSADE_ASSERT(removed == 1);
  }

  /// Appends the slots whose boxes overlap or touch this one, in no particular order.
  void find(const Eigen::AlignedBox3d& box, std::vector<std::uint32_t>& slots) const {
    const auto append = [&slots](const Entry& entry) { slots.push_back(entry.second); };
    tree_.query(boost::geometry::index::intersects(boost_box(box)), boost::make_function_output_iterator(append));
  }

 private:
  using Point = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
  using Box = boost::geometry::model::box<Point>;
  using Entry = std::pair<Box, std::uint32_t>;
  struct IsSameSlot {
    bool operator()(const Entry& a, const Entry& b) const { return a.second == b.second; }
  };

  static Box boost_box(const Eigen::AlignedBox3d& box) {
    return {{box.min().x(), box.min().y(), box.min().z()}, {box.max().x(), box.max().y(), box.max().z()}};
  }

  boost::geometry::index::rtree<Entry, boost::geometry::index::linear<8>, boost::geometry::index::indexable<Entry>,
                                IsSameSlot>
      tree_;
};

BroadPhase::BroadPhase(std::size_t capacity, double margin)
    : half_margin_(0.5 * margin), slots_(capacity), fat_boxes_(std::make_unique<BoxTree>()) {
  if (capacity == 0) throw std::invalid_argument("a broad phase needs at least one slot");
  if (!(margin >= 0.0) || std::isinf(margin)) {
    throw std::invalid_argument("the margin " + std::to_string(margin) + " of a broad phase is not a distance");
  }
}

BroadPhase::~BroadPhase() = default;
BroadPhase::BroadPhase(BroadPhase&&) noexcept = default;
BroadPhase& BroadPhase::operator=(BroadPhase&&) noexcept = default;

Eigen::AlignedBox3d BroadPhase::set(std::uint32_t slot, const Eigen::AlignedBox3d& box, const Eigen::Vector3d& step) {
  GLISSADE_ASSERT(slot < slots_.size() && !box.isEmpty() && box.min().allFinite() && box.max().allFinite());
  Slot& object = slots_[slot];
  if (!object.fat_box.isEmpty()) fat_boxes_->remove(slot, object.fat_box);
  // Compensates for the two roundings of this addition.
  const double largest = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  const Eigen::AlignedBox3d wide = grown(box, half_margin_ + (largest + half_margin_) * 0x1p-51);
  object.fat_box = fattened(wide, step);
  fat_boxes_->insert(slot, object.fat_box);
  if (!object.is_stale) stale_.push_back(slot);
  object.is_stale = true;
  return {object.fat_box.min() - wide.min(), object.fat_box.max() - wide.max()};
}

void BroadPhase::remove(std::uint32_t slot) {
  GLISSADE_ASSERT(slot < slots_.size() && !slots_[slot].fat_box.isEmpty());
  Slot& object = slots_[slot];
  fat_boxes_->remove(slot, object.fat_box);
  object.fat_box.setEmpty();
  for (const std::uint32_t neighbor : object.neighbors)
    part(slot, neighbor, removed_);
  object.neighbors.clear();
}

// Differences are entered at both ends at once, so that the other end, if it is stale as well, does not find them
// again.
void BroadPhase::update() {
  began_.clear();
  ended_.clear();
  ended_.swap(removed_);
  for (const std::uint32_t slot : stale_) {
    slots_[slot].is_stale = false;
    if (!slots_[slot].fat_box.isEmpty()) find_pairs(slot);
  }
  stale_.clear();
  std::sort(began_.begin(), began_.end());
  std::sort(ended_.begin(), ended_.end());
}

void BroadPhase::find_pairs(std::uint32_t slot) {
  std::vector<std::uint32_t>& former = slots_[slot].neighbors;
  found_.clear();
  fat_boxes_->find(slots_[slot].fat_box, found_);
  std::sort(found_.begin(), found_.end());
  found_.erase(std::lower_bound(found_.begin(), found_.end(), slot));
  auto old = former.begin();
  for (const std::uint32_t neighbor : found_) {
    for (; old != former.end() && *old < neighbor; ++old)
      part(slot, *old, ended_);
    if (old != former.end() && *old == neighbor) {
      ++old;
    } else {
      join(slot, neighbor);
    }
  }
  for (; old != former.end(); ++old)
    part(slot, *old, ended_);
  former.assign(found_.begin(), found_.end());
}

// These change the list of `neighbor` only, because the list of `slot` is being traversed.
void BroadPhase::join(std::uint32_t slot, std::uint32_t neighbor) {
  std::vector<std::uint32_t>& others = slots_[neighbor].neighbors;
  others.insert(std::lower_bound(others.begin(), others.end(), slot), slot);
  began_.push_back(pair_of(slot, neighbor));
  ++pair_count_;
}

void BroadPhase::part(std::uint32_t slot, std::uint32_t neighbor, std::vector<SlotPair>& list) {
  std::vector<std::uint32_t>& others = slots_[neighbor].neighbors;
  others.erase(std::lower_bound(others.begin(), others.end(), slot));
  list.push_back(pair_of(slot, neighbor));
  --pair_count_;
}

std::vector<SlotPair> BroadPhase::pairs() const {
  std::vector<SlotPair> pairs;
  pairs.reserve(pair_count_);
  for (std::uint32_t slot = 0; slot < slots_.size(); ++slot) {
    for (const std::uint32_t neighbor : slots_[slot].neighbors) {
      if (slot < neighbor) pairs.push_back({slot, neighbor});
    }
  }
  return pairs;
}

}  // namespace glissade::collision
