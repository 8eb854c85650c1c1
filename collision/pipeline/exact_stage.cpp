#include "pipeline/exact_stage.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>

#include <glissade/collision/dop_query.h>
#include <glissade/collision/dop_tree.h>

#include "kernels/prefetch.h"
#include "kernels/query_frame.h"
#include "query/coherent_front.h"
#include "query/coherent_query.h"
#include "query/parallel_query.h"

namespace glissade::collision {

/// Two trees, and the pose of B in the frame of A.
struct PlacedPair {
  const DopTree& tree_A;
  const DopTree& tree_B;
  Eigen::Isometry3d X_AB;
  PairSelection selection;  ///< for PairQuery::kClosePairs only
};

namespace {

// By step of `prefetch`: the number of queries ahead. A query takes about as long as an access to memory.
constexpr std::array<std::size_t, 4> kPrefetchAhead{6, 4, 2, 1};

// Queries that take longer are begun first.
constexpr float kLong_ns = 20'000.0F;

// If more triangle pairs than this meet, testing them is most of the work, and a front that remembers the others costs
// more than it saves.
constexpr std::size_t kManyPairs = 100;

// Rough estimate of the time of a query by its work. Only the order of pairs and the number of threads depend on it.
float expected_time_ns(const QueryCounters& counters, std::size_t found) {
  return 150.0F + 5.0F * static_cast<float>(counters.node_tests) + 2.0F * static_cast<float>(counters.triangle_tests) +
         20.0F * static_cast<float>(found);
}

template <typename Workspace>
void run_query(const PlacedPair& placed, double distance, Workspace&& workspace, std::vector<TrianglePair>& found) {
  intersecting_pairs(placed.tree_A, placed.tree_B, placed.X_AB, workspace, found, distance);
}
template <typename Workspace>
void run_query(const PlacedPair& placed, double distance, Workspace&& workspace, std::vector<ClosePair>& found) {
  pairs_within(placed.tree_A, placed.tree_B, placed.X_AB, distance, workspace, found, placed.selection);
}

}  // namespace

void ExactStage::query(std::vector<PairTable::Number>& near, double distance, StageReport& report) {
  report.in = std::ssize(near);
  double expected_ns = 0.0;
  for (const PairTable::Number number : near)
    expected_ns += static_cast<double>(pairs_[number].expected_ns);
  put_long_queries_first(near);
  met_before_.resize(near.size());
  was_shared_ = pool_.is_worth_sharing(expected_ns);
  pool_.for_each(near.size(), ThreadPool::chunk_of(near.size(), expected_ns), expected_ns,
                 [&](std::size_t begin, std::size_t end, int worker) {
                   for (std::size_t i = begin; i < end; ++i) {
                     prefetch(near, i, end);
                     TrackedPair& pair = pairs_[near[i]];
                     met_before_[i] = pair.meets;
                     query(pair, pairs_.memory(near[i]), distance, worker);
                   }
                 });
  for (std::size_t i = 0; i < near.size(); ++i) {
    const TrackedPair& pair = pairs_[near[i]];
    report.out += pair.meets ? 1 : 0;
    if (pair.meets && met_before_[i] == 0) meetings_.begin(pair, near[i]);
    if (!pair.meets && met_before_[i] != 0) meetings_.end(pair, near[i]);
  }
}

void ExactStage::put_long_queries_first(std::vector<PairTable::Number>& near) const {
  const auto end_of_long = std::partition(
      near.begin(), near.end(), [&](PairTable::Number number) { return pairs_[number].expected_ns > kLong_ns; });
  std::sort(near.begin(), end_of_long,
            [&](PairTable::Number m, PairTable::Number n) { return pairs_[m].expected_ns > pairs_[n].expected_ns; });
}

// Prefetches for the queries after this one, up to `end`; other threads may have the pairs beyond.
void ExactStage::prefetch(const std::vector<PairTable::Number>& near, std::size_t i, std::size_t end) {
  for (std::size_t step = 0; step < kPrefetchAhead.size(); ++step) {
    const std::size_t next = i + kPrefetchAhead[step];
    if (next < end) prefetch(pairs_[near[next]], pairs_.memory(near[next]), static_cast<int>(step));
  }
}

// Prefetches the memory that the query of the pair reads: step 0 first, then 1, 2 and 3, each with queries of other
// pairs in between.
void ExactStage::prefetch(const TrackedPair& pair, const PairMemory& memory, int step) const {
  const WorldObject& a = world_.objects()[pair.slots.a];
  const WorldObject& b = world_.objects()[pair.slots.b];
  if (step == 0) {
    prefetch_lines(&a, sizeof(WorldObject));
    prefetch_lines(&b, sizeof(WorldObject));
    if (memory.front) prefetch_lines(memory.front.get(), sizeof(CoherentFront));
    return;
  }
  if (!memory.front || !memory.front->last_hit()) return;
  const bool base_is_A = QueryFrame::base_is_first(*a.tree, *b.tree);
  const DopTree& base = base_is_A ? *a.tree : *b.tree;
  const DopTree& other = base_is_A ? *b.tree : *a.tree;
  if (step == 1) memory.front->last_hit()->prefetch_leaves(base, other);
  if (step == 2) memory.front->last_hit()->prefetch_triangles(base, other);
  if (step == 3) memory.front->last_hit()->prefetch_corners(base, other);
}

// Determines whether the objects are at most `distance` apart, and everything else that the options require.
void ExactStage::query(TrackedPair& pair, PairMemory& memory, double distance, int worker) {
  const WorldObject& a = world_.objects()[pair.slots.a];
  const WorldObject& b = world_.objects()[pair.slots.b];
  const PlacedPair placed{*a.tree, *b.tree, relative_pose(a, b), {a.selection.get(), b.selection.get()}};
  QueryWorkspace& scratch = scratch_[static_cast<std::size_t>(worker)];
  if (!memory.front) memory.front = std::make_unique<CoherentFront>();
  if (options_.query == PairQuery::kVerdict) {
    pair.meets =
        intersects(placed.tree_A, placed.tree_B, placed.X_AB, CoherentMemory{scratch, *memory.front}, distance);
    pair.expected_ns = expected_time_ns(scratch.counters(), 0);
    return;
  }
  if (!memory.details) memory.details = std::make_unique<MeetingDetails>();
  if (options_.query == PairQuery::kTrianglePairs) {
    find_pairs(pair, memory, placed, distance, scratch, memory.details->triangle_pairs);
  } else {
    find_pairs(pair, memory, placed, distance, scratch, memory.details->close_pairs);
  }
}

template <typename Pair>
void ExactStage::find_pairs(TrackedPair& pair, PairMemory& memory, const PlacedPair& placed, double distance,
                            QueryWorkspace& scratch, std::vector<Pair>& found) {
  QueryCounters counters;
  if (found.size() <= kManyPairs) {
    run_query(placed, distance, CoherentMemory{scratch, *memory.front}, found);
    counters = scratch.counters();
  } else if (pool_.threads() == 1) {
    run_query(placed, distance, scratch, found);
    counters = scratch.counters();
  } else {
    ParallelWorkspace& workspace = memory.details->workspace;
    pool_.run([&] { run_query(placed, distance, workspace, found); });
    counters = workspace.counters();
  }
  pair.expected_ns = expected_time_ns(counters, found.size());
  pair.meets = !found.empty();
}

}  // namespace glissade::collision
