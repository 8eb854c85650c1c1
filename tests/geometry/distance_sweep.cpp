// Pairs within a distance, and queries with a tolerance, against distances in quadruple precision on small meshes, for
// every instruction set and every kind of tree. Limits lie also within rounding errors of the distance of some pair.

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <glissade/collision/dop_query.h>

#include "near_pairs.h"
#include "sweeps/sweep_poses.h"
#include "sweeps/sweep_report.h"
#include "sweeps/sweep_variants.h"

namespace glissade::geometry {
namespace {

using namespace test_support;
using Eigen::Isometry3d;

constexpr int kPosesPerCase = 24;
constexpr int kCasesPerBatch = 60;
constexpr std::size_t kVariants = 20;

// A pose, the distance asked for, and every pair that can be within it.
struct Question {
  Isometry3d X_AB;
  double limit = 0.0;
  std::vector<NearPair> expected;
};

struct Case {
  std::int64_t index = 0;
  std::size_t family = 0;
  SweepPair pair;
  std::vector<collision::DopTree> trees_A;  // one for each variant
  std::vector<collision::DopTree> trees_B;
  std::vector<Question> questions;
};

Question make_question(const NearPairs& near_pairs, const Isometry3d& X_AB, double scale, RandomNumbers& random) {
  Question question{X_AB, random.chance(0.1) ? 0.0 : random.power_of_ten(-9.0, -1.0) * scale, {}};
  question.expected = near_pairs.within(X_AB, question.limit);
  if (!question.expected.empty() && random.chance(0.5)) {
    // As far as the closest or any pair, but for a rounding error or so.
    const auto& any =
        question.expected[static_cast<std::size_t>(random.integer(0, static_cast<int>(question.expected.size()) - 1))];
    const auto& closest =
        *std::min_element(question.expected.begin(), question.expected.end(),
                          [](const NearPair& u, const NearPair& v) { return u.distance < v.distance; });
    const double distance = random.chance(0.5) ? any.distance : closest.distance;
    const double factor = 1.0 + random.uniform(-1.0, 1.0) * random.power_of_ten(-17.0, -10.0);
    question.limit = std::min(question.limit, distance * factor);
  }
  return question;
}

Case make_case(std::uint64_t seed, std::int64_t index) {
  RandomNumbers random(seed * 1'000'003 + static_cast<std::uint64_t>(index));
  Case result;
  result.index = index;
  result.family = static_cast<std::size_t>(index) % sweep_families().size();
  const SweepFamily family = sweep_families()[result.family];
  result.pair = random_pair(family.placement, random);
  result.trees_A = trees_of_all_options(result.pair.A, random);
  result.trees_B = trees_of_all_options(result.pair.B, random);
  collision::QueryWorkspace workspace;
  const auto collides = [&](const Isometry3d& X_AB) {
    return intersects(result.trees_A.front(), result.trees_B.front(), X_AB, workspace);
  };
  const NearPairs near_pairs(result.pair.A.mesh, result.pair.B.mesh);
  for (const Isometry3d& X_AB : random_poses(family, result.pair, kPosesPerCase, collides, random))
    result.questions.push_back(make_question(near_pairs, X_AB, result.pair.scale(), random));
  return result;
}

// What is wrong with the set of `triangles_of` the elements.
template <typename Pair, typename TrianglesOf>
std::string fault_of_set(const std::vector<Pair>& actual, const Question& question, const TrianglesOf& triangles_of) {
  auto next = actual.begin();
  for (const NearPair& near_pair : question.expected) {
    const bool found = next != actual.end() && triangles_of(*next) == near_pair.triangles;
    if (found) ++next;
    const double distance = near_pair.distance;
    const bool required = distance == 0.0 || distance <= question.limit - near_pair.doubt;
    const bool forbidden = distance > 0.0 && (question.limit == 0.0 || distance > question.limit + near_pair.doubt);
    if (required && !found) return "misses " + near_pair.text();
    if (forbidden && found) return "invents " + near_pair.text();
  }
  return next == actual.end() ? "" : "invents a pair, or is not in ascending order";
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
    errors_.print();
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
      for (const Question& question : done.questions)
        counts_.add_pose(done.family, question.expected.size());
    }
  }

  void check(const Case& asked, std::size_t set) {
    const NearPairs near_pairs(asked.pair.A.mesh, asked.pair.B.mesh);
    for (std::size_t q = 0; q < asked.questions.size(); ++q) {
      const std::size_t variant = (static_cast<std::size_t>(asked.index) + 3 * q + 7 * set) % kVariants;
      const std::string fault =
          fault_of(asked.trees_A[variant], asked.trees_B[variant], asked.questions[q], near_pairs);
      if (!fault.empty()) report(asked, set, variant, q, fault);
      counts_.add_check(variant, set);
    }
  }

  std::string fault_of(const collision::DopTree& tree_A, const collision::DopTree& tree_B, const Question& question,
                       const NearPairs& near_pairs) {
    collision::QueryWorkspace workspace;
    std::vector<collision::ClosePair> close_pairs;
    collision::pairs_within(tree_A, tree_B, question.X_AB, question.limit, workspace, close_pairs);
    std::string fault =
        fault_of_set(close_pairs, question, [](const collision::ClosePair& pair) { return pair.triangles; });
    if (!fault.empty()) return "pairs_within " + fault;
    auto expected = question.expected.begin();
    for (const collision::ClosePair& pair : close_pairs) {
      while (expected->triangles != pair.triangles)
        ++expected;
      fault = near_pairs.fault_of(pair, *expected, question.X_AB, errors_);
      if (!fault.empty()) return fault;
    }
    std::vector<collision::TrianglePair> pairs;
    collision::intersecting_pairs(tree_A, tree_B, question.X_AB, workspace, pairs, question.limit);
    fault = fault_of_set(pairs, question, [](const collision::TrianglePair& pair) { return pair; });
    if (!fault.empty()) return "intersecting_pairs with tolerance " + fault;
    if (intersects(tree_A, tree_B, question.X_AB, workspace, question.limit) != !pairs.empty())
      return "intersects and intersecting_pairs disagree with a tolerance";
    return "";
  }

  void report(const Case& asked, std::size_t set, std::size_t variant, std::size_t pose, const std::string& what) {
    const Question& question = asked.questions[pose];
    differences_.add(
        what + "\n  --seed " + std::to_string(arguments_.seed) + " --only-case " + std::to_string(asked.index) +
        ", pose " + std::to_string(pose) + ", limit " + text(question.limit) + ", " + std::string(name_of(sets_[set])) +
        ", " + variant_name(all_tree_options()[variant]) + ", " + family_name(sweep_families()[asked.family]) +
        "\n  A: " + asked.pair.A.description + "\n  B: " + asked.pair.B.description + "\n" + text(question.X_AB));
  }

  SweepArguments arguments_;
  std::vector<collision::InstructionSet> sets_;
  SweepCounts counts_;
  DistanceErrors errors_;
  SweepDifferences differences_;
};

}  // namespace
}  // namespace glissade::geometry

int main(int argc, char** argv) {
  using glissade::test_support::SweepArguments;
  return glissade::test_support::run_sweep(
      argc, argv, "Compares distances and tolerances with quadruple precision", "poses", 200'000,
      [](const SweepArguments& arguments) { return glissade::geometry::Sweep(arguments).run(); });
}
