#include <glissade/collision/dop_query.h>

#include "query/coherent_front.h"
#include "query/coherent_query.h"
#include "query/dop_traversal.h"
#include "query/mesh_distance.h"
#include "query/pair_visitors.h"
#include "query/placed_trees.h"
#include "query/sort_pairs.h"
#include "query/workspace_access.h"

namespace glissade::collision {

namespace {

// Whether the visitor stopped.
bool visit_all(Goal goal, const PlacedTrees& placed, double distance, QueryWorkspace& workspace,
               TriangleVisitor& visitor) {
  QueryMemory& memory = memory_of(workspace);
  memory.counters = {};
  const VisitSelection selection = placed.visit_selection();
  if (placed.frame.spheres_apart(distance)) return false;
  DopVisit step(placed.base(), placed.other(), placed.frame, distance, memory.alignment, selection, memory.meter);
  if (goal == Goal::kEveryPair) {
    visit_every(step, memory, visitor);
    return false;
  }
  const Answer answer = find_any(step, memory, visitor);
  return answer == Answer::kOpen ? any_pair_within(placed, distance, memory) : answer == Answer::kYes;
}

bool visit_all(Goal goal, const PlacedTrees& placed, double distance, const CoherentMemory& workspace,
               TriangleVisitor& visitor) {
  QueryMemory& memory = memory_of(workspace.scratch);
  memory.counters = {};
  return workspace.front.query(goal, placed.base(), placed.other(), placed.frame, distance, memory.alignment,
                               memory.counters, visitor, placed.visit_selection(), memory.meter);
}

QueryMemory& memory_of(const CoherentMemory& workspace) {
  return memory_of(workspace.scratch);
}
CoherentMemory memory_apart(CoherentWorkspace& workspace) {
  return {WorkspaceAccess::scratch(workspace), WorkspaceAccess::front(workspace)};
}

template <typename Workspace>
bool find_any(const PlacedTrees& placed, double tolerance, Workspace&& workspace) {
  AnyPair visitor(placed, tolerance);
  return visit_all(Goal::kAnyPair, placed, tolerance, workspace, visitor);
}

template <typename Pair, typename Workspace>
void find_pairs(const PlacedTrees& placed, double tolerance, Workspace&& workspace, std::vector<Pair>& pairs) {
  pairs.clear();
  PairCollector<Pair> visitor(placed, tolerance, pairs);
  visit_all(Goal::kEveryPair, placed, tolerance, workspace, visitor);
  visitor.finish();
  sort_pairs(pairs, memory_of(workspace));
}

}  // namespace

bool intersects(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, QueryWorkspace& workspace,
                double tolerance) {
  return find_any({tree_A, tree_B, X_AB}, tolerance, workspace);
}

bool intersects(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                CoherentWorkspace& workspace, double tolerance) {
  return find_any({tree_A, tree_B, X_AB}, tolerance, memory_apart(workspace));
}

bool intersects(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                const CoherentMemory& memory, double tolerance) {
  return find_any({tree_A, tree_B, X_AB}, tolerance, memory);
}

void intersecting_pairs(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                        QueryWorkspace& workspace, std::vector<TrianglePair>& pairs, double tolerance) {
  find_pairs({tree_A, tree_B, X_AB}, tolerance, workspace, pairs);
}

void intersecting_pairs(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                        CoherentWorkspace& workspace, std::vector<TrianglePair>& pairs, double tolerance) {
  find_pairs({tree_A, tree_B, X_AB}, tolerance, memory_apart(workspace), pairs);
}

void intersecting_pairs(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                        const CoherentMemory& memory, std::vector<TrianglePair>& pairs, double tolerance) {
  find_pairs({tree_A, tree_B, X_AB}, tolerance, memory, pairs);
}

void pairs_within(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, double distance,
                  QueryWorkspace& workspace, std::vector<ClosePair>& pairs, const PairSelection& selection) {
  find_pairs({tree_A, tree_B, X_AB, selection}, distance, workspace, pairs);
}

void pairs_within(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, double distance,
                  CoherentWorkspace& workspace, std::vector<ClosePair>& pairs, const PairSelection& selection) {
  find_pairs({tree_A, tree_B, X_AB, selection}, distance, memory_apart(workspace), pairs);
}

void pairs_within(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, double distance,
                  const CoherentMemory& memory, std::vector<ClosePair>& pairs, const PairSelection& selection) {
  find_pairs({tree_A, tree_B, X_AB, selection}, distance, memory, pairs);
}

MeshDistance distance(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                      QueryWorkspace& workspace, double limit) {
  return least_distance({tree_A, tree_B, X_AB}, limit, memory_of(workspace), nullptr);
}

MeshDistance distance(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                      CoherentWorkspace& workspace, double limit) {
  const CoherentMemory memory = memory_apart(workspace);
  return least_distance({tree_A, tree_B, X_AB}, limit, memory_of(memory.scratch), &memory.front.of_distance());
}

}  // namespace glissade::collision
