// See `run_parts` in benches.h.

#include <memory>

#include "benches.h"
#include "pose_source.h"
#include "query_case.h"
#include "sliding_walk.h"
#include "subject_lists.h"
#include "zachmann_poses.h"

namespace glissade::bench {
namespace {

using collision::DopTree;
using Eigen::Isometry3d;
using geometry::TriangleMesh;

constexpr SlidingStep kPartsStep{.length = 1e-4 * kSize, .angle = 1e-4};

// One question about parts.
struct PartsQuestion {
  const char* name;
  Operation operation;
  double gap;  // share of the size; 0: not at a gap
};
constexpr PartsQuestion kPartsQuestions[] = {
    {"yes-no", Operation::kIntersects, 0.0},        {"yes-no-0.1%", Operation::kIntersects, 0.001},
    {"yes-no-1%", Operation::kIntersects, 0.01},    {"all-pairs", Operation::kCountPairs, 0.0},
    {"distance-0.1%", Operation::kDistance, 0.001}, {"distance-1%", Operation::kDistance, 0.01},
    {"distance-10%", Operation::kDistance, 0.1}};
constexpr const char* kPartsName = "parts";
constexpr const char* kPartsCoherentName = "distance-coherent";

// Two trees and how many poses a case has.
class PartsPoses {
 public:
  PartsPoses(const PartPair& pair, const BenchOptions& options)
      : tree_A_(pair.mesh_A),
        tree_B_(pair.mesh_A == pair.mesh_B ? tree_A_ : DopTree(pair.mesh_B)),
        options_(options),
        source_(tree_A_, tree_B_, options.seed) {}

  std::vector<Isometry3d> of(const PartsQuestion& question) {
    if (question.gap == 0.0 && question.operation == Operation::kIntersects)
      return zachmann_poses(source_, options_.quick);
    const std::size_t wanted = options_.quick ? 20 : 100;
    std::vector<Isometry3d> poses;
    for (std::size_t tries = 0; poses.size() < wanted && tries < 10 * wanted; ++tries) {
      const Eigen::Matrix3d R_AB = source_.rotation();
      const Eigen::Vector3d axis = source_.direction();
      const auto distance = source_.approach(R_AB, axis, question.gap * kSize);
      if (!distance) continue;
      const double share = question.operation == Operation::kCountPairs ? source_.uniform(0.3, 1.0) : 1.0;
      const Isometry3d X_AB = pose(R_AB, share * *distance * axis);
      if (question.operation == Operation::kCountPairs && !intersects(tree_A_, tree_B_, X_AB, workspace_)) continue;
      poses.push_back(X_AB);
    }
    return poses;
  }

  PoseParts walk() const {
    return sliding_walk(tree_A_, tree_B_,
                        {{"gap-0.1%", 0.001 * kSize}, {"gap-1%", 0.01 * kSize}, {"gap-10%", 0.1 * kSize}},
                        options_.quick ? 30 : 200, kPartsStep, options_.seed);
  }

 private:
  DopTree tree_A_;
  DopTree tree_B_;
  const BenchOptions& options_;
  PoseSource source_;
  collision::QueryWorkspace workspace_;
};

}  // namespace

void run_parts(const BenchOptions& options, Results& results) {
  for (const PartPair& pair : part_pairs(options.suite)) {
    PartsPoses poses(pair, options);
    QueryCase query_case{.bench = kPartsName, .name = "", .mesh_A = *pair.mesh_A, .mesh_B = *pair.mesh_B, .poses = {}};
    for (const PartsQuestion& question : kPartsQuestions) {
      query_case.name = question.name + (" " + pair.name);
      query_case.operation = question.operation;
      query_case.poses = {poses.of(question)};
      run_query_case(query_case, {glissade_subject(), fcl_subject(), pqp_subject()}, pass_limits(options), results);
    }
    query_case.name = kPartsCoherentName + (" " + pair.name);
    query_case.operation = Operation::kDistance;
    query_case.poses = poses.walk();
    query_case.part_names = {"gap-0.1%", "gap-1%", "gap-10%"};
    run_query_case(query_case, {glissade_coherent(), fcl_subject(), pqp_subject()}, pass_limits(options), results);
  }
}

}  // namespace glissade::bench
