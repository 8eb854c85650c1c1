#include "pair_checks.h"

#include <algorithm>

#include "coherent_query.h"
#include "prefetch.h"
#include "query_frame.h"

namespace glissade::collision {
namespace {

// Of the smaller radius. Pairs further apart than that are not near any more, and their memory goes to others.
constexpr double kNear = 0.25;

// Where more pairs of triangles than this meet, looking at all of them is most of the work, and a front that remembers
// what was apart costs more than it saves.
constexpr std::size_t kManyPairs = 100;

// What the work of a query takes, roughly; only the order of pairs and the number of threads depend on it.
float expected_ns(const QueryCounters& counters, std::size_t found) {
  return 150.0F + 5.0F * static_cast<float>(counters.node_tests) + 2.0F * static_cast<float>(counters.triangle_tests) +
         20.0F * static_cast<float>(found);
}

template <typename Workspace>
void query(const PlacedPair& placed, double distance, Workspace&& workspace, std::vector<TrianglePair>& found) {
  intersecting_pairs(placed.tree_A, placed.tree_B, placed.X_AB, workspace, found, distance);
}
template <typename Workspace>
void query(const PlacedPair& placed, double distance, Workspace&& workspace, std::vector<ClosePair>& found) {
  pairs_within(placed.tree_A, placed.tree_B, placed.X_AB, distance, workspace, found, placed.selection);
}

}  // namespace

Eigen::Isometry3d relative_pose(const WorldObject& object_A, const WorldObject& object_B) {
  return object_A.X_WO.inverse(Eigen::Isometry) * object_B.X_WO;
}

bool PairChecks::are_separated(TrackedPair& pair, PairMemory& memory, double distance) const {
  const WorldObject& a = world_.objects()[pair.slots.a];
  const WorldObject& b = world_.objects()[pair.slots.b];
  if (!a.hull || !b.hull) return false;
  // Boxes are fat, so what enters is mostly not near yet.
  const double gap_of_spheres = memory.hulls.has_plane ? 0.0 : placed_.gap_of_spheres(pair.slots.a, pair.slots.b);
  if (gap_of_spheres > certain_distance(distance)) {
    const Eigen::Vector3d n_W = placed_.between(pair.slots.a, pair.slots.b);
    pair.separation = placed_.separation(pair.slots.a, pair.slots.b, n_W, gap_of_spheres);
    return true;
  }
  if (!hulls_apart(*a.hull, *b.hull, relative_pose(a, b), memory.hulls, options_.hull_test)) return false;
  if (!(memory.hulls.gap > distance)) return false;
  const Eigen::Vector3d n_W = a.X_WO.linear() * memory.hulls.n_gap_A;
  pair.separation = placed_.separation(pair.slots.a, pair.slots.b, n_W, memory.hulls.gap);
  if (memory.hulls.gap - distance > kNear * std::min(a.hull->radius(), b.hull->radius())) {
    memory.front.reset();
    memory.details.reset();
  }
  return true;
}

void PairChecks::prefetch(const TrackedPair& pair, const PairMemory& memory, int step) const {
  const WorldObject& a = world_.objects()[pair.slots.a];
  const WorldObject& b = world_.objects()[pair.slots.b];
  if (step == 0) {
    prefetch_lines(&a, sizeof(WorldObject));
    prefetch_lines(&b, sizeof(WorldObject));
    if (memory.front) prefetch_lines(memory.front.get(), sizeof(CoherentFront));
    return;
  }
  if (!memory.front || !memory.front->witness()) return;
  const bool base_is_A = QueryFrame::base_is_first(*a.tree, *b.tree);
  const DopTree& base = base_is_A ? *a.tree : *b.tree;
  const DopTree& other = base_is_A ? *b.tree : *a.tree;
  if (step == 1) memory.front->witness()->prefetch_leaves(base, other);
  if (step == 2) memory.front->witness()->prefetch_triangles(base, other);
  if (step == 3) memory.front->witness()->prefetch_corners(base, other);
}

void PairChecks::find_out(TrackedPair& pair, PairMemory& memory, double distance, int worker) {
  const WorldObject& a = world_.objects()[pair.slots.a];
  const WorldObject& b = world_.objects()[pair.slots.b];
  const PlacedPair placed{*a.tree, *b.tree, relative_pose(a, b), {a.selection.get(), b.selection.get()}};
  QueryWorkspace& scratch = scratch_[static_cast<std::size_t>(worker)];
  if (!memory.front) memory.front = std::make_unique<CoherentFront>();
  if (options_.query == PairQuery::kVerdict) {
    pair.meets =
        intersects(placed.tree_A, placed.tree_B, placed.X_AB, CoherentMemory{scratch, *memory.front}, distance);
    pair.expected_ns = expected_ns(scratch.counters(), 0);
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
void PairChecks::find_pairs(TrackedPair& pair, PairMemory& memory, const PlacedPair& placed, double distance,
                            QueryWorkspace& scratch, std::vector<Pair>& found) {
  QueryCounters counters;
  if (found.size() <= kManyPairs) {
    query(placed, distance, CoherentMemory{scratch, *memory.front}, found);
    counters = scratch.counters();
  } else if (crew_.threads() == 1) {
    query(placed, distance, scratch, found);
    counters = scratch.counters();
  } else {
    ParallelWorkspace& workspace = memory.details->workspace;
    crew_.run([&] { query(placed, distance, workspace, found); });
    counters = workspace.counters();
  }
  pair.expected_ns = expected_ns(counters, found.size());
  pair.meets = !found.empty();
}

}  // namespace glissade::collision
