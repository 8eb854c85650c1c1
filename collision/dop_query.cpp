#include <boost/sort/pdqsort/pdqsort.hpp>
#include <hwy/contrib/sort/vqsort.h>

#include <glissade/collision/dop_query.h>
#include <glissade/collision/triangle_distance.h>
#include <glissade/collision/triangle_intersection.h>

#include "coherent_front.h"
#include "dop_traversal.h"
#include "placed_trees.h"

namespace glissade::collision {

QueryWorkspace::QueryWorkspace() : memory_(std::make_unique<Memory>()) {}
QueryWorkspace::~QueryWorkspace() = default;
QueryWorkspace::QueryWorkspace(QueryWorkspace&&) noexcept = default;
QueryWorkspace& QueryWorkspace::operator=(QueryWorkspace&&) noexcept = default;

const QueryCounters& QueryWorkspace::counters() const {
  return memory_->counters;
}

CoherentWorkspace::CoherentWorkspace() : front_(std::make_unique<CoherentFront>()) {}
CoherentWorkspace::~CoherentWorkspace() = default;
CoherentWorkspace::CoherentWorkspace(CoherentWorkspace&&) noexcept = default;
CoherentWorkspace& CoherentWorkspace::operator=(CoherentWorkspace&&) noexcept = default;

void CoherentWorkspace::forget() {
  front_->clear();
}

namespace {

// Answers a visit by answer(pair, corners of A, corners of B in A) → PairOutcome; of a pair that intersects, by
// answer_found(pair).
template <typename Answer, typename AnswerFound>
class Visitor final : public TriangleVisitor {
 public:
  Visitor(const PlacedTrees& placed, const Answer& answer, const AnswerFound& answer_found)
      : placed_(placed), answer_(answer), answer_found_(answer_found) {}

  PairOutcome visit(std::uint32_t leaf_P, std::uint32_t leaf_Q, int pair) override {
    const TrianglePair triangles = placed_.triangles(leaf_P, leaf_Q, pair);
    return answer_(triangles, placed_.points_A(triangles), placed_.points_B(triangles));
  }
  PairOutcome found(std::uint32_t leaf_P, std::uint32_t leaf_Q, int pair) override {
    return answer_found_(placed_.triangles(leaf_P, leaf_Q, pair));
  }
  double distance(std::uint32_t leaf_P, std::uint32_t leaf_Q, int pair) override {
    const TrianglePair triangles = placed_.triangles(leaf_P, leaf_Q, pair);
    return triangle_distance(placed_.points_A(triangles), placed_.points_B(triangles)).distance;
  }

 private:
  const PlacedTrees& placed_;
  const Answer& answer_;
  const AnswerFound& answer_found_;
};

bool visit_all(Goal goal, const PlacedTrees& placed, double distance, QueryWorkspace& workspace,
               TriangleVisitor& visitor) {
  QueryWorkspace::Memory& memory = workspace.memory();
  memory.counters = {};
  if (placed.frame.spheres_apart(distance)) return false;
  DopVisit step(placed.base(), placed.other(), placed.frame, distance, memory.alignment);
  return traverse(goal, step, memory, visitor);
}

bool visit_all(Goal goal, const PlacedTrees& placed, double distance, CoherentWorkspace& workspace,
               TriangleVisitor& visitor) {
  QueryWorkspace::Memory& memory = workspace.workspace().memory();
  memory.counters = {};
  return workspace.front().query(goal, placed.base(), placed.other(), placed.frame, distance, memory.alignment,
                                 memory.counters, visitor);
}

// Whether two triangles are within the tolerance, and their distance if that had to be found out.
struct Nearness {
  bool near;
  double distance;
};

Nearness nearness(const TrianglePoints& a, const TrianglePoints& b, double tolerance) {
  if (tolerance == 0.0) {
    const bool meet = triangles_intersect(a, b);
    return {meet, meet ? 0.0 : -1.0};
  }
  const double distance = triangle_distance(a, b).distance;
  return {distance <= tolerance, distance};
}

// Orders pairs as their own comparison does, in one step.
std::uint64_t place_of(const TrianglePair& pair) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(pair.triangle_A)) << 32 |
         static_cast<std::uint32_t>(pair.triangle_B);
}
TrianglePair pair_at(std::uint64_t place) {
  return {static_cast<std::int32_t>(place >> 32), static_cast<std::int32_t>(place)};
}

// Numbers can be sorted by vectors, in a third of the time. Highway asks the system for random numbers to do so: this
// allocates nothing, but it is a system call.
void sort_pairs(std::vector<TrianglePair>& pairs, QueryWorkspace::Memory& memory) {
  constexpr std::size_t kWorthVectors = 64;
  if (pairs.size() < kWorthVectors) {
    std::sort(pairs.begin(), pairs.end());
    return;
  }
  memory.places.resize(pairs.size());
  std::transform(pairs.begin(), pairs.end(), memory.places.begin(), place_of);
  memory.sort_places(memory.places.data(), memory.places.size(), hwy::SortAscending());
  std::transform(memory.places.begin(), memory.places.end(), pairs.begin(), pair_at);
}

// In place and about twice as fast as std::sort here: comparing two numbers needs no branch.
void sort_pairs(std::vector<ClosePair>& pairs) {
  boost::sort::pdqsort_branchless(pairs.begin(), pairs.end(), [](const ClosePair& u, const ClosePair& v) {
    return place_of(u.triangles) < place_of(v.triangles);
  });
}

QueryWorkspace::Memory& memory_of(QueryWorkspace& workspace) {
  return workspace.memory();
}
QueryWorkspace::Memory& memory_of(CoherentWorkspace& workspace) {
  return workspace.workspace().memory();
}

template <typename Workspace>
bool find_any(const PlacedTrees& placed, double tolerance, Workspace& workspace) {
  const auto answer = [&](const TrianglePair&, const TrianglePoints& a, const TrianglePoints& b) {
    const Nearness found = nearness(a, b, tolerance);
    return PairOutcome{found.near, found.distance};
  };
  const auto answer_found = [](const TrianglePair&) { return PairOutcome{true, 0.0}; };
  Visitor visitor(placed, answer, answer_found);
  return visit_all(Goal::kAnyPair, placed, tolerance, workspace, visitor);
}

template <typename Workspace>
void find_pairs(const PlacedTrees& placed, double tolerance, Workspace& workspace, std::vector<TrianglePair>& pairs) {
  pairs.clear();
  const auto answer = [&](const TrianglePair& pair, const TrianglePoints& a, const TrianglePoints& b) {
    const Nearness found = nearness(a, b, tolerance);
    if (found.near) pairs.push_back(pair);
    return PairOutcome{false, found.distance};
  };
  const auto answer_found = [&](const TrianglePair& pair) {
    pairs.push_back(pair);
    return PairOutcome{false, 0.0};
  };
  Visitor visitor(placed, answer, answer_found);
  visit_all(Goal::kEveryPair, placed, tolerance, workspace, visitor);
  sort_pairs(pairs, memory_of(workspace));
}

template <typename Workspace>
void find_close(const PlacedTrees& placed, double distance, Workspace& workspace, std::vector<ClosePair>& pairs) {
  pairs.clear();
  const auto answer = [&](const TrianglePair& pair, const TrianglePoints& a, const TrianglePoints& b) {
    const TriangleDistance closest = triangle_distance(a, b);
    if (closest.distance <= distance) pairs.push_back({pair, closest.distance, closest.p_a, closest.p_b});
    return PairOutcome{false, closest.distance};
  };
  const auto answer_found = [&](const TrianglePair& pair) {
    return answer(pair, placed.points_A(pair), placed.points_B(pair));
  };
  Visitor visitor(placed, answer, answer_found);
  visit_all(Goal::kEveryPair, placed, distance, workspace, visitor);
  sort_pairs(pairs);
}

}  // namespace

bool intersects(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, QueryWorkspace& workspace,
                double tolerance) {
  return find_any({tree_A, tree_B, X_AB}, tolerance, workspace);
}

bool intersects(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                CoherentWorkspace& workspace, double tolerance) {
  return find_any({tree_A, tree_B, X_AB}, tolerance, workspace);
}

void intersecting_pairs(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                        QueryWorkspace& workspace, std::vector<TrianglePair>& pairs, double tolerance) {
  find_pairs({tree_A, tree_B, X_AB}, tolerance, workspace, pairs);
}

void intersecting_pairs(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                        CoherentWorkspace& workspace, std::vector<TrianglePair>& pairs, double tolerance) {
  find_pairs({tree_A, tree_B, X_AB}, tolerance, workspace, pairs);
}

void pairs_within(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, double distance,
                  QueryWorkspace& workspace, std::vector<ClosePair>& pairs) {
  find_close({tree_A, tree_B, X_AB}, distance, workspace, pairs);
}

void pairs_within(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, double distance,
                  CoherentWorkspace& workspace, std::vector<ClosePair>& pairs) {
  find_close({tree_A, tree_B, X_AB}, distance, workspace, pairs);
}

}  // namespace glissade::collision
