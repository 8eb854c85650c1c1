#include "pipeline/broad_phase.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <ostream>
#include <set>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_numbers.h"
#include "sanitizers.h"

namespace glissade::collision {

void PrintTo(const SlotPair& pair, std::ostream* out) {
  *out << '(' << pair.a << ", " << pair.b << ')';
}

namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr std::uint64_t kBroadPhaseSeed = 20261122;

Eigen::AlignedBox3d cube(const Eigen::Vector3d& center, double half_edge) {
  return {center - Eigen::Vector3d::Constant(half_edge), center + Eigen::Vector3d::Constant(half_edge)};
}

Eigen::AlignedBox3d unit_cube(double x) {
  return cube({x, 0.0, 0.0}, 0.5);
}

TEST(BroadPhase, SaysWhichPairsBeginAndEnd) {
  BroadPhase broad_phase(8);
  broad_phase.set(5, unit_cube(0.0));
  broad_phase.set(2, unit_cube(10.0));
  broad_phase.update();
  EXPECT_THAT(broad_phase.began(), IsEmpty());

  broad_phase.set(5, unit_cube(9.5));
  EXPECT_THAT(broad_phase.began(), IsEmpty()) << "before the update";
  broad_phase.update();
  EXPECT_THAT(broad_phase.began(), ElementsAre(SlotPair{2, 5}));
  EXPECT_THAT(broad_phase.ended(), IsEmpty());
  EXPECT_THAT(broad_phase.neighbors(2), ElementsAre(5U));
  EXPECT_THAT(broad_phase.neighbors(5), ElementsAre(2U));

  broad_phase.update();
  EXPECT_THAT(broad_phase.began(), IsEmpty());
  EXPECT_EQ(broad_phase.pair_count(), 1U);

  broad_phase.set(2, unit_cube(-10.0));
  broad_phase.update();
  EXPECT_THAT(broad_phase.ended(), ElementsAre(SlotPair{2, 5}));
  EXPECT_EQ(broad_phase.pair_count(), 0U);
}

TEST(BroadPhase, BoxesThatTouchAreAPair) {
  BroadPhase broad_phase(2);
  broad_phase.set(0, unit_cube(0.0));
  broad_phase.set(1, unit_cube(1.0));
  broad_phase.update();
  EXPECT_EQ(broad_phase.pair_count(), 1U);
}

// 0.1 and what it is added to are rounded; the boxes are apart by the margin.
TEST(BroadPhase, BoxesWithinTheMarginAreAPair) {
  for (const double x : {0.0, 3.0, 1e5 + 0.3}) {
    BroadPhase broad_phase(2, 0.1);
    const double right = x + 0.1;
    broad_phase.set(0, {Eigen::Vector3d(x - 1e-6, 0.0, 0.0), Eigen::Vector3d(x, 1e-6, 1e-6)});
    broad_phase.set(1, {Eigen::Vector3d(right, 0.0, 0.0), Eigen::Vector3d(right + 1e-6, 1e-6, 1e-6)});
    broad_phase.update();
    EXPECT_THAT(broad_phase.neighbors(0), ::testing::Contains(1U)) << x;
  }
}

TEST(BroadPhase, ASuccessorInTheSameSlotBeginsItsPairsAnew) {
  BroadPhase broad_phase(2);
  broad_phase.set(0, unit_cube(0.0));
  broad_phase.set(1, unit_cube(0.0));
  broad_phase.update();
  broad_phase.remove(1);
  broad_phase.set(1, unit_cube(0.1));
  broad_phase.update();
  EXPECT_THAT(broad_phase.ended(), ElementsAre(SlotPair{0, 1}));
  EXPECT_THAT(broad_phase.began(), ElementsAre(SlotPair{0, 1}));
  EXPECT_EQ(broad_phase.pair_count(), 1U);

  broad_phase.remove(0);
  broad_phase.remove(1);
  broad_phase.update();
  EXPECT_THAT(broad_phase.ended(), ElementsAre(SlotPair{0, 1})) << "each pair ends once";
  EXPECT_THAT(broad_phase.began(), IsEmpty());
}

TEST(BroadPhase, JitterDoesNotChangePairs) {
  BroadPhase broad_phase(2);
  broad_phase.set(0, unit_cube(0.0));
  broad_phase.set(1, unit_cube(1.0));
  broad_phase.update();
  for (int i = 0; i < 100; ++i) {
    broad_phase.set(1, unit_cube(i % 2 == 0 ? 1.01 : 0.99));
    broad_phase.update();
    EXPECT_THAT(broad_phase.began(), IsEmpty());
    EXPECT_THAT(broad_phase.ended(), IsEmpty());
  }
}

TEST(BroadPhase, JumpIsNotExtrapolatedAsAVelocity) {
  BroadPhase broad_phase(2);
  broad_phase.set(0, unit_cube(0.0));
  broad_phase.set(1, unit_cube(110.0));
  broad_phase.update();
  broad_phase.set(0, unit_cube(100.0), {100.0, 0.0, 0.0});
  broad_phase.update();
  EXPECT_EQ(broad_phase.pair_count(), 0U);
}

TEST(BroadPhase, AnObjectThatShrinksLetsGoOfWhatIsFarAway) {
  BroadPhase broad_phase(2);
  broad_phase.set(0, cube({0.0, 0.0, 0.0}, 10.0));
  broad_phase.set(1, unit_cube(8.0));
  broad_phase.update();
  broad_phase.set(0, unit_cube(0.0));
  broad_phase.update();
  EXPECT_EQ(broad_phase.pair_count(), 0U);
}

TEST(BroadPhase, RefusesInvalidCapacitiesAndMargins) {
  EXPECT_THROW(BroadPhase(0), std::invalid_argument);
  EXPECT_THROW(BroadPhase(1, -1e-3), std::invalid_argument);
  EXPECT_THROW(BroadPhase(1, std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
  EXPECT_THROW(BroadPhase(1, std::numeric_limits<double>::infinity()), std::invalid_argument);
}

// Boxes of very different sizes come, go, drift and leap. Beside the broad phase: all boxes against all.
class MovingBoxes {
 public:
  static constexpr std::uint32_t kSlots = 60;

  explicit MovingBoxes(std::uint64_t seed, double margin)
      : margin_(margin), random_(seed), broad_phase_(kSlots, margin) {}

  void step() {
    for (int changes = random_.integer(0, 12); changes > 0; --changes)
      change(static_cast<std::uint32_t>(random_.integer(0, kSlots - 1)));
    broad_phase_.update();
    follow_changes();
  }

  /// All that overlap are pairs, and no pair is further apart than fat boxes reach beyond boxes.
  void compare() const {
    std::size_t overlapping = 0;
    for (std::uint32_t a = 0; a < kSlots; ++a) {
      for (std::uint32_t b = a + 1; b < kSlots; ++b) {
        const bool is_pair = pairs_.contains({a, b});
        if (boxes_[a].isEmpty() || boxes_[b].isEmpty()) {
          ASSERT_FALSE(is_pair);
          continue;
        }
        const double gap = (boxes_[a].min() - boxes_[b].max()).cwiseMax(boxes_[b].min() - boxes_[a].max()).maxCoeff();
        ASSERT_TRUE(gap > margin_ || is_pair) << a << ", " << b;
        const double edges = boxes_[a].sizes().mean() + boxes_[b].sizes().mean() + 2.0 * margin_;
        ASSERT_TRUE(gap <= margin_ + 1.21 * edges || !is_pair) << a << ", " << b;
        overlapping += gap <= margin_ ? 1U : 0U;
      }
    }
    ASSERT_LE(overlapping, pairs_.size());
  }

  const std::set<SlotPair>& pairs() const { return pairs_; }
  const BroadPhase& broad_phase() const { return broad_phase_; }

 private:
  void change(std::uint32_t slot) {
    Eigen::AlignedBox3d& box = boxes_[slot];
    Eigen::Vector3d step = Eigen::Vector3d::Zero();
    if (box.isEmpty() || random_.chance(0.1)) {
      const Eigen::Vector3d size =
          random_.power_of_ten(-2.0, 0.8) * Eigen::Vector3d(1.0, random_.uniform(0.1, 1.0), 0.5);
      const Eigen::Vector3d center = random_.point(3.0);
      box = {center - size, center + size};
    } else if (random_.chance(0.1)) {
      box.setEmpty();
      broad_phase_.remove(slot);
      return;
    } else if (random_.chance(0.1)) {
      broad_phase_.remove(slot);
    } else {
      step = 0.2 * box.sizes().mean() * random_.point(1.0);
      box.translate(step);
      rooms_[slot].translate((-step).eval());
      if (rooms_[slot].contains(Eigen::Vector3d::Zero().eval())) return;
    }
    rooms_[slot] = broad_phase_.set(slot, box, step);
  }

  // The set as one knows it who hears of changes only.
  void follow_changes() {
    ASSERT_TRUE(std::is_sorted(broad_phase_.ended().begin(), broad_phase_.ended().end()));
    ASSERT_TRUE(std::is_sorted(broad_phase_.began().begin(), broad_phase_.began().end()));
    for (const SlotPair& pair : broad_phase_.ended())
      ASSERT_EQ(pairs_.erase(pair), 1U);
    for (const SlotPair& pair : broad_phase_.began())
      ASSERT_TRUE(pairs_.insert(pair).second);
    const std::vector<SlotPair> all = broad_phase_.pairs();
    ASSERT_TRUE(std::equal(all.begin(), all.end(), pairs_.begin(), pairs_.end()));
    ASSERT_EQ(broad_phase_.pair_count(), all.size());
  }

  double margin_;
  test_support::RandomNumbers random_;
  BroadPhase broad_phase_;
  std::vector<Eigen::AlignedBox3d> boxes_ = std::vector<Eigen::AlignedBox3d>(kSlots);
  std::vector<Eigen::AlignedBox3d> rooms_ = std::vector<Eigen::AlignedBox3d>(kSlots);  ///< how far each may move
  std::set<SlotPair> pairs_;
};

TEST(BroadPhase, MatchesBruteForceUnderRandomChanges) {
  RecordProperty("seed", static_cast<int>(kBroadPhaseSeed));
  for (const double margin : {0.0, 0.05}) {
    MovingBoxes boxes(kBroadPhaseSeed, margin);
    for (int step = 0; step < test_support::affordable(4000); ++step) {
      boxes.step();
      boxes.compare();
      ASSERT_FALSE(HasFatalFailure()) << "seed " << kBroadPhaseSeed << ", margin " << margin << ", step " << step;
    }
  }
}

TEST(BroadPhase, TheSameCallsGiveTheSamePairs) {
  RecordProperty("seed", static_cast<int>(kBroadPhaseSeed));
  MovingBoxes first(kBroadPhaseSeed, 0.0);
  MovingBoxes second(kBroadPhaseSeed, 0.0);
  for (int step = 0; step < test_support::affordable(2000); ++step) {
    first.step();
    second.step();
    ASSERT_EQ(first.pairs(), second.pairs()) << "seed " << kBroadPhaseSeed << ", step " << step;
  }
}

}  // namespace
}  // namespace glissade::collision
