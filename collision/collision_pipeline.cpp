#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include <glissade/collision/broad_phase.h>
#include <glissade/collision/collision_pipeline.h>
#include <glissade/collision/world_box.h>

#include "pair_checks.h"
#include "pair_table.h"
#include "placed_objects.h"
#include "work_crew.h"

namespace glissade::collision {
namespace {

const PipelineOptions& checked(const PipelineOptions& options) {
  if (!(options.greatest_distance >= 0.0 && std::isfinite(options.greatest_distance))) {
    throw std::invalid_argument("the greatest distance of a collision pipeline must be finite and not negative, not " +
                                std::to_string(options.greatest_distance) + " m");
  }
  if (options.threads < 0) {
    throw std::invalid_argument("a collision pipeline cannot have " + std::to_string(options.threads) + " threads");
  }
  return options;
}

// What looking at a pair takes, before anything is known about it.
constexpr double kHullTest_ns = 200.0;
constexpr float kFirstQuery_ns = 5'000.0F;
// Work that is handed out at a time: large beside the cost of that, small beside a frame.
constexpr double kChunk_ns = 20'000.0;
// Pairs from now, for the steps of `PairChecks::prefetch`: a query takes about as long as memory.
constexpr std::array<std::size_t, 4> kPrefetchAhead{6, 4, 2, 1};
// One over the share of objects from which on all pairs are gone through.
constexpr std::ptrdiff_t kMostMove = 4;
// A pair that takes so long is begun with.
constexpr float kLong_ns = 20'000.0F;

std::size_t chunk_of(std::size_t count, double expected_ns) {
  const double each = std::max(expected_ns / static_cast<double>(std::max<std::size_t>(count, 1)), 1.0);
  return static_cast<std::size_t>(std::max(1.0, kChunk_ns / each));
}

}  // namespace

class CollisionPipeline::Frame {
 public:
  Frame(World& world, const realtime::Clock& clock, const PipelineOptions& options)
      : world_(world),
        clock_(clock),
        options_(checked(options)),
        crew_(options.threads),
        placed_(static_cast<std::size_t>(world.capacity())),
        broad_phase_(static_cast<std::size_t>(world.capacity()), certain_distance(options.greatest_distance)),
        checks_(world_, placed_, options_, crew_),
        has_changed_(static_cast<std::size_t>(world.capacity()), 0) {}

  const FrameResult& step(double distance) {
    if (!(distance >= 0.0 && distance <= options_.greatest_distance)) {
      throw std::invalid_argument("the distance of a frame must be 0 to the greatest of the pipeline, " +
                                  std::to_string(options_.greatest_distance) + " m, not " + std::to_string(distance));
    }
    const bool is_other_distance = distance != distance_;
    distance_ = distance;
    ++result_.frame;
    result_.report = {};
    result_.time_of_poses = clock_.now();
    lap_ = result_.time_of_poses;
    if (was_shared_) crew_.wake();

    take_changes();
    end_stage(result_.report.queue);
    find_neighbors(is_other_distance);
    end_stage(result_.report.neighbor_finding);
    test_hulls();
    end_stage(result_.report.separating_planes);
    test_exactly();
    end_stage(result_.report.exact);
    update_result();
    end_stage(result_.report.result);
    result_.report.neighbors = static_cast<std::int64_t>(pairs_.size());
    result_.report.objects = objects_;
    result_.report.total = clock_.now() - result_.time_of_poses;
    return result_;
  }

  const FrameResult& result() const { return result_; }

 private:
  using Numbers = std::vector<PairTable::Number>;

  /// Two objects that meet, or did. In the order of their slots.
  struct Meeting {
    SlotPair slots;
    PairTable::Number number;

    bool operator<(const Meeting& other) const { return slots < other.slots; }
  };

  void end_stage(StageReport& stage) {
    const std::chrono::nanoseconds now = clock_.now();
    stage.time = now - lap_;
    lap_ = now;
  }

  // Stage 0: who is where.
  void take_changes() {
    const WorldChanges& changes = world_.take_changes();
    for (const std::uint32_t slot : changes.removed)
      broad_phase_.remove(slot);
    for (const std::uint32_t slot : changes.added) {
      placed_.place(slot, world_.objects()[slot]);
      set_box(slot, Eigen::Vector3d::Zero());
    }
    for (const std::uint32_t slot : changes.moved) {
      const Eigen::Vector3d step = placed_.move(slot, world_.objects()[slot]);
      if (!placed_.has_room(slot)) set_box(slot, step);
    }
    objects_ += std::ssize(changes.added) - std::ssize(changes.removed);
    interest_changed_ = changes.interest;
    changed_.clear();
    std::merge(changes.added.begin(), changes.added.end(), changes.moved.begin(), changes.moved.end(),
               std::back_inserter(changed_));
    result_.report.queue.in = std::ssize(changed_) + std::ssize(changes.removed);
    result_.report.queue.out = std::ssize(changed_);
  }

  void set_box(std::uint32_t slot, const Eigen::Vector3d& step) {
    const WorldObject& object = world_.objects()[slot];
    placed_.give_room(slot, broad_phase_.set(slot, world_box(*object.tree, object.X_WO), step));
  }

  // Stage 1: which pairs may have become near or met, or parted again.
  void find_neighbors(bool all) {
    broad_phase_.update();
    candidates_.clear();
    for (const SlotPair& slots : broad_phase_.ended())
      forget(slots);
    for (const SlotPair& slots : broad_phase_.began())
      track(slots);
    if (interest_changed_) pairs_.for_each([&](PairTable::Number number) { renew_interest(number); });
    if (all) {
      pairs_.for_each([&](PairTable::Number number) { consider(number); });
    } else if (kMostMove * std::ssize(changed_) > objects_) {
      consider_changed_in_order();
    } else {
      for (const std::uint32_t slot : changed_) {
        for (const PairTable::Number number : pairs_.of_object(slot))
          consider(number);
      }
    }
    result_.report.neighbor_finding.in = result_.report.queue.out;
  }

  void track(const SlotPair& slots) {
    const PairTable::Number number = pairs_.add(slots);
    pairs_[number].is_of_interest = world_.attends(slots.a, slots.b);
    pairs_[number].expected_ns = kFirstQuery_ns;
  }

  void forget(const SlotPair& slots) {
    const PairTable::Number number = pairs_.number_of(slots);
    part(number);
    pairs_.remove(number);
  }

  void renew_interest(PairTable::Number number) {
    TrackedPair& pair = pairs_[number];
    const bool was_of_interest = pair.is_of_interest;
    pair.is_of_interest = world_.attends(pair.slots.a, pair.slots.b);
    if (!pair.is_of_interest) part(number);
    if (pair.is_of_interest && !was_of_interest) consider(number);
  }

  // In the order of memory, each pair once: where most objects move, this is twice as fast as by objects.
  void consider_changed_in_order() {
    for (const std::uint32_t slot : changed_)
      has_changed_[slot] = 1;
    pairs_.for_each([&](PairTable::Number number) {
      const SlotPair& slots = pairs_[number].slots;
      if ((has_changed_[slots.a] | has_changed_[slots.b]) != 0) consider(number);
    });
    for (const std::uint32_t slot : changed_)
      has_changed_[slot] = 0;
  }

  void consider(PairTable::Number number) {
    TrackedPair& pair = pairs_[number];
    const auto frame = static_cast<std::uint32_t>(result_.frame);
    if (!pair.is_of_interest || pair.frame == frame) return;
    pair.frame = frame;
    ++result_.report.neighbor_finding.out;
    if (placed_.gap(pair.slots.a, pair.slots.b, pair.separation) > certain_distance(distance_)) {
      part(number);  // it may have met at a greater distance
    } else {
      candidates_.push_back(number);
    }
  }

  // Stage 2: those that planes separate, and for how long. Whoever met in the last frame mostly still does.
  void test_hulls() {
    StageReport& report = result_.report.separating_planes;
    report.in = std::ssize(candidates_);
    is_near_.resize(candidates_.size());
    const double expected_ns = kHullTest_ns * static_cast<double>(candidates_.size());
    crew_.for_each(candidates_.size(), chunk_of(candidates_.size(), expected_ns), expected_ns,
                   [&](std::size_t begin, std::size_t end, int) {
                     for (std::size_t i = begin; i < end; ++i)
                       is_near_[i] = may_be_near(candidates_[i]);
                   });
    near_.clear();
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      if (is_near_[i] != 0) near_.push_back(candidates_[i]);
    }
    report.out = std::ssize(near_);
  }

  bool may_be_near(PairTable::Number number) {
    TrackedPair& pair = pairs_[number];
    return pair.meets || !checks_.are_separated(pair, pairs_.memory(number), distance_);
  }

  // Stage 3: the others. What takes long comes first, so that the threads end together.
  void test_exactly() {
    StageReport& report = result_.report.exact;
    report.in = std::ssize(near_);
    double expected_ns = 0.0;
    for (const PairTable::Number number : near_)
      expected_ns += static_cast<double>(pairs_[number].expected_ns);
    const auto end_of_long = std::partition(
        near_.begin(), near_.end(), [&](PairTable::Number number) { return pairs_[number].expected_ns > kLong_ns; });
    std::sort(near_.begin(), end_of_long,
              [&](PairTable::Number m, PairTable::Number n) { return pairs_[m].expected_ns > pairs_[n].expected_ns; });
    met_before_.resize(near_.size());
    was_shared_ = crew_.is_worth_sharing(expected_ns);
    crew_.for_each(near_.size(), chunk_of(near_.size(), expected_ns), expected_ns,
                   [&](std::size_t begin, std::size_t end, int worker) {
                     for (std::size_t i = begin; i < end; ++i) {
                       prefetch(i, end);
                       find_out(i, worker);
                     }
                   });
    for (std::size_t i = 0; i < near_.size(); ++i) {
      const TrackedPair& pair = pairs_[near_[i]];
      report.out += pair.meets ? 1 : 0;
      if (pair.meets != (met_before_[i] != 0)) (pair.meets ? met_ : parted_).push_back({pair.slots, near_[i]});
    }
  }

  void find_out(std::size_t i, int worker) {
    TrackedPair& pair = pairs_[near_[i]];
    met_before_[i] = pair.meets;
    checks_.find_out(pair, pairs_.memory(near_[i]), distance_, worker);
  }

  // Of those that come after this one, before `end`: others may be in other hands.
  void prefetch(std::size_t i, std::size_t end) {
    for (std::size_t step = 0; step < kPrefetchAhead.size(); ++step) {
      const std::size_t next = i + kPrefetchAhead[step];
      if (next < end) checks_.prefetch(pairs_[near_[next]], pairs_.memory(near_[next]), static_cast<int>(step));
    }
  }

  void part(PairTable::Number number) {
    TrackedPair& pair = pairs_[number];
    if (pair.meets) parted_.push_back({pair.slots, number});
    pair.meets = false;
  }

  // Those that meet, from the ones of the frame before.
  void update_result() {
    result_.report.result.in = std::ssize(met_) + std::ssize(parted_);
    const bool is_as_before = met_.empty() && parted_.empty();
    if (!is_as_before) {
      std::sort(met_.begin(), met_.end());
      std::sort(parted_.begin(), parted_.end());
      kept_.clear();
      std::set_difference(meeting_.begin(), meeting_.end(), parted_.begin(), parted_.end(), std::back_inserter(kept_));
      meeting_.clear();
      std::merge(kept_.begin(), kept_.end(), met_.begin(), met_.end(), std::back_inserter(meeting_));
      met_.clear();
      parted_.clear();
      result_.meeting.clear();
      for (const Meeting& pair : meeting_)
        result_.meeting.push_back({world_.objects()[pair.slots.a].id, world_.objects()[pair.slots.b].id});
    }
    if (options_.query != PairQuery::kVerdict && !(is_as_before && near_.empty())) copy_details();
    result_.report.result.out = std::ssize(meeting_);
  }

  void copy_details() {
    result_.ends.clear();
    result_.all_triangle_pairs.clear();
    result_.all_close_pairs.clear();
    for (const Meeting& pair : meeting_) {
      const MeetingDetails& details = *pairs_.memory(pair.number).details;
      result_.all_triangle_pairs.insert(result_.all_triangle_pairs.end(), details.triangle_pairs.begin(),
                                        details.triangle_pairs.end());
      result_.all_close_pairs.insert(result_.all_close_pairs.end(), details.close_pairs.begin(),
                                     details.close_pairs.end());
      result_.ends.push_back(result_.all_triangle_pairs.size() + result_.all_close_pairs.size());
    }
  }

  World& world_;
  const realtime::Clock& clock_;
  const PipelineOptions options_;
  WorkCrew crew_;
  PlacedObjects placed_;
  BroadPhase broad_phase_;
  PairTable pairs_;
  PairChecks checks_;

  double distance_ = 0.0;
  std::int64_t objects_ = 0;
  bool interest_changed_ = false;
  bool was_shared_ = false;  ///< work of the last frame, so probably that of this one
  std::chrono::nanoseconds lap_{0};
  std::vector<std::uint32_t> changed_;     ///< slots
  std::vector<std::uint8_t> has_changed_;  ///< by slot; all 0 between frames
  Numbers candidates_;                     ///< that may be near
  std::vector<std::uint8_t> is_near_;
  Numbers near_;
  std::vector<std::uint8_t> met_before_;
  std::vector<Meeting> met_;     ///< in this frame
  std::vector<Meeting> parted_;  ///< in this frame
  std::vector<Meeting> meeting_;
  std::vector<Meeting> kept_;
  FrameResult result_;
};

CollisionPipeline::CollisionPipeline(World& world, const realtime::Clock& clock, const PipelineOptions& options)
    : frame_(std::make_unique<Frame>(world, clock, options)) {}

CollisionPipeline::~CollisionPipeline() = default;

const FrameResult& CollisionPipeline::step(double distance) {
  return frame_->step(distance);
}

const FrameResult& CollisionPipeline::result() const {
  return frame_->result();
}

}  // namespace glissade::collision
