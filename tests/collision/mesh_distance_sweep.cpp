// The distance of two meshes against all pairs of triangles in quadruple precision, on small meshes, touching, near and
// up to a million sizes apart; for every instruction set and every kind of tree the same bits, from scratch and
// coherent.

#include <algorithm>
#include <bit>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <glissade/collision/dop_query.h>

#include "near_pairs.h"
#include "sweeps/sweep_poses.h"
#include "sweeps/sweep_report.h"
#include "sweeps/sweep_variants.h"

namespace glissade::collision {
namespace {

using namespace test_support;
using Eigen::Isometry3d;

constexpr int kDistancePosesPerCase = 24;
constexpr int kDistanceCasesPerBatch = 60;
constexpr std::size_t kDistanceVariants = 20;

struct DistanceQuestion {
  Isometry3d X_AB;
  MeshDistance first;  // of the first kind of tree
  std::string fault;   // of this answer
};

struct DistanceCase {
  std::int64_t index = 0;
  std::size_t family = 0;
  SweepPair pair;
  std::vector<DopTree> trees_A;  // one for each variant
  std::vector<DopTree> trees_B;
  std::vector<DistanceQuestion> questions;
};

// What is wrong with an answer, by every pair of triangles.
std::string fault_of_distance(const MeshDistance& found, const NearPairs& near_pairs, const Isometry3d& X_AB,
                              DistanceErrors& errors) {
  const std::vector<NearPair> candidates = near_pairs.within(X_AB, found.distance);
  const NearPair* same = nullptr;
  for (const NearPair& candidate : candidates) {
    if (candidate.distance < found.distance - candidate.doubt) return "misses " + candidate.text();
    if (candidate.distance == 0.0 && found.distance > 0.0) return "misses the intersection of " + candidate.text();
    if (found.nearest && candidate.triangles == found.nearest->triangles) same = &candidate;
    if (!found.nearest && candidate.distance == 0.0) return "";
  }
  if (!found.nearest) return "says that the meshes intersect";
  if (same == nullptr) return "names triangles that are farther apart";
  if (found.nearest->distance != found.distance) return "gives the nearest pair another distance";
  return near_pairs.fault_of(*found.nearest, *same, X_AB, errors);
}

bool same_bits(const MeshDistance& u, const MeshDistance& v) {
  const auto same = [](double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
  };
  if (!same(u.distance, v.distance) || u.nearest.has_value() != v.nearest.has_value()) return false;
  if (!u.nearest) return true;
  for (Eigen::Index i = 0; i < 3; ++i) {
    if (!same(u.nearest->p_A[i], v.nearest->p_A[i]) || !same(u.nearest->p_B[i], v.nearest->p_B[i])) return false;
  }
  return u.nearest->triangles == v.nearest->triangles && same(u.nearest->distance, v.nearest->distance);
}

class DistanceSweep {
 public:
  explicit DistanceSweep(const SweepArguments& arguments)
      : arguments_(arguments), sets_(instruction_sets(arguments.only_instruction_set)), counts_(sets_) {}

  bool run() {
    const Stopwatch watch;
    run_batches(arguments_, kDistancePosesPerCase, kDistanceCasesPerBatch,
                [this](std::int64_t first, int count) { run_batch(first, count); });
    counts_.print(watch.seconds());
    errors_.print();
    differences_.print();
    return differences_.count() == 0;
  }

 private:
  DistanceCase make_case(std::int64_t index) {
    RandomNumbers random(arguments_.seed * 1'000'003 + static_cast<std::uint64_t>(index));
    DistanceCase result;
    result.index = index;
    result.family = static_cast<std::size_t>(index) % sweep_families().size();
    const SweepFamily family = sweep_families()[result.family];
    result.pair = random_pair(family.placement, random);
    result.trees_A = trees_of_all_options(result.pair.A, random);
    result.trees_B = trees_of_all_options(result.pair.B, random);
    QueryWorkspace workspace;
    const auto collides = [&](const Isometry3d& X_AB) {
      return intersects(result.trees_A.front(), result.trees_B.front(), X_AB, workspace);
    };
    const NearPairs near_pairs(result.pair.A.mesh, result.pair.B.mesh);
    for (Isometry3d X_AB : random_poses(family, result.pair, kDistancePosesPerCase, collides, random)) {
      // Very far apart, all pairs are about equally near, which takes time to check.
      const double farthest = random.chance(0.02) ? 6.0 : 1.0;
      if (random.chance(0.5))
        X_AB.translation() += random.power_of_ten(-3.0, farthest) * result.pair.scale() * random.direction();
      DistanceQuestion question{X_AB, distance(result.trees_A.front(), result.trees_B.front(), X_AB, workspace), ""};
      question.fault = fault_of_distance(question.first, near_pairs, X_AB, errors_);
      result.questions.push_back(question);
    }
    return result;
  }

  void run_batch(std::int64_t first, int count) {
    const std::vector<DistanceCase> cases = run_cases(
        sets_, first / kDistanceCasesPerBatch, first, count, [this](std::int64_t index) { return make_case(index); },
        [this](const DistanceCase& asked, std::size_t set) { check(asked, set); });
    for (const DistanceCase& done : cases) {
      for (const DistanceQuestion& question : done.questions)
        counts_.add_pose(done.family, question.first.distance == 0.0 ? 1 : 0);
    }
  }

  void check(const DistanceCase& asked, std::size_t set) {
    std::vector<CoherentWorkspace> remembering(kDistanceVariants);
    for (std::size_t q = 0; q < asked.questions.size(); ++q) {
      const DistanceQuestion& question = asked.questions[q];
      const std::size_t variant = (static_cast<std::size_t>(asked.index) + 3 * (q / 4) + 7 * set) % kDistanceVariants;
      const std::string fault =
          fault_of(asked.trees_A[variant], asked.trees_B[variant], question, remembering[variant]);
      if (!fault.empty()) report(asked, set, variant, q, fault);
      counts_.add_check(variant, set);
    }
  }

  static std::string fault_of(const DopTree& tree_A, const DopTree& tree_B, const DistanceQuestion& question,
                              CoherentWorkspace& remembering) {
    if (!question.fault.empty()) return question.fault;
    QueryWorkspace workspace;
    const auto& [X_AB, first, fault] = question;
    if (!same_bits(distance(tree_A, tree_B, X_AB, workspace), first)) return "differs from the first tree's answer";
    if (!same_bits(distance(tree_A, tree_B, X_AB, remembering), first)) return "differs when it remembers";
    if (first.distance == 0.0) return "";
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const MeshDistance beyond = distance(tree_A, tree_B, X_AB, workspace, std::nextafter(first.distance, kInfinity));
    if (!same_bits(beyond, first)) return "differs with a limit just beyond";
    for (const double limit : {first.distance, 0.5 * first.distance}) {
      const MeshDistance limited = distance(tree_A, tree_B, X_AB, remembering, limit);
      if (limited.distance != limit || limited.nearest) return "finds something nearer than the limit";
    }
    if (intersects(tree_A, tree_B, X_AB, workspace, std::nextafter(first.distance, 0.0)) ||
        !intersects(tree_A, tree_B, X_AB, workspace, first.distance))
      return "disagrees with the query within this distance";
    return "";
  }

  void report(const DistanceCase& asked, std::size_t set, std::size_t variant, std::size_t pose,
              const std::string& what) {
    const DistanceQuestion& question = asked.questions[pose];
    differences_.add(what + "\n  --seed " + std::to_string(arguments_.seed) + " --only-case " +
                     std::to_string(asked.index) + ", pose " + std::to_string(pose) + ", distance " +
                     text(question.first.distance) + ", " + std::string(name_of(sets_[set])) + ", " +
                     variant_name(all_tree_options()[variant]) + ", " + family_name(sweep_families()[asked.family]) +
                     "\n  A: " + asked.pair.A.description + "\n  B: " + asked.pair.B.description + "\n" +
                     text(question.X_AB));
  }

  SweepArguments arguments_;
  std::vector<InstructionSet> sets_;
  SweepCounts counts_;
  DistanceErrors errors_;
  SweepDifferences differences_;
};

}  // namespace
}  // namespace glissade::collision

int main(int argc, char** argv) {
  using glissade::test_support::SweepArguments;
  return glissade::test_support::run_sweep(
      argc, argv, "Compares the distance of meshes with quadruple precision", "poses", 200'000,
      [](const SweepArguments& arguments) { return glissade::collision::DistanceSweep(arguments).run(); });
}
