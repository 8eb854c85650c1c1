// Queries that remember against queries that do not, bit for bit, on random walks that hover about contact: steps of
// all sizes, standing still, going back, teleports, other tolerances, other trees, selections and queries in between.

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <oneapi/tbb/parallel_for.h>

#include <glissade/collision/dop_query.h>

#include "sweeps/sweep_poses.h"
#include "sweeps/sweep_report.h"
#include "sweeps/sweep_variants.h"

namespace glissade::collision {
namespace {

using namespace test_support;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr int kFramesPerWalk = 1000;
constexpr int kWalksPerBatch = 16;
constexpr std::array<const char*, 4> kQueries{"intersects", "intersecting_pairs", "pairs_within", "distance"};

bool same_bits(double u, double v) {
  return std::bit_cast<std::uint64_t>(u) == std::bit_cast<std::uint64_t>(v);
}

bool same_bits(const Vector3d& u, const Vector3d& v) {
  return same_bits(u.x(), v.x()) && same_bits(u.y(), v.y()) && same_bits(u.z(), v.z());
}

bool same_bits(const ClosePair& u, const ClosePair& v) {
  return u.triangles == v.triangles && same_bits(u.distance, v.distance) && same_bits(u.p_A, v.p_A) &&
         same_bits(u.p_B, v.p_B);
}

struct Counts {
  std::array<std::atomic<std::int64_t>, kQueries.size()> frames{};  // by query
  std::array<std::atomic<std::int64_t>, kQueries.size()> hits{};    // with an answer other than "no", "none" or a gap
  std::atomic<std::int64_t> changes = 0;  // from free to colliding or back since the frame before
  std::atomic<std::int64_t> teleports = 0;
};

// Small and nasty, or smooth and up to 5,000 triangles.
SweepPair walk_pair(const SweepFamily& family, bool large, RandomNumbers& random) {
  if (!large) return random_pair(family.placement, random);
  const auto surface = [&] {
    geometry::TriangleMesh mesh = random_surface(random.integer(500, 5000), random);
    const std::string description = "surface, " + std::to_string(mesh.triangles.size()) + " triangles";
    return SweepMesh{std::move(mesh), 1.0, Vector3d::Zero(), description};
  };
  SweepMesh A = surface();
  return {std::move(A), surface(), 0.0};
}

DopTreeOptions walk_options(RandomNumbers& random) {
  if (random.chance(0.5)) return {};
  const std::vector<DopTreeOptions> all = all_tree_options();
  return all[static_cast<std::size_t>(random.integer(0, static_cast<int>(all.size()) - 1))];
}

// One pair of trees, one coherent workspace, and a pose that moves on.
class Walk {
 public:
  Walk(std::uint64_t seed, std::int64_t index)
      : random_(seed * 1'000'003 + static_cast<std::uint64_t>(index)),
        large_(index % 4 == 0),
        family_{large_ ? Placement::kNear : sweep_families()[static_cast<std::size_t>(index) % 15].placement,
                Approach::kAnywhere},
        options_(walk_options(random_)),
        step_(random_.power_of_ten(-8.0, -1.0)) {
    renew_trees();
  }

  /// Returns what differs, or an empty string.
  std::string frame(Counts& counts) {
    change_question();
    const bool swapped = random_.chance(0.005);
    if (random_.chance(0.005)) remembering_.forget();
    if (random_.chance(large_ ? 0.0005 : 0.005)) renew_trees();
    if (random_.chance(large_ ? 0.0005 : 0.005)) refit_trees();
    move(counts);
    const DopTree& tree_A = swapped ? *tree_B_ : *tree_A_;
    const DopTree& tree_B = swapped ? *tree_A_ : *tree_B_;
    const PairSelection selection = !selects_ ? PairSelection{}
                                    : swapped ? PairSelection{&*selection_B_, &*selection_A_}
                                              : PairSelection{&*selection_A_, &*selection_B_};
    const bool hit = ask(tree_A, tree_B, swapped ? X_AB_.inverse() : X_AB_, selection);
    ++counts.frames[query_];
    counts.hits[query_] += hit ? 1 : 0;
    if (!swapped) {
      counts.changes += hit != hit_ ? 1 : 0;
      hit_ = hit;
    }
    return difference_.empty() ? "" : description(swapped);
  }

 private:
  // New trees at the address of the old ones: a workspace must not take them for those.
  void renew_trees() {
    pair_ = walk_pair(family_, large_, random_);
    mesh_A_ = std::make_shared<geometry::TriangleMesh>(pair_.A.mesh);
    mesh_B_ = std::make_shared<geometry::TriangleMesh>(pair_.B.mesh);
    tree_A_.emplace(mesh_A_, options_);
    tree_B_.emplace(mesh_B_, options_);
    const double share = random_.uniform(0.0, 0.5);
    const auto is_selected = [&](std::int32_t) { return random_.chance(share); };
    selection_A_.emplace(*tree_A_, is_selected);
    selection_B_.emplace(*tree_B_, is_selected);
    teleport();
  }

  void refit_trees() {
    deform(*mesh_A_, 0.1 * pair_.A.size, random_);
    tree_A_->refit();
    if (random_.chance(0.5)) {
      deform(*mesh_B_, 0.1 * pair_.B.size, random_);
      tree_B_->refit();
    }
    // The workspace must notice by itself.
  }

  void teleport() {
    const Approach approach = random_.chance(0.5) ? Approach::kTouching : Approach::kAnywhere;
    const SweepFamily family{family_.placement, approach};
    X_AB_ = random_poses(
                family, pair_, 1, [](const Isometry3d&) { return false; }, random_)
                .front();
    previous_X_AB_ = X_AB_;
    const Vector3d apart = X_AB_ * pair_.B.center - pair_.A.center;
    pull_ = random_.chance(0.5) && apart.norm() > 0.0 ? apart.normalized() : random_.direction();
  }

  void change_question() {
    if (random_.chance(0.02))
      query_ = large_ && random_.chance(0.6) ? 0 : static_cast<std::size_t>(random_.integer(0, 3));
    if (random_.chance(0.02)) selects_ = random_.chance(0.5);
    if (random_.chance(0.05)) {
      const double reach = large_ && query_ != 0 ? -2.5 : -0.5;
      tolerance_ = random_.chance(0.5) ? 0.0 : random_.power_of_ten(-9.0, reach) * pair_.scale();
      if (!large_ && random_.chance(0.02)) tolerance_ = std::numeric_limits<double>::infinity();
    }
  }

  void move(Counts& counts) {
    const double kind = random_.uniform(0.0, 1.0);
    if (kind < 0.01) {
      teleport();
      ++counts.teleports;
    } else if (kind < 0.06) {
      std::swap(X_AB_, previous_X_AB_);
    } else if (kind > 0.1) {
      previous_X_AB_ = X_AB_;
      // Away from the other when they collide, toward it when not; now and then by a rounding error only.
      const double length = random_.chance(0.05) ? random_.power_of_ten(-17.0, -12.0) : random_.uniform(0.0, step_);
      const Vector3d turning = 0.3 * random_.point(length);
      const Vector3d center = X_AB_ * pair_.B.center;
      const Vector3d shift = length * pair_.scale() * ((hit_ ? 1.0 : -1.0) * pull_ + 0.5 * random_.direction());
      const Eigen::AngleAxisd turn(turning.norm(), turning.norm() > 0.0 ? turning.normalized() : Vector3d::UnitX());
      X_AB_.linear() = (turn * Eigen::Quaterniond(X_AB_.linear())).normalized().toRotationMatrix();
      X_AB_.translation() = center + shift - X_AB_.linear() * pair_.B.center;
    }
  }

  bool ask(const DopTree& tree_A, const DopTree& tree_B, const Isometry3d& X_AB, const PairSelection& selection) {
    asked_X_AB_ = X_AB;
    if (query_ == 0) {
      const bool expected = intersects(tree_A, tree_B, X_AB, fresh_, tolerance_);
      if (intersects(tree_A, tree_B, X_AB, remembering_, tolerance_) != expected) difference_ = "another verdict";
      return expected;
    }
    if (query_ == 1) {
      intersecting_pairs(tree_A, tree_B, X_AB, fresh_, pairs_, tolerance_);
      intersecting_pairs(tree_A, tree_B, X_AB, remembering_, remembered_pairs_, tolerance_);
      if (pairs_ != remembered_pairs_) difference_ = "other pairs";
      return !pairs_.empty();
    }
    if (query_ == 3) {
      const double limit = tolerance_ > 0.0 ? tolerance_ : std::numeric_limits<double>::infinity();
      const MeshDistance fresh = distance(tree_A, tree_B, X_AB, fresh_, limit);
      const MeshDistance remembering = distance(tree_A, tree_B, X_AB, remembering_, limit);
      if (!same_bits(remembering.distance, fresh.distance)) difference_ = "another distance";
      if (remembering.nearest.has_value() != fresh.nearest.has_value() ||
          (fresh.nearest && !same_bits(*remembering.nearest, *fresh.nearest))) {
        difference_ = "another nearest pair";
      }
      return fresh.distance == 0.0;
    }
    pairs_within(tree_A, tree_B, X_AB, tolerance_, fresh_, close_pairs_, selection);
    pairs_within(tree_A, tree_B, X_AB, tolerance_, remembering_, remembered_close_pairs_, selection);
    const bool same = std::equal(close_pairs_.begin(), close_pairs_.end(), remembered_close_pairs_.begin(),
                                 remembered_close_pairs_.end(),
                                 [](const ClosePair& u, const ClosePair& v) { return same_bits(u, v); });
    if (!same) difference_ = "other close pairs or distances or points";
    return !close_pairs_.empty();
  }

  std::string description(bool swapped) {
    const std::string what = std::exchange(difference_, {});
    return what + " from " + kQueries[query_] + (selects_ ? " of a selection" : "") + ", tolerance " +
           text(tolerance_) + (swapped ? ", roles swapped" : "") + "\n  " + variant_name(options_) + ", " +
           family_name(family_) + "\n  A: " + pair_.A.description + "\n  B: " + pair_.B.description + "\n" +
           text(asked_X_AB_);
  }

  RandomNumbers random_;
  bool large_;
  SweepFamily family_;
  DopTreeOptions options_;
  double step_;  // largest step over size
  SweepPair pair_;
  std::shared_ptr<geometry::TriangleMesh> mesh_A_;
  std::shared_ptr<geometry::TriangleMesh> mesh_B_;
  std::optional<DopTree> tree_A_;
  std::optional<DopTree> tree_B_;
  std::optional<TriangleSelection> selection_A_;
  std::optional<TriangleSelection> selection_B_;
  bool selects_ = false;  ///< where close pairs are asked for
  Isometry3d X_AB_;
  Isometry3d previous_X_AB_;
  Isometry3d asked_X_AB_;
  Vector3d pull_;
  std::size_t query_ = 0;
  double tolerance_ = 0.0;
  bool hit_ = false;
  std::string difference_;
  QueryWorkspace fresh_;
  CoherentWorkspace remembering_;
  std::vector<TrianglePair> pairs_;
  std::vector<TrianglePair> remembered_pairs_;
  std::vector<ClosePair> close_pairs_;
  std::vector<ClosePair> remembered_close_pairs_;
};

void walk(const SweepArguments& arguments, InstructionSet set, std::int64_t index, Counts& counts,
          SweepDifferences& differences) {
  Walk walk(arguments.seed, index);
  for (int i = 0; i < kFramesPerWalk; ++i) {
    const std::string difference = walk.frame(counts);
    if (difference.empty()) continue;
    differences.add(difference + "\n  --seed " + std::to_string(arguments.seed) + " --only-case " +
                    std::to_string(index) + ", frame " + std::to_string(i) + ", " + std::string(name_of(set)));
  }
}

void print(const Counts& counts, double seconds) {
  std::printf("%-20s %12s %12s\n", "query", "frames", "not empty");
  std::int64_t total = 0;
  for (std::size_t q = 0; q < kQueries.size(); ++q) {
    std::printf("%-20s %12lld %12lld\n", kQueries[q], static_cast<long long>(counts.frames[q]),
                static_cast<long long>(counts.hits[q]));
    total += counts.frames[q];
  }
  std::printf("\n%lld frames, %lld teleports, %lld changes of the verdict, %.1f s\n", static_cast<long long>(total),
              static_cast<long long>(counts.teleports), static_cast<long long>(counts.changes), seconds);
}

bool sweep(const SweepArguments& arguments) {
  const std::vector<InstructionSet> sets = instruction_sets(arguments.only_instruction_set);
  const std::int64_t walks = (arguments.count + kFramesPerWalk - 1) / kFramesPerWalk;
  const bool one = arguments.only_case >= 0;
  const Stopwatch watch;
  Counts counts;
  SweepDifferences differences;
  for (std::int64_t first = one ? arguments.only_case : 0;
       (one ? first == arguments.only_case : first < walks) && watch.seconds() < arguments.seconds;
       first += kWalksPerBatch) {
    const InstructionSet set = sets[static_cast<std::size_t>(first / kWalksPerBatch) % sets.size()];
    use_instruction_set(set);
    const std::int64_t end = one ? first + 1 : std::min<std::int64_t>(walks, first + kWalksPerBatch);
    tbb::parallel_for(first, end, [&](std::int64_t i) { walk(arguments, set, i, counts, differences); });
  }
  print(counts, watch.seconds());
  differences.print();
  return differences.count() == 0;
}

}  // namespace
}  // namespace glissade::collision

int main(int argc, char** argv) {
  return glissade::test_support::run_sweep(argc, argv, "Compares queries that remember with queries that do not",
                                           "frames", 1'000'000, glissade::collision::sweep);
}
