// Boolean queries and sets of pairs against CGAL's exact predicates on small meshes, in as many poses as one likes: for
// every instruction set, every k, with and without slab, and both realignments. See sweep_poses.h for the poses.

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <glissade/collision/dop_query.h>

#include "mesh_oracle.h"
#include "sweeps/sweep_poses.h"
#include "sweeps/sweep_report.h"
#include "sweeps/sweep_variants.h"

namespace glissade::collision {
namespace {

using namespace test_support;
using Eigen::Isometry3d;

constexpr int kPosesPerCase = 48;
constexpr int kCasesPerBatch = 60;
constexpr std::size_t kVariants = 20;

// Two meshes, their trees, and what CGAL says about some poses.
struct Case {
  std::int64_t index = 0;
  std::size_t family = 0;
  SweepPair pair;
  std::vector<DopTree> trees_A;  // one for each variant
  std::vector<DopTree> trees_B;
  std::vector<Isometry3d> poses;
  std::vector<std::vector<TrianglePair>> expected;
};

// Everything depends on the seed and the index alone, if the queries that bisect are right.
Case make_case(std::uint64_t seed, std::int64_t index) {
  RandomNumbers random(seed * 1'000'003 + static_cast<std::uint64_t>(index));
  Case result;
  result.index = index;
  result.family = static_cast<std::size_t>(index) % sweep_families().size();
  const SweepFamily family = sweep_families()[result.family];
  result.pair = random_pair(family.placement, random);
  result.trees_A = trees_of_all_options(result.pair.A, random);
  result.trees_B = trees_of_all_options(result.pair.B, random);
  QueryWorkspace workspace;
  const auto bisecting_variant = static_cast<std::size_t>(random.integer(0, kVariants - 1));
  const auto collides = [&](const Isometry3d& X_AB) {
    return intersects(result.trees_A[bisecting_variant], result.trees_B[bisecting_variant], X_AB, workspace);
  };
  result.poses = random_poses(family, result.pair, kPosesPerCase, collides, random);
  const MeshOracle oracle(result.pair.A.mesh, result.pair.B.mesh);
  for (const Isometry3d& X_AB : result.poses)
    result.expected.push_back(oracle.intersecting_pairs(X_AB));
  return result;
}

std::string pair_text(const char* what, const TrianglePair& pair) {
  return std::string(what) + " " + std::to_string(pair.triangle_A) + "-" + std::to_string(pair.triangle_B);
}

// The first pair that only one of the two has.
std::string first_difference(const std::vector<TrianglePair>& actual, const std::vector<TrianglePair>& expected) {
  std::size_t i = 0;
  while (i < actual.size() && i < expected.size() && actual[i] == expected[i])
    ++i;
  const bool missed = i == actual.size() || (i < expected.size() && expected[i] < actual[i]);
  return missed ? pair_text("misses", expected[i]) : pair_text("invents", actual[i]);
}

class Sweep {
 public:
  explicit Sweep(const SweepArguments& arguments)
      : arguments_(arguments), sets_(instruction_sets(arguments.only_instruction_set)), counts_(sets_) {}

  bool run() {
    const Stopwatch watch;
    run_batches(arguments_, kPosesPerCase, kCasesPerBatch,
                [this](std::int64_t first, int count) { run_batch(first, count); });
    counts_.print(watch.seconds());
    differences_.print();
    return differences_.count() == 0;
  }

 private:
  void run_batch(std::int64_t first, int count) {
    const std::vector<Case> cases = run_cases(
        sets_, first / kCasesPerBatch, first, count,
        [this](std::int64_t index) { return make_case(arguments_.seed, index); },
        [this](const Case& asked, std::size_t set) { check(asked, set); });
    for (const Case& done : cases) {
      for (const std::vector<TrianglePair>& pairs : done.expected)
        counts_.add_pose(done.family, pairs.size());
    }
  }

  // Each pose with one variant, another one for each instruction set.
  void check(const Case& asked, std::size_t set) {
    QueryWorkspace workspace;
    std::vector<TrianglePair> pairs;
    for (std::size_t p = 0; p < asked.poses.size(); ++p) {
      const std::size_t variant = (static_cast<std::size_t>(asked.index) + 3 * p + 7 * set) % kVariants;
      const DopTree& tree_A = asked.trees_A[variant];
      const DopTree& tree_B = asked.trees_B[variant];
      const std::vector<TrianglePair>& expected = asked.expected[p];
      if (intersects(tree_A, tree_B, asked.poses[p], workspace) == expected.empty())
        report(asked, set, variant, p, expected.empty() ? "collides but should not" : "does not collide but should");
      intersecting_pairs(tree_A, tree_B, asked.poses[p], workspace, pairs);
      if (pairs != expected) report(asked, set, variant, p, first_difference(pairs, expected));
      counts_.add_check(variant, set);
    }
  }

  void report(const Case& asked, std::size_t set, std::size_t variant, std::size_t pose, const std::string& what) {
    differences_.add(what + "\n  --seed " + std::to_string(arguments_.seed) + " --only-case " +
                     std::to_string(asked.index) + ", pose " + std::to_string(pose) + ", " +
                     std::string(name_of(sets_[set])) + ", " + variant_name(all_tree_options()[variant]) + ", " +
                     family_name(sweep_families()[asked.family]) + "\n  A: " + asked.pair.A.description +
                     "\n  B: " + asked.pair.B.description + "\n" + text(asked.poses[pose]));
  }

  SweepArguments arguments_;
  std::vector<InstructionSet> sets_;
  SweepCounts counts_;
  SweepDifferences differences_;
};

}  // namespace
}  // namespace glissade::collision

int main(int argc, char** argv) {
  using glissade::test_support::SweepArguments;
  return glissade::test_support::run_sweep(
      argc, argv, "Compares collision queries with CGAL's exact predicates", "poses", 1'000'000,
      [](const SweepArguments& arguments) { return glissade::collision::Sweep(arguments).run(); });
}
